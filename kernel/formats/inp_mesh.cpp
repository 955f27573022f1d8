// SPDX-License-Identifier: MIT
// The nodes and elements of an Abaqus deck as it lists them.
#include "kernel/formats/inp_mesh.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/inp_fields.h"

namespace tetmend::formats {
namespace {

// They make nodes or elements that the deck does not list, or change what its coordinates mean.
constexpr std::array<std::string_view, 10> kGenerators = {"NGEN",
                                                          "NFILL",
                                                          "NCOPY",
                                                          "NMAP",
                                                          "ELGEN",
                                                          "ELCOPY",
                                                          "SYSTEM",
                                                          "TIE MESH",
                                                          "SUBSTRUCTURE GENERATE",
                                                          "SYMMETRIC MODEL GENERATION"};

class InpMeshReader {
 public:
  InpMeshReader(const InpLines& lines, TetPlace* question) : lines_(lines), question_(question) {}

  InpMesh run() {
    for (const InpBlock& block : lines_.blocks) {
      if (std::find(kGenerators.begin(), kGenerators.end(), block.keyword) != kGenerators.end()) {
        block.fail(
            fmt::format("'*{}' cannot be read: expected a deck that lists all nodes and "
                        "elements with their coordinates",
                        block.keyword));
      }
      if (is_mesh_block(block, "NODE")) read_nodes(block);
    }
    const std::uint32_t twice = mesh_.nodes.finish();
    if (twice != InpNumbers::kNone) fail_twice("node", twice, "NODE");
    for (const InpBlock& block : lines_.blocks) {
      if (is_mesh_block(block, "ELEMENT")) read_elements(block);
    }
    const std::uint32_t again = mesh_.elements.finish();
    if (again != InpNumbers::kNone) fail_twice("element", again, "ELEMENT");
    std::sort(mesh_.others.begin(), mesh_.others.end());
    return std::move(mesh_);
  }

 private:
  void read_nodes(const InpBlock& block) {
    const std::string system = inp_key(block.value("SYSTEM"));
    if (!system.empty() && system != "R") {
      block.fail(fmt::format("the coordinates of system {} cannot be read: expected SYSTEM=R",
                             in_quotes(system)));
    }
    const std::int64_t offset = lines_.scopes[block.scope].node_offset;
    InpFields fields(block);
    while (fields.next_line()) {
      const std::int64_t number = own_number(fields, "the number of a node") + offset;
      mesh_.nodes.add(number);
      Point& point = mesh_.points.emplace_back();
      for (int axis = 0; axis < 3; ++axis) point[axis] = fields.real("a coordinate");
      if (fields.more()) {
        mesh_.more_of_node[number] = fields.rest();
      }
      // Behind them Abaqus has the cosines of a normal.
      for (int k = 0; k < 3 && fields.more(); ++k) fields.real("a direction cosine");
      if (fields.more()) {
        fields.fail(fmt::format("{} is too much: expected a number and three coordinates",
                                in_quotes(fields.field())));
      }
    }
    if (mesh_.points.size() > kMostVertices) fields.fail("there are too many nodes");
  }

  void read_elements(const InpBlock& block) {
    const std::string_view name = block.value("TYPE");
    if (name.empty()) block.fail("*ELEMENT names no type: expected TYPE=C3D4 or another one");
    InpElements elements;
    elements.block = &block;
    elements.type = inp_type(name);
    elements.name = name;
    elements.first = count_;
    if (elements.type.kind == InpType::Kind::refused) {
      block.fail(
          fmt::format("elements of type {} cannot be kept: expected C3D4, C3D10, C3D8, "
                      "C3D20, C3D6, C3D15 or C3D5",
                      in_quotes(name)));
    }
    const InpScope& scope = lines_.scopes[block.scope];
    InpFields fields(block);
    if (elements.type.kind == InpType::Kind::other) {
      return note_others(fields, scope.element_offset);
    }
    while (fields.next_line()) {
      mesh_.elements.add(own_number(fields, "the number of an element") + scope.element_offset);
      if (elements.type.vtk_type == kVtkTet && question_ != nullptr && tets_++ == question_->tet) {
        question_->place = block.file->line_place(fields.place());
      }
      read_vertices(fields, elements, scope);
      ++elements.count;
    }
    count_ += elements.count;
    if (count_ > kMostVertices) fields.fail("there are too many elements");
    mesh_.blocks.push_back(std::move(elements));
  }

  void read_vertices(InpFields& fields, InpElements& elements, const InpScope& scope) {
    const std::size_t width = elements.type.width;
    const std::size_t begin = elements.vertices.size();
    elements.vertices.resize(begin + width);
    std::uint32_t* vertices = elements.vertices.data() + begin;
    for (std::size_t i = 0; i < width; ++i) {
      const std::int64_t number = fields.integer("the number of a node", true);
      const std::uint32_t vertex = mesh_.nodes.find(scope.node(number));
      if (vertex == InpNumbers::kNone) {
        fields.fail(fmt::format("'{}' is not the number of a node: expected one of *NODE{}", number,
                                scope.name.empty() ? "" : " of " + in_quotes(scope.name)));
      }
      vertices[vtk_position(elements.type.vtk_type, i)] = vertex;
    }
    if (fields.more()) {
      fields.fail(fmt::format("{} is too much: expected {} nodes of an element of type {}",
                              in_quotes(fields.field()), width, elements.name));
    }
  }

  /// What is without a number gets one when it is written, and loads and sets may mean another then.
  static std::int64_t own_number(InpFields& fields, std::string_view what) {
    const std::int64_t number = fields.integer(what);
    if (number == 0) fields.fail(fmt::format("'0' is out of range: expected {}, from 1", what));
    return number;
  }

  void note_others(InpFields& fields, std::int64_t offset) {
    while (fields.next_line()) {
      std::int64_t number = 0;
      if (to_integer(fields.field(), number)) mesh_.others.push_back(number + offset);
    }
  }

  /// Where the number of a place stands is looked for only now.
  [[noreturn]] void fail_twice(std::string_view what, std::uint32_t place,
                               std::string_view keyword) {
    std::size_t seen = 0;
    for (const InpBlock& block : lines_.blocks) {
      if (!is_mesh_block(block, keyword)) continue;
      const InpType type = inp_type(block.value("TYPE"));
      if (keyword == "ELEMENT" && type.kind != InpType::Kind::mesh) continue;
      InpFields fields(block);
      while (fields.next_line()) {
        const std::int64_t number = fields.integer("a number");
        if (seen++ == place) {
          fields.fail(fmt::format("the {} '{}' appears for the second time", what, number));
        }
        if (keyword == "NODE") continue;
        for (std::size_t i = 0; i < type.width; ++i) fields.field_of_lines("a node");
      }
    }
    throw std::logic_error("a number is gone");
  }

  const InpLines& lines_;
  TetPlace* question_;
  InpMesh mesh_;
  std::size_t count_ = 0;
  std::size_t tets_ = 0;
};

}  // namespace

std::uint32_t InpNumbers::finish() {
  std::uint32_t twice = kNone;
  if (std::adjacent_find(numbers_.begin(), numbers_.end(), std::greater_equal<>()) ==
      numbers_.end()) {
    tags_ = GmshTags(numbers_);
  } else {
    order_ = ascending_order(numbers_);
    sorted_ = numbers_;
    reorder(sorted_, order_);
    for (std::size_t i = 1; i < sorted_.size(); ++i) {
      if (sorted_[i] == sorted_[i - 1]) twice = std::min(twice, order_[i]);
    }
    if (twice == kNone) tags_ = GmshTags(sorted_);
  }
  if (!numbers_.empty()) most_ = sorted_.empty() ? numbers_.back() : sorted_.back();
  return twice;
}

std::size_t InpNumbers::collect(std::int64_t first, std::int64_t last, std::int64_t step,
                                std::vector<std::uint32_t>& places) const {
  const auto& all = sorted_.empty() ? numbers_ : sorted_;
  const auto begin = std::lower_bound(all.begin(), all.end(), first);
  const auto end = std::upper_bound(begin, all.end(), last);
  const std::int64_t steps = (last - first) / step + 1;
  if (steps <= end - begin) {
    for (std::int64_t number = first; number <= last; number += step) {
      const std::uint32_t place = find(number);
      if (place != kNone) places.push_back(place);
    }
    return static_cast<std::size_t>(steps);
  }
  for (auto at = begin; at != end; ++at) {
    if ((*at - first) % step != 0) continue;
    const auto place = static_cast<std::uint32_t>(at - all.begin());
    places.push_back(order_.empty() ? place : order_[place]);
  }
  return static_cast<std::size_t>(end - begin);
}

const InpElements& InpMesh::block_of(std::uint32_t element) const {
  const auto after =
      std::upper_bound(blocks.begin(), blocks.end(), element,
                       [](std::uint32_t e, const InpElements& block) { return e < block.first; });
  return *(after - 1);
}

bool is_mesh_block(const InpBlock& block, std::string_view keyword) {
  return block.keyword == keyword && !block.is_in_assembly && block.is_of_mesh;
}

InpMesh read_inp_mesh(const InpLines& lines, TetPlace* question) {
  return InpMeshReader(lines, question).run();
}

}  // namespace tetmend::formats
