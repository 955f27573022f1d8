// SPDX-License-Identifier: MIT
#include "kernel/formats/lsdyna_mesh.h"

#include <algorithm>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {
namespace {

/// By which of its nodes are the same.
const ElementKind* kind_of_solid(const std::vector<std::int64_t>& n) {
  if (n.size() == 10) return element_kind(vtk_tet10);
  if (n.size() == 4) return element_kind(vtk_tet);
  const auto same = [&](std::size_t from) {
    return std::all_of(n.begin() + static_cast<std::ptrdiff_t>(from), n.end(),
                       [&](std::int64_t each) { return each == n[from]; });
  };
  if (n.size() > kLsDynaNodesOfSolid) return nullptr;
  if (same(3)) return element_kind(vtk_tet);
  if (n.size() != kLsDynaNodesOfSolid) return nullptr;
  if (same(4)) return element_kind(vtk_pyramid);
  if (n[4] == n[5] && n[6] == n[7]) return element_kind(vtk_prism);
  return element_kind(vtk_hexahedron);
}

}  // namespace

LsDynaMesh::LsDynaMesh(const std::filesystem::path& deck, TetPlace* question)
    : LsDynaDeck(deck), question_(question), sorter_(mesh_) {
  for (const LsDynaBlock& block : blocks_) {
    use(block);
    if (is_nodes(block)) read_nodes(block);
  }
  refuse_other_places();
  nodes_ = index_of(mesh_.point_numbers, node_places_, "a node");
  pin_constrained();
  for (const LsDynaBlock& block : blocks_) {
    use(block);
    if (is_solids(block)) read_solids(block);
  }
  solids_ = index_of(solid_numbers_, solid_places_, "a solid");
}

/// A mesh that stands in another file, or in keywords that are not read.
void LsDynaMesh::refuse_other_places() const {
  const auto find = [&](std::string_view beginning) {
    return std::find_if(blocks_.begin(), blocks_.end(), [&](const LsDynaBlock& block) {
      return block.keyword.starts_with(beginning);
    });
  };
  if (std::none_of(blocks_.begin(), blocks_.end(), is_nodes)) {
    const auto include = find("INCLUDE");
    const auto names = include == blocks_.end() ? std::vector<std::string_view>() : lines(*include);
    if (names.empty()) {
      const InputFile& deck = files_.deck();
      deck.fail_at_line(deck.end(), "the file has no nodes: expected *NODE");
    }
    if (!unread_.empty()) {
      fail(names[0], fmt::format("there are no nodes, and of the files of *INCLUDE not all are "
                                 "read: {}",
                                 unread_.front()));
    }
    fail(names[0],
         fmt::format("there are no nodes, and *{} is not followed: expected *NODE or *INCLUDE",
                     include->keyword));
  }
  const auto others = find("ELEMENT_SOLID");
  if (others != blocks_.end() && std::none_of(blocks_.begin(), blocks_.end(), is_solids)) {
    fail({others->begin, 1},
         fmt::format("solids of *{} cannot be read: expected *ELEMENT_SOLID", others->keyword));
  }
}

std::string LsDynaMesh::lines_of(std::string_view text) {
  std::string lines(text);
  if (!lines.empty() && !lines.ends_with('\n')) lines += '\n';
  return lines;
}

LsDynaMesh::Comments LsDynaMesh::comments_of(const char* begin, const char* end) {
  Comments comments;
  const char* behind = begin;
  for (const char* at = begin; at != end;) {
    if (!is_comment(next_line(at, end))) behind = at;
  }
  for (const char* at = begin; at != behind;) {
    const std::string_view line = next_line(at, behind);
    if (line.starts_with('$')) comments.inner += lines_of(line);
  }
  comments.trailing = {behind, static_cast<std::size_t>(end - behind)};
  return comments;
}

NumberIndex LsDynaMesh::index_of(const std::vector<std::int64_t>& numbers,
                                 const std::vector<const char*>& places,
                                 std::string_view what) const {
  return {numbers, [&](std::uint32_t i) {
            fail({places[i], 1}, fmt::format("the number '{}' of {} appears for the second time",
                                             numbers[i], what));
          }};
}

// ---- Nodes ----------------------------------------------------------------------------------------

void LsDynaMesh::read_nodes(const LsDynaBlock& block) {
  for (const char* at = block.content; at != block.end;) {
    const std::string_view line = next_line(at, block.end);
    if (is_comment(line)) continue;
    if (mesh_.points.size() == kMostVertices) fail(line, "the nodes are too many");
    split(line, now().integer, now().integer, 3);
    mesh_.point_numbers.push_back(integer(0, line, "the number of a node", 1));
    node_places_.push_back(line.data());
    Point& point = mesh_.points.emplace_back(Point::Zero());
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view text = field(1 + static_cast<std::size_t>(axis));
      if (text.empty() || nastran_real(text, point[axis])) continue;
      fail(line, fmt::format("{} is not a finite number: expected a coordinate", in_quotes(text)));
    }
    keep_constraint(line);
  }
}

/// A node that says more than its place. "0" and "0.0" say nothing.
void LsDynaMesh::keep_constraint(std::string_view line) {
  const auto is_something = [&](std::size_t k) {
    double value = 0;
    return nastran_real(field(k), value) && value != 0;
  };
  if (!is_something(4) && !is_something(5)) return;
  const bool is_as_written = now() == widths_;
  points_of_deck_.push_back(
      fmt::format("{}\n{}", mesh_.point_numbers.back(),
                  is_as_written ? lines_of(line) : fmt::format("{}\n", fmt::join(fields_, ","))));
  constrained_.push_back(static_cast<std::uint32_t>(mesh_.points.size() - 1));
}

void LsDynaMesh::pin_constrained() {
  for (const std::uint32_t v : constrained_) {
    const std::int64_t number = mesh_.point_numbers[v];
    pins_.line_of("*NODE with constraints", node_places_[v])
        .ranges.push_back(nodes_.range(number, number));
  }
}

std::uint32_t LsDynaMesh::node(std::int64_t number, std::string_view line) const {
  const std::uint32_t found = nodes_.find(number);
  if (found == NumberIndex::kNone) {
    fail(line, fmt::format("'{}' is not the number of a node: expected one of *NODE", number));
  }
  return found;
}

// ---- Solids ---------------------------------------------------------------------------------------

/// Numbers of one element: of a line, or two where the first has but two or ends in a comma.
void LsDynaMesh::read_solids(const LsDynaBlock& block) {
  std::vector<std::int64_t> numbers;
  for (const char* at = block.content; at != block.end;) {
    std::string_view line = next_line(at, block.end);
    if (is_comment(line)) continue;
    const std::string_view first = line;
    numbers.clear();
    take_numbers(line, numbers);
    const std::string_view text = trimmed_field(line);
    if (numbers.size() <= 2 || text.ends_with(',')) {
      do {
        if (at == block.end) fail(first, "the nodes of the element are missing");
        line = next_line(at, block.end);
      } while (is_comment(line));
      take_numbers(line, numbers);
    }
    add_solid(first, numbers);
  }
}

void LsDynaMesh::take_numbers(std::string_view line, std::vector<std::int64_t>& numbers) {
  split(line, now().integer, now().integer);
  while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    numbers.push_back(fields_[i].empty() ? 0 : integer(i, line, "the number of a node", 0));
  }
}

void LsDynaMesh::add_solid(std::string_view line, std::vector<std::int64_t>& numbers) {
  while (numbers.size() > 2 && numbers.back() == 0) numbers.pop_back();
  if (numbers.size() < 6 || numbers.size() > 12) {
    fail(line, fmt::format("an element has {} nodes: expected 4, 6, 8 or 10",
                           numbers.size() < 2 ? 0 : numbers.size() - 2));
  }
  ElementRow row;
  row.number = numbers[0];
  row.place = line.data();
  if (row.number < 1 || numbers[1] < 1 || numbers[1] > INT32_MAX) {
    fail(line, "expected the numbers of an element and of a part, from 1");
  }
  row.label = static_cast<Label>(numbers[1]);
  const std::vector<std::int64_t> listed(numbers.begin() + 2, numbers.end());
  row.kind = kind_of_solid(listed);
  if (row.kind == nullptr)
    fail(line, "the element is none of 4, 5, 6, 8 or 10 nodes: of higher order?");
  const std::uint8_t* order = lsdyna_order(row.kind->vtk_type);
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const std::size_t to = order == nullptr ? k : order[k];
    if (to < row.kind->width) row.vertices[to] = node(listed[k], line);
  }
  sorter_.add(row, true);
  if (is_last_asked_for(question_, mesh_, row.kind->vtk_type))
    question_->place = files_.file_of(row.place).line_place(row.place);
  elements_.push_back(last_place(mesh_, *row.kind));
  solid_numbers_.push_back(row.number);
  solid_places_.push_back(row.place);
}

}  // namespace tetmend::formats
