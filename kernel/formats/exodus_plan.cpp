// SPDX-License-Identifier: MIT
// How a mesh becomes blocks and sets of Exodus II.
#include "kernel/formats/exodus_plan.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "kernel/formats/exodus_tables.h"
#include "kernel/formats/face_sides.h"

namespace tetmend::formats {
namespace {

void number_all(ExodusPlan::Sets& sets) {
  std::vector<ElementSet> all;
  for (const auto& [set, members] : sets) all.push_back(set);
  number_sets(all);
  for (std::size_t s = 0; s < sets.size(); ++s) sets[s].first = std::move(all[s]);
}

/// Of labels or groups: the numbers that a file of Exodus had for them.
std::map<Label, std::int64_t> numbers_of_file(const MeshData* mesh, std::string_view what) {
  std::map<Label, std::int64_t> numbers;
  for (const std::string& piece : exodus_pieces(mesh, what)) {
    char* end = nullptr;
    const auto ours = static_cast<Label>(std::strtol(piece.c_str(), &end, 10));
    numbers[ours] = std::strtoll(end, nullptr, 10);
  }
  return numbers;
}

/// From 1: the side of a volume that has all corners of a face.
std::int32_t side_number(const ElementList& list, std::size_t volume,
                         std::span<const std::uint32_t> face) {
  const auto sides = exodus_sides(list.kind);
  const auto vertices = list.vertices(volume);
  const auto found = std::find_if(sides.begin(), sides.end(), [&](const FaceCorners& side) {
    return std::all_of(side.begin(), side.end(), [&](std::uint8_t corner) {
      return corner == kNoCorner ||
             std::find(face.begin(), face.end(), vertices[corner]) != face.end();
    });
  });
  return static_cast<std::int32_t>(found - sides.begin() + 1);
}

}  // namespace

std::vector<std::string> exodus_pieces(const MeshData* mesh, std::string_view what) {
  std::vector<std::string> found;
  if (mesh == nullptr || mesh->variant != kExodus) return found;
  for (const std::string& piece : mesh->deck) {
    const std::size_t end = piece.find('\0');
    if (end != std::string::npos && std::string_view(piece).substr(0, end) == what)
      found.push_back(piece.substr(end + 1));
  }
  return found;
}

/// Of arrays of one list that are called the same, each is one of its own.
ExodusVariables::Key ExodusVariables::key(const std::vector<DataArray>& arrays, std::size_t a) {
  const DataArray& array = arrays[a];
  const auto end = arrays.begin() + static_cast<std::ptrdiff_t>(a);
  return {array.name, array.components,
          std::count_if(arrays.begin(), end, [&](const DataArray& before) {
            return before.name == array.name && before.components == array.components;
          })};
}

void ExodusVariables::add(const std::vector<DataArray>& arrays) {
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    if (!first_.try_emplace(key(arrays, a), names_.size()).second) continue;
    for (std::string& name : component_names(arrays[a], kExodusAxes, taken_))
      names_.push_back(std::move(name));
  }
}

ExodusPlan::ExodusPlan(const MeshView& mesh, const ElementLists& lists)
    : mesh_(mesh), lists_(lists), members_(members_of_groups(mesh, lists)) {
  collect_blocks();
  collect_sets();
  number_blocks();
}

/// All but triangles and quadrilaterals that are faces of volumes, and were no elements before.
void ExodusPlan::collect_blocks() {
  const std::map<Label, std::int64_t> shells = numbers_of_file(mesh_.data(), kShellNumbers);
  const auto sides = find_face_sides(mesh_, lists_);
  std::size_t surface = 0;
  is_side_.resize(lists_.all().size());
  place.resize(lists_.all().size());
  std::map<std::pair<std::uint32_t, Label>, std::size_t> block_of;
  for (std::uint32_t k = 0; k < lists_.all().size(); ++k) {
    const ElementList& list = lists_.all()[k];
    const auto* of_list = list.kind.dimension == 2 ? &sides[surface++] : nullptr;
    is_side_[k].resize(list.count, false);
    place[k].resize(list.count);
    for (std::uint32_t i = 0; i < list.count; ++i) {
      const Label label = list.label(i);
      if (of_list != nullptr) {
        const FaceSides at = (*of_list)[i];
        is_side_[k][i] = at.behind != kNoElement || at.front != kNoElement;
        if (is_side_[k][i]) volume_of_[{k, i}] = at.behind != kNoElement ? at.behind : at.front;
        if (is_side_[k][i] && !shells.contains(label)) continue;
      }
      const auto [at, is_new] = block_of.try_emplace({k, label}, blocks.size());
      if (is_new) blocks.push_back({&list, k, label, {}, {label, {}, {}, {}}});
      blocks[at->second].elements.push_back(i);
    }
  }
  std::uint32_t next = 0;
  for (const Block& block : blocks) {
    for (const std::uint32_t i : block.elements) place[block.list_number][i] = ++next;
  }
  count = next;
}

/// A new number is none of a side set, whose faces it would be read as.
void ExodusPlan::number_blocks() {
  const std::map<Label, std::int64_t> shells = numbers_of_file(mesh_.data(), kShellNumbers);
  std::vector<std::int64_t> of_sides;
  for (const auto& [set, members] : side_sets) of_sides.push_back(set.number);
  std::vector<ElementSet> sets;
  for (const Block& block : blocks) {
    sets.push_back(block.set);
    if (block.list->kind.dimension != 2) continue;
    std::int64_t& number = sets.back().number;
    if (const auto shell = shells.find(block.label); shell != shells.end()) {
      number = shell->second;
    } else if (std::find(of_sides.begin(), of_sides.end(), number) != of_sides.end()) {
      number = 0;
    }
  }
  number_sets(sets, of_sides);
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b].set = std::move(sets[b]);
}

/// A group of all elements of some blocks, and of no others, names them if it is one block.
ExodusPlan::Block* ExodusPlan::block_of_group(const Members& elements) {
  if (elements.empty() || place[elements[0].list][elements[0].index] == 0) return nullptr;
  for (Block& block : blocks) {
    const bool fits = block.list_number == elements[0].list &&
                      block.elements.size() == elements.size() && block.set.name.empty();
    const auto is_member = [&](const GroupMembers::Member& member) {
      return member.list == block.list_number && block.list->label(member.index) == block.label;
    };
    if (fits && std::all_of(elements.begin(), elements.end(), is_member)) return &block;
  }
  return nullptr;
}

void ExodusPlan::collect_sets() {
  UniqueNames changed(kExodusNames);
  std::vector<std::vector<bool>> is_named(lists_.all().size());
  for (std::size_t k = 0; k < is_named.size(); ++k) is_named[k].resize(lists_.all()[k].count);
  const auto numbers = numbers_of_file(mesh_.data(), kElementSetNumbers);
  for (std::size_t g = 0; g < members_.size(); ++g) {
    if (group(g).name.empty() && group(g).dimension > 0) continue;  // it is a label
    std::string name = group(g).name;
    if (!name.empty() && !is_exodus_name(name)) name = changed.make_fit(name);
    ElementSet set{group(g).number, std::move(name), members_[g].points, {}};
    if (group(g).dimension == 0) {
      if (members_[g].points.empty()) continue;  // classic netCDF has no dimension of length 0
      node_sets.push_back(std::move(set));
      continue;
    }
    if (Block* block = block_of_group(members_[g].elements)) {
      block->set.name = set.name;
      continue;
    }
    Members sides, elements;
    for (const auto& [k, i] : members_[g].elements) {
      (is_side_[k][i] ? sides : elements).push_back({k, i});
      is_named[k][i] = true;
    }
    if (!sides.empty()) side_sets.emplace_back(set, std::move(sides));
    const auto known = numbers.find(group(g).number);
    if (known != numbers.end()) set.number = known->second;
    if (!elements.empty()) element_sets.emplace_back(set, std::move(elements));
  }
  add_unnamed_faces(is_named);
  number_sets(node_sets);
  number_all(side_sets);
  number_all(element_sets);
}

void ExodusPlan::add_unnamed_faces(const std::vector<std::vector<bool>>& is_named) {
  std::map<Label, std::size_t> of_label;
  for (std::uint32_t k = 0; k < lists_.all().size(); ++k) {
    for (std::uint32_t i = 0; i < lists_.all()[k].count; ++i) {
      if (!is_side_[k][i] || is_named[k][i] || place[k][i] != 0) continue;
      const Label label = lists_.all()[k].label(i);
      const auto [at, is_new] = of_label.try_emplace(label, side_sets.size());
      if (is_new) side_sets.push_back({{label, {}, {}, {}}, {}});
      side_sets[at->second].second.push_back({k, i});
    }
  }
}

std::pair<std::size_t, std::string> ExodusPlan::new_labels() const {
  const auto shells = numbers_of_file(mesh_.data(), kShellNumbers);
  std::size_t changed = 0;
  std::string first;
  std::optional<std::int64_t> of_none;  // sides and shells without a label should be alike
  const auto look = [&](const ElementList& list, Label label, std::int64_t number) {
    const bool is_split =
        label == 0 && list.kind.dimension == 2 && of_none.value_or(number) != number;
    if (label == 0 && list.kind.dimension == 2) of_none = number;
    if (number == label || (label == 0 && !is_split)) return;
    if (changed++ == 0)
      first = fmt::format("{} of kind '{}' becomes {}", label, list.kind.name, number);
  };
  for (const Block& block : blocks) {
    const bool is_of_file = block.list->kind.dimension == 2 && shells.contains(block.label);
    if (!is_of_file) look(*block.list, block.label, block.set.number);
  }
  for (const auto& [set, faces] : side_sets) {
    const ElementList& list = lists_.all()[faces[0].list];
    if (set.name.empty()) look(list, list.label(faces[0].index), set.number);
  }
  return {changed, first};
}

std::pair<std::int32_t, std::int32_t> ExodusPlan::side(const GroupMembers::Member& face) const {
  std::uint32_t number = volume_of_.at({face.list, face.index});
  std::size_t volume = 0;
  while (lists_.all()[volume].kind.dimension < 3 || number >= lists_.all()[volume].count) {
    const ElementList& list = lists_.all()[volume++];
    if (list.kind.dimension == 3) number -= static_cast<std::uint32_t>(list.count);
  }
  return {static_cast<std::int32_t>(place[volume][number]),
          side_number(lists_.all()[volume], number, lists_.all()[face.list].vertices(face.index))};
}

}  // namespace tetmend::formats
