// SPDX-License-Identifier: MIT
// Reads decks of Abaqus and CalculiX.
//
//   lines, also of included files | nodes, elements | sets | faces that surfaces and loads name
//   part: elements of one type that are in the same sets, faces that the same surfaces and loads name
//   group: a set or surface, by the parts that it has
//   deck: all other lines as they are, and pieces that say where nodes, elements, sets go
#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/inp.h"
#include "kernel/formats/inp_deck.h"
#include "kernel/formats/inp_faces.h"
#include "kernel/formats/inp_fields.h"
#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_parts.h"
#include "kernel/formats/inp_pieces.h"
#include "kernel/formats/inp_pins.h"
#include "kernel/formats/inp_references.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {
namespace {

/// A triangle whatever corner comes first, but not turned round.
std::array<std::uint32_t, 3> rotated(std::array<std::uint32_t, 3> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

struct TriangleHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& v) const {
    std::uint64_t hash = v[0];
    for (const std::uint64_t next : {v[1], v[2]}) {
      hash = (hash ^ (hash >> 29)) * 0x9e3779b97f4a7c15u + next;
    }
    return hash ^ (hash >> 32);
  }
};

class InpReader {
 public:
  InpReader(const std::filesystem::path& file, TetPlace* question)
      : file_(file),
        lines_(file),
        mesh_(read_inp_mesh(lines_, question)),
        sets_(lines_, mesh_),
        faces_(read_inp_faces(lines_, mesh_, sets_)) {
    for (const InpFaceUse& use : faces_.uses) uses_of_[use.block].push_back(&use);
  }

  MeshData run() {
    check();
    data_.variant = kInp;
    data_.notes = faces_.notes;
    data_.notes.insert(data_.notes.end(), sets_.notes.begin(), sets_.notes.end());
    note_other_scopes();
    const InpReferences references = find_references(lines_, kept_blocks(), mesh_);
    drop_sets_of_faces(references);
    find_homes();
    number_sets();
    make_parts();
    InpPins pins = find_pins(lines_, mesh_, sets_, faces_, references, part_of_);
    data_.required_vertices = std::move(pins.points);
    add_required_set();
    add_elements();
    add_groups();
    data_.deck = make_inp_deck(
        {file_, lines_, mesh_, sets_, faces_, parts_, homes_, home_of_block_, pins.remarks});
    data_.point_numbers = mesh_.nodes.numbers();
    data_.points = std::move(mesh_.points);
    drop_zero_point_labels(data_);
    return std::move(data_);
  }

 private:
  void check() {
    const auto has = [&](std::string_view keyword) {
      return std::any_of(lines_.blocks.begin(), lines_.blocks.end(),
                         [&](const InpBlock& block) { return block.keyword == keyword; });
    };
    if (lines_.blocks.empty()) fail("the file is empty: expected *NODE");
    const std::string_view first = trimmed(lines_.blocks[0].text());
    if (lines_.blocks[0].keyword.empty() && !first.empty() && first[0] >= '0' && first[0] <= '9') {
      fail("this is a file of AVS (UCD), not of Abaqus: ParaView saves it as .vtu or .vtk");
    }
    if (!has("NODE")) fail("*NODE is missing: expected a deck with nodes and elements");
  }
  /// Parts with elements that are not in the mesh.
  void note_other_scopes() {
    std::vector<bool> is_told(lines_.scopes.size(), false);
    for (const InpBlock& block : lines_.blocks) {
      if (block.is_of_mesh || block.is_in_assembly || block.keyword != "ELEMENT") continue;
      if (inp_type(block.value("TYPE")).kind == InpType::Kind::other) continue;
      if (is_told[block.scope]) continue;
      is_told[block.scope] = true;
      data_.notes.push_back(
          fmt::format("{} has no tetrahedra: it stays in the deck, and is in no mesh",
                      in_quotes(lines_.scopes[block.scope].name)));
    }
  }
  [[noreturn]] void fail(std::string_view reason) const {
    const InputFile file(file_);
    file.fail_at_line(file.begin(), reason);
  }

  bool is_use(const InpBlock& block) const { return uses_of_.contains(&block); }

  std::vector<const InpBlock*> kept_blocks() const {
    std::vector<const InpBlock*> kept;
    for (const InpBlock& block : lines_.blocks) {
      if (!is_listed_anew(block)) kept.push_back(&block);
    }
    return kept;
  }

  /// Programs make sets for the sides of elements that a surface has. As parts of the mesh they
  /// would be walls; the surface is written without them.
  void drop_sets_of_faces(const InpReferences& references) {
    std::set<const InpSet*> of_elements;
    for (const InpElements& block : mesh_.blocks) of_elements.insert(sets_.of_block(*block.block));
    std::set<std::string> elsewhere = references.names;
    for (const InpBlock& block : lines_.blocks) {
      if (is_use(block)) forget_names(block, elsewhere);
    }
    std::set<std::string> told;
    for (InpSet& set : sets_.all) {
      if (!faces_.sets.contains(&set) || of_elements.contains(&set)) continue;
      if (elsewhere.contains(set.key)) continue;
      set.is_kept = false;
      if (set.is_internal || !told.insert(set.key).second) continue;  // once for all instances
      data_.notes.push_back(fmt::format(
          "the set of elements {} is not kept: it serves faces alone, which are written by numbers",
          in_quotes(set.name)));
    }
  }

  /// Names that stand in lines about faces alone do not count.
  void forget_names(const InpBlock& use, std::set<std::string>& names) const {
    std::set<std::string> here;
    InpFields fields(use);
    while (fields.next_line()) here.insert(inp_key(fields.field()));
    std::vector<const InpBlock*> others;
    if (rest_of_names_.empty()) {
      for (const InpBlock* block : kept_blocks()) {
        if (!is_use(*block)) others.push_back(block);
      }
      rest_of_names_ = find_references(lines_, others, mesh_).names;
      rest_of_names_.insert("");
    }
    for (const std::string& name : here) {
      const std::size_t dot = name.rfind('.');
      for (const std::string& each :
           {name, dot == std::string::npos ? name : name.substr(dot + 1)}) {
        if (!rest_of_names_.contains(each)) names.erase(each);
      }
    }
  }

  void find_homes() {
    std::map<std::tuple<std::size_t, std::string, InpSet*>, std::uint32_t> known;
    for (const InpElements& block : mesh_.blocks) {
      InpSet* set = sets_.of_block(*block.block);
      const auto [at, is_new] = known.try_emplace({block.block->scope, inp_key(block.name), set},
                                                  static_cast<std::uint32_t>(homes_.size() + 1));
      if (is_new) homes_.push_back({&block, set});
      home_of_block_.push_back(at->second);
    }
  }

  /// Label_0: the elements of a deck that tetmend has made of a mesh where they have no label.
  static bool is_unlabelled(const InpSet& set) {
    Label label = 1;
    return !set.of_nodes && to_label(set.key, label) && label == 0;
  }

  /// Sets that sections name come first, in their order: their numbers are the labels.
  void number_sets() {
    std::set<Label> taken;
    for (InpSet& set : sets_.all) {
      Label label = 0;
      if (to_label(set.key, label) && label != 0) taken.insert(set.number = label);
    }
    for (const InpFaceUse& use : faces_.uses) {
      Label label = 0;
      if (use.is_surface && to_label(inp_key(use.name), label)) taken.insert(label);
    }
    Label next = 0;
    const auto number = [&](Label& of) {
      if (of != 0) return;
      do {
        ++next;
      } while (taken.contains(next));
      of = next;
    };
    for (const InpBlock& block : lines_.blocks) {
      if (!block.keyword.ends_with("SECTION") || block.value("ELSET").empty()) continue;
      InpSet* set = sets_.find(false, block.value("ELSET"), block);
      if (set == nullptr) continue;
      set->is_kept = true;
      number(set->number);
      section_sets_.insert(set);
    }
    for (const InpHome& home : homes_) {
      if (home.set != nullptr) number(home.set->number);
    }
    next = 0;
    std::set<Label> of_elements = taken;
    for (const InpSet& set : sets_.all) {
      if (!set.of_nodes) of_elements.insert(set.number);
    }
    taken = of_elements;
    for (InpSet& set : sets_.all) {
      if (!is_unlabelled(set)) number(set.number);
    }
    for (InpFaceUse& use : faces_.uses) {
      if (!(use.is_surface && to_label(inp_key(use.name), use.number))) number(use.number);
    }
  }

  void make_parts() {
    part_of_.resize(mesh_.elements.numbers().size());
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const InpElements& block = mesh_.blocks[b];
      const std::uint32_t home = home_of_block_[b];
      const auto [at, is_new] = part_of_home_.try_emplace(home, 0);
      if (is_new) at->second = parts_.of_home(home, block.type.dimension);
      std::fill_n(part_of_.begin() + static_cast<std::ptrdiff_t>(block.first), block.count,
                  at->second);
    }
    std::uint32_t number = 0;
    for (const InpSet& set : sets_.all) {
      const std::uint32_t s = number++;
      if (set.of_nodes || !set.is_kept) continue;
      std::uint32_t last = UINT32_MAX;
      std::uint32_t next = 0;
      for (const std::uint32_t element : set.members) {
        std::uint32_t& part = part_of_[element];
        if (part != last) next = parts_.with(last = part, s);
        part = next;
      }
      refuse_many_parts();
    }
    add_faces();
    used_.resize(parts_.all.size());
    for (const std::uint32_t part : part_of_) used_[part] = 1;
    parts_.list_sets(used_);
  }

  /// Members that a deck lists one by one are never so many; those of sets of sets may be.
  void refuse_many_parts() const {
    constexpr std::size_t kBytesOfPart = 256;
    if (!is_bomb(lines_.size_of_files(), kBytesOfPart * parts_.all.size())) return;
    fail("the sets overlap in more ways than a deck of this size can have");
  }

  /// A shell may lie on a face: then it is the triangle.
  void add_faces() {
    if (faces_.faces.empty()) return;
    std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, TriangleHash> triangles;
    for (const InpElements& block : mesh_.blocks) {
      if (block.type.vtk_type != kVtkTriangle) continue;
      for (std::size_t i = 0; i < block.count; ++i) {
        const std::uint32_t* v = block.vertices.data() + 3 * i;
        triangles.try_emplace(rotated({v[0], v[1], v[2]}),
                              static_cast<std::uint32_t>(block.first + i));
      }
    }
    std::unordered_set<std::uint64_t> uses_of_triangle;
    const std::uint32_t plain = parts_.of_home(0, 2);
    const auto shells = static_cast<std::uint32_t>(part_of_.size());
    const auto sets = static_cast<std::uint32_t>(sets_.all.size());
    for (const InpFace& face : faces_.faces) {
      const auto next = static_cast<std::uint32_t>(shells + face_corners_.size());
      const auto [at, is_new] = triangles.try_emplace(rotated(face.corners), next);
      if (is_new) {
        face_corners_.push_back(face.corners);
        part_of_.push_back(plain);
      }
      if (!uses_of_triangle.insert(std::uint64_t{at->second} << 32 | face.use).second) continue;
      std::uint32_t& part = part_of_[at->second];
      part = parts_.with(part, sets + face.use);
    }
  }

  Label label_of(const InpPart& part) const {
    const auto sets = static_cast<std::uint32_t>(sets_.all.size());
    Label label = 0;
    Label section = 0;
    for (const std::uint32_t s : part.sets) {
      if (s >= sets) {
        const InpFaceUse& use = faces_.uses[s - sets];
        if (part.home == 0 && section == 0) section = use.number;
        continue;
      }
      const InpSet& set = sets_.all[s];
      if (is_unlabelled(set)) return 0;
      if (label == 0 && to_label(set.key, label)) continue;
      if (!section_sets_.contains(&set)) continue;
      section = section == 0 ? set.number : std::min(section, set.number);
    }
    if (label != 0) return label;
    if (section != 0 || !section_sets_.empty() || part.home == 0) return section;
    const InpSet* home = homes_[part.home - 1].set;
    return home == nullptr ? 0 : home->number;
  }

  /// RequiredVertices is the set that tetmend itself writes.
  void add_required_set() {
    std::set<std::uint32_t> known;
    std::vector<std::uint32_t> all;
    for (const InpSet& set : sets_.all) {
      if (set.of_nodes && set.key == "REQUIREDVERTICES") all = set.members;
    }
    known.insert(all.begin(), all.end());
    for (const std::uint32_t v : data_.required_vertices) {
      if (!known.contains(v)) all.push_back(v);
    }
    data_.required_vertices = std::move(all);
  }

  void add_elements() {
    labels_.reserve(parts_.all.size());
    for (std::size_t p = 0; p < parts_.all.size(); ++p) {
      labels_.push_back(used_[p] != 0 ? label_of(parts_.all[p]) : 0);
    }
    std::map<int, OtherElements> others;
    for (const InpElements& block : mesh_.blocks) {
      switch (block.type.vtk_type) {
        case kVtkTet:
          add_rows(block, data_.tets, data_.tet_parts, data_.tet_numbers);
          break;
        case kVtkTriangle:
          add_rows(block, data_.triangles, data_.triangle_parts, data_.triangle_numbers);
          break;
        case kVtkEdge:
          add_rows(block, data_.edges, data_.edge_parts, data_.edge_numbers);
          break;
        default:
          add_others(block, others[block.type.vtk_type]);
      }
    }
    const std::size_t elements = mesh_.elements.numbers().size();
    for (std::size_t i = 0; i < face_corners_.size(); ++i) {
      const std::uint32_t part = part_of_[elements + i];
      data_.triangles.push_back({face_corners_[i], labels_[part]});
      data_.triangle_parts.push_back(static_cast<Label>(part + 1));
      data_.triangle_numbers.push_back(0);
    }
    for (auto& [type, list] : others) data_.other_elements.push_back(std::move(list));
  }

  template <class Element>
  void add_rows(const InpElements& block, std::vector<Element>& elements, std::vector<Label>& parts,
                std::vector<std::int64_t>& numbers) {
    constexpr std::size_t kWidth = std::tuple_size_v<decltype(Element::vertices)>;
    for (std::size_t i = 0; i < block.count; ++i) {
      const std::uint32_t part = part_of_[block.first + i];
      Element& element = elements.emplace_back();
      std::copy_n(block.vertices.data() + i * kWidth, kWidth, element.vertices.begin());
      element.label = labels_[part];
      parts.push_back(static_cast<Label>(part + 1));
      numbers.push_back(mesh_.elements.numbers()[block.first + i]);
    }
  }

  void add_others(const InpElements& block, OtherElements& list) {
    list.vtk_type = block.type.vtk_type;
    list.vertex_count = block.type.width;
    list.vertices.insert(list.vertices.end(), block.vertices.begin(), block.vertices.end());
    for (std::size_t i = 0; i < block.count; ++i) {
      const std::uint32_t part = part_of_[block.first + i];
      list.labels.push_back(labels_[part]);
      list.parts.push_back(static_cast<Label>(part + 1));
      list.numbers.push_back(mesh_.elements.numbers()[block.first + i]);
    }
  }

  void add_groups() {
    const std::size_t sets = sets_.all.size();
    std::vector<std::map<int, std::vector<Label>>> parts_of(sets + faces_.uses.size());
    for (std::size_t p = 0; p < parts_.all.size(); ++p) {
      for (const std::uint32_t s : parts_.all[p].sets) {
        parts_of[s][parts_.all[p].dimension].push_back(static_cast<Label>(p + 1));
      }
    }
    for (std::size_t s = 0; s < sets; ++s) {
      InpSet& set = sets_.all[s];
      Label label = 0;
      const bool is_label = to_label(set.key, label) && (label != 0 || is_unlabelled(set));
      const std::string name = is_label ? std::string() : set.name;
      if (set.of_nodes) {
        add_point_group(set, name, is_label);
        continue;
      }
      for (auto& [dimension, parts] : parts_of[s]) {
        set.groups.push_back({dimension, set.number});
        add_group(dimension, set.number, name, std::move(parts));
      }
    }
    for (std::size_t u = 0; u < faces_.uses.size(); ++u) {
      const InpFaceUse& use = faces_.uses[u];
      Label label = 0;
      const bool is_label = use.is_surface && to_label(inp_key(use.name), label);
      if (use.number == 0) continue;  // Label_0: all faces without a group
      add_group(2, use.number, is_label ? std::string() : use.name,
                std::move(parts_of[sets + u][2]));
    }
  }

  /// A label may have several sets, and a surface: one group.
  void add_group(int dimension, Label number, const std::string& name, std::vector<Label> parts) {
    if (name.empty()) {
      const auto [known, is_new] =
          nameless_groups_.emplace(std::pair(dimension, number), data_.groups.size());
      if (!is_new) {
        std::vector<Label>& all = data_.groups[known->second].parts;
        all.insert(all.end(), parts.begin(), parts.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return;
      }
    }
    data_.groups.push_back({dimension, number, name, std::move(parts), {}});
  }

  void add_point_group(InpSet& set, const std::string& name, bool is_label) {
    set.groups = {{0, set.number}};
    data_.groups.push_back({0, set.number, name, {}, {}});
    if (!is_label) {
      data_.groups.back().members = set.members;
      return;
    }
    data_.point_labels.resize(mesh_.points.size());
    for (const std::uint32_t v : set.members) data_.point_labels[v] = set.number;
  }

  std::filesystem::path file_;
  InpLines lines_;
  InpMesh mesh_;
  InpSets sets_;
  InpFaces faces_;
  MeshData data_;
  std::map<std::pair<int, Label>, std::size_t> nameless_groups_;  // by dimension and number
  mutable std::set<std::string> rest_of_names_;
  std::vector<InpHome> homes_;
  std::vector<std::uint32_t> home_of_block_;
  std::map<const InpBlock*, std::vector<const InpFaceUse*>> uses_of_;
  std::set<const InpSet*> section_sets_;
  InpParts parts_;
  std::map<std::uint32_t, std::uint32_t> part_of_home_;
  std::vector<std::uint32_t> part_of_;  // of each element, then of each face
  std::vector<char> used_;              // of each part: an element has it
  std::vector<std::array<std::uint32_t, 3>> face_corners_;
  std::vector<Label> labels_;  // of each part
};

}  // namespace

MeshData read_inp(const std::filesystem::path& file, TetPlace* question) {
  return InpReader(file, question).run();
}

std::vector<std::filesystem::path> inp_files(const std::filesystem::path& deck) {
  try {
    std::vector<std::filesystem::path> files = InpLines(deck).files();
    files.front() = deck;  // of standard input, too
    return files;
  } catch (const Error&) {
    return {deck};
  }
}

}  // namespace tetmend::formats
