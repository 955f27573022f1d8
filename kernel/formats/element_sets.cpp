// SPDX-License-Identifier: MIT
// Sets of points and elements that a file lists by number: as groups of a mesh, and from them again.
#include "kernel/formats/element_sets.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/input_file.h"
#include "kernel/formats/new_numbers.h"
#include "kernel/formats/set_chains.h"

namespace tetmend::formats {
namespace {

void make_members_unique(std::vector<std::uint32_t>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

template <class Mesh>
auto& others_of(Mesh& mesh, const ElementKind& kind) {
  return *std::find_if(mesh.other_elements.begin(), mesh.other_elements.end(),
                       [&](const auto& each) { return each.vtk_type == kind.vtk_type; });
}

/// The parts of all elements of a kind.
std::vector<Label>& parts_of(MeshData& mesh, const ElementKind& kind) {
  switch (kind.vtk_type) {
    case vtk_tet:
      return mesh.tet_parts;
    case vtk_triangle:
      return mesh.triangle_parts;
    case vtk_edge:
      return mesh.edge_parts;
    default:
      return others_of(mesh, kind).parts;
  }
}

}  // namespace

ElementPlace last_place(const MeshData& mesh, const ElementKind& kind) {
  const auto number = static_cast<std::uint8_t>(element_kind(kind.vtk_type) - kElementKinds.data());
  const auto last = [&]() -> std::size_t {
    switch (kind.vtk_type) {
      case vtk_tet:
        return mesh.tets.size();
      case vtk_triangle:
        return mesh.triangles.size();
      case vtk_edge:
        return mesh.edges.size();
      default:
        return others_of(mesh, kind).labels.size();
    }
  };
  return {number, static_cast<std::uint32_t>(last() - 1)};
}

std::span<const std::uint32_t> vertices_at(const MeshData& mesh, ElementPlace place) {
  switch (place.of().vtk_type) {
    case vtk_tet:
      return mesh.tets[place.index].vertices;
    case vtk_triangle:
      return mesh.triangles[place.index].vertices;
    case vtk_edge:
      return mesh.edges[place.index].vertices;
    default:
      break;
  }
  const std::size_t width = place.of().width;
  for (const OtherElements& others : mesh.other_elements) {
    if (others.vtk_type == place.of().vtk_type)
      return std::span(others.vertices).subspan(place.index * width, width);
  }
  return {};
}

Label& label_at(MeshData& mesh, ElementPlace place) {
  switch (place.of().vtk_type) {
    case vtk_tet:
      return mesh.tets[place.index].label;
    case vtk_triangle:
      return mesh.triangles[place.index].label;
    case vtk_edge:
      return mesh.edges[place.index].label;
    default:
      return others_of(mesh, place.of()).labels[place.index];
  }
}

bool is_turned_like(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  if (a.size() != b.size() || a.empty()) return false;
  const auto at = std::find(b.begin(), b.end(), a[0]);
  return std::equal(at, b.end(), a.begin()) &&
         std::equal(b.begin(), at, a.end() - (at - b.begin()));
}

bool are_different(std::vector<std::uint32_t> members) {
  std::sort(members.begin(), members.end());
  return std::adjacent_find(members.begin(), members.end()) == members.end();
}

std::uint32_t FacesOnce::add(const ElementRow& row, ElementSorter& sorter, const MeshData& mesh,
                             std::vector<ElementPlace>& elements) {
  std::array<std::uint32_t, 4> corners{};
  corners.fill(UINT32_MAX);
  std::copy_n(row.vertices.begin(), row.kind->corners, corners.begin());
  std::sort(corners.begin(), corners.end());
  const auto next = static_cast<std::uint32_t>(elements.size());
  const auto [at, is_new] = known_.try_emplace(corners, next);
  if (is_new) {
    sorter.add(row, true);
    elements.push_back(last_place(mesh, *row.kind));
  }
  return at->second;
}

LoosePoints::LoosePoints(const MeshData& mesh) : first_(mesh.points.size() + 1, 0) {
  const OtherElements* second = nullptr;
  for (const OtherElements& others : mesh.other_elements) {
    if (others.vtk_type == vtk_tet10) second = &others;
  }
  const auto each_tet = [&](const auto& take) {
    for (const MeshData::Tet& tet : mesh.tets) take(std::span<const std::uint32_t>(tet.vertices));
    if (second == nullptr) return;
    for (std::size_t i = 0; i < second->labels.size(); ++i) {
      take(std::span(second->vertices).subspan(i * second->vertex_count, second->vertex_count));
    }
  };
  each_tet([&](std::span<const std::uint32_t> tet) {
    corners_.push_back({tet[0], tet[1], tet[2], tet[3]});
    for (const std::uint32_t v : tet) ++first_[v + 1];
  });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  tets_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  std::uint32_t number = 0;
  each_tet([&](std::span<const std::uint32_t> tet) {
    for (const std::uint32_t v : tet) tets_[next[v]++] = number;
    ++number;
  });
  is_member_.resize(mesh.points.size(), 0);
}

std::vector<std::uint32_t> LoosePoints::of(const std::vector<std::uint32_t>& members) {
  for (const std::uint32_t v : members) is_member_[v] = 1;
  const auto is_inside = [&](std::uint32_t tet) {
    return std::all_of(corners_[tet].begin(), corners_[tet].end(),
                       [&](std::uint32_t v) { return is_member_[v] != 0; });
  };
  std::vector<std::uint32_t> loose;
  for (const std::uint32_t v : members) {
    const auto begin = tets_.begin() + static_cast<std::ptrdiff_t>(first_[v]);
    const auto end = tets_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]);
    if (std::none_of(begin, end, is_inside)) loose.push_back(v);
  }
  for (const std::uint32_t v : members) is_member_[v] = 0;
  return loose;
}

void number_sets(std::vector<ElementSet>& sets, std::span<const std::int64_t> avoided) {
  std::unordered_set<std::int64_t> taken;
  for (ElementSet& set : sets) {
    const bool is_free =
        set.number > 0 && set.number <= INT32_MAX && taken.insert(set.number).second;
    if (!is_free) set.number = 0;
  }
  taken.insert(avoided.begin(), avoided.end());
  std::int64_t next = 0;
  for (ElementSet& set : sets) {
    if (set.number != 0) continue;
    do {
      ++next;
    } while (taken.contains(next));
    set.number = next;
  }
}

void add_groups(MeshData& mesh, std::span<const ElementPlace> elements,
                std::span<const std::uint32_t> homes, std::vector<ElementSet>& sets) {
  SetChains chains;
  std::map<std::pair<int, std::uint32_t>, std::uint32_t> begin;  // of dimension and home
  std::vector<std::uint32_t> part(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto [at, is_new] =
        begin.try_emplace({elements[i].of().dimension, homes.empty() ? 0 : homes[i]}, 0);
    if (is_new) at->second = chains.begin();
    part[i] = at->second;
  }
  for (std::uint32_t s = 0; s < sets.size(); ++s) {
    make_members_unique(sets[s].points);
    make_members_unique(sets[s].elements);
    for (const std::uint32_t element : sets[s].elements) {
      part[element] = chains.with(part[element], s);
    }
  }
  std::vector<int> dimension_of(chains.size(), -1);  // -1: no element has this part
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const ElementKind& kind = elements[i].of();
    dimension_of[part[i]] = kind.dimension;
    parts_of(mesh, kind).push_back(static_cast<Label>(part[i] + 1));
  }
  std::vector<std::array<std::vector<Label>, 4>> parts_of_set(sets.size());
  for (std::uint32_t p = 0; p < dimension_of.size(); ++p) {
    if (dimension_of[p] < 0) continue;
    for (const std::uint32_t s : chains.sets(p)) {
      parts_of_set[s][static_cast<std::size_t>(dimension_of[p])].push_back(
          static_cast<Label>(p + 1));
    }
  }
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const auto number = static_cast<Label>(sets[s].number);
    if (!sets[s].points.empty())
      mesh.groups.push_back({0, number, sets[s].name, {}, sets[s].points});
    bool is_empty = sets[s].points.empty();
    for (int dimension = 1; dimension < 4; ++dimension) {
      auto& parts = parts_of_set[s][static_cast<std::size_t>(dimension)];
      if (parts.empty()) continue;
      mesh.groups.push_back({dimension, number, sets[s].name, std::move(parts), {}});
      is_empty = false;
    }
    if (!is_empty) continue;
    mesh.notes.push_back(
        fmt::format("the set {} has no members: not kept", in_quotes(sets[s].name)));
  }
}

std::vector<GroupMembers> members_of_groups(const MeshView& mesh, const ElementLists& lists) {
  if (mesh.data() == nullptr) return {};
  const std::vector<Group>& groups = mesh.data()->groups;
  std::vector<GroupMembers> members(groups.size());
  using GroupsOf = std::unordered_map<Label, std::vector<std::uint32_t>>;
  std::array<GroupsOf, 4> by_part, by_label;
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    const auto dimension = static_cast<std::size_t>(group.dimension);
    for (const Label part : group.parts) by_part[dimension][part].push_back(g);
    if (!group.parts.empty()) continue;
    if (group.members.empty()) {
      by_label[dimension][group.number].push_back(g);
    } else if (dimension == 0) {
      members[g].points = group.members;
    }
  }
  for (std::uint32_t i = 0; i < mesh.point_count() && !by_label[0].empty(); ++i) {
    const auto found = by_label[0].find(mesh.point_label(i));
    if (found == by_label[0].end()) continue;
    for (const std::uint32_t g : found->second) members[g].points.push_back(i);
  }
  for (std::uint32_t k = 0; k < lists.all().size(); ++k) {
    const ElementList& list = lists.all()[k];
    const auto dimension = static_cast<std::size_t>(list.kind.dimension);
    const auto take = [&](const GroupsOf& groups_of, Label key, std::uint32_t i) {
      const auto found = groups_of.find(key);
      if (found == groups_of.end()) return;
      for (const std::uint32_t g : found->second) members[g].elements.push_back({k, i});
    };
    for (std::uint32_t i = 0; i < list.count; ++i) {
      if (list.parts != nullptr) take(by_part[dimension], (*list.parts)[i], i);
      if (!by_label[dimension].empty()) take(by_label[dimension], list.label(i), i);
    }
    const bool is_plain = list.others == nullptr;  // members are of tets, triangles and edges
    for (std::uint32_t g = 0; g < groups.size() && is_plain; ++g) {
      if (groups[g].dimension != list.kind.dimension) continue;
      for (const std::uint32_t i : groups[g].members) members[g].elements.push_back({k, i});
    }
  }
  return members;
}

std::vector<std::int64_t> written_point_numbers(const MeshView& mesh,
                                                std::span<const std::int64_t> limits) {
  std::vector<std::int64_t> known;
  std::span<const NumberRange> of_file;
  if (mesh.data() != nullptr) {
    known = mesh.data()->point_numbers;
    of_file = mesh.data()->taken_point_numbers;
  }
  std::vector<std::int64_t> numbers = known;
  NewNumbers next = numbers_beside(known, of_file, limits);
  numbers.resize(mesh.point_count(), 0);
  complete(numbers, next);
  return numbers;
}

std::vector<std::vector<std::int64_t>> written_element_numbers(
    const ElementLists& lists, std::span<const std::int64_t> limits) {
  std::vector<std::vector<std::int64_t>> numbers;
  std::vector<std::int64_t> known;
  std::span<const NumberRange> of_file = lists.taken_numbers();
  for (const ElementList& list : lists.all()) {
    auto& of_list = numbers.emplace_back();
    if (list.numbers != nullptr) of_list = *list.numbers;
    of_list.resize(list.count, 0);
    std::copy_if(of_list.begin(), of_list.end(), std::back_inserter(known),
                 [](std::int64_t number) { return number > 0; });
  }
  std::sort(known.begin(), known.end());
  if (std::adjacent_find(known.begin(), known.end()) != known.end()) {
    known.clear();
    of_file = {};
    for (auto& of_list : numbers) std::fill(of_list.begin(), of_list.end(), 0);
  }
  NewNumbers next = numbers_beside(known, of_file, limits);
  for (auto& of_list : numbers) complete(of_list, next);
  return numbers;
}

}  // namespace tetmend::formats
