// SPDX-License-Identifier: MIT
// The elements of a Gmsh file as it lists them, and how they become a mesh with groups.
#include "kernel/formats/gmsh_draft.h"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace tetmend::formats {
namespace {

/// Sets of groups, each with a number; set 0 is empty.
class GroupSets {
 public:
  GroupSets() : sets_(1), with_one_{{0, 0}} { number_of_[{}] = 0; }

  const std::vector<Label>& operator[](std::uint32_t set) const { return sets_[set]; }

  std::uint32_t of_one(Label group) {
    if (group == last_) return last_set_;
    last_ = group;
    const auto [at, is_new] = with_one_.try_emplace(group, 0);
    if (is_new) at->second = number({group});
    return last_set_ = at->second;
  }
  /// Of several, in ascending order.
  std::uint32_t of(const std::set<Label>& groups) {
    return number(std::vector<Label>(groups.begin(), groups.end()));
  }

 private:
  std::uint32_t number(std::vector<Label> set) {
    const auto [at, is_new] =
        number_of_.try_emplace(std::move(set), static_cast<std::uint32_t>(sets_.size()));
    if (is_new) sets_.push_back(at->first);
    return at->second;
  }

  std::vector<std::vector<Label>> sets_;  // each in ascending order
  std::map<std::vector<Label>, std::uint32_t> number_of_;
  std::unordered_map<Label, std::uint32_t> with_one_;
  Label last_ = 0;
  std::uint32_t last_set_ = 0;
};

/// Puts the repeated rows of one type together.
class Merger {
 public:
  Merger(GmshRows& rows, std::size_t width, GroupSets& sets)
      : rows_(rows), width_(width), sets_(sets), set_of_(rows.size()), kept_(rows.size(), true) {
    for (std::size_t i = 0; i < rows.size(); ++i) set_of_[i] = sets.of_one(rows.labels[i]);
  }

  /// The set of groups of each row that is left.
  std::vector<std::uint32_t> run() {
    merge_neighbours();
    number_merged();
    merge_apart();
    number_merged();
    drop_merged();
    return std::move(set_of_);
  }

 private:
  // Gmsh lists an element for one group right behind the same element for another.
  void merge_neighbours() {
    std::size_t first = 0;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      const auto a = rows_.vertices_of(first, width_);
      const auto b = rows_.vertices_of(i, width_);
      if (!std::equal(a.begin(), a.end(), b.begin()) || !merge(first, i)) first = i;
    }
  }

  // Other programs list all elements of a group, then all of the next. Only an entity whose
  // elements are not all in the same groups can have such.
  void merge_apart() {
    const std::vector<std::size_t> doubtful = rows_of_mixed_entities();
    std::vector<std::uint32_t> corners;
    for (const std::size_t i : doubtful) {
      const auto v = rows_.vertices_of(i, width_);
      corners.insert(corners.end(), v.begin(), v.end());
      std::sort(corners.end() - static_cast<std::ptrdiff_t>(width_), corners.end());
    }
    const auto corners_of = [&](std::size_t k) {
      return std::span<const std::uint32_t>(corners.data() + k * width_, width_);
    };
    const auto less = [&](std::size_t a, std::size_t b) {
      const auto x = corners_of(a);
      const auto y = corners_of(b);
      return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
    };
    std::vector<std::size_t> order(doubtful.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), less);
    std::size_t first = 0;
    for (std::size_t k = 1; k < order.size(); ++k) {
      if (less(order[first], order[k]) || !merge(doubtful[order[first]], doubtful[order[k]])) {
        first = k;
      }
    }
  }

  std::vector<std::size_t> rows_of_mixed_entities() const {
    std::unordered_map<Label, std::uint32_t> set_of_entity;
    std::set<Label> mixed;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!kept_[i]) continue;
      if (i > 0 && rows_.parts[i] == rows_.parts[i - 1] && set_of_[i] == set_of_[i - 1]) continue;
      const auto [at, is_new] = set_of_entity.try_emplace(rows_.parts[i], set_of_[i]);
      if (!is_new && at->second != set_of_[i]) mixed.insert(rows_.parts[i]);
    }
    std::vector<std::size_t> found;
    if (mixed.empty()) return found;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (kept_[i] && mixed.contains(rows_.parts[i])) found.push_back(i);
    }
    return found;
  }

  /// False if row `i` is no repetition: it is of another entity or names a group once more.
  bool merge(std::size_t first, std::size_t i) {
    if (rows_.parts[first] != rows_.parts[i] || rows_.labels[first] == 0 || rows_.labels[i] == 0) {
      return false;
    }
    std::set<Label>& into = merged_groups(first);
    std::set<Label>& from = merged_groups(i);
    const bool is_smaller = into.size() < from.size();
    const std::set<Label>& fewer = is_smaller ? into : from;
    const std::set<Label>& more = is_smaller ? from : into;
    const auto is_there = [&](Label group) { return more.contains(group); };
    if (std::any_of(fewer.begin(), fewer.end(), is_there)) return false;
    if (is_smaller) into.swap(from);
    into.merge(from);
    merged_.erase(i);
    kept_[i] = false;
    any_merged_ = true;
    return true;
  }

  /// The groups of a row that another may be put to.
  std::set<Label>& merged_groups(std::size_t row) {
    std::set<Label>& groups = merged_[row];
    if (groups.empty()) groups.insert(rows_.labels[row]);
    return groups;
  }

  void number_merged() {
    for (const auto& [row, groups] : merged_) set_of_[row] = sets_.of(groups);
  }

  void drop_merged() {
    if (!any_merged_) return;
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      if (kept_[i]) order.push_back(static_cast<std::uint32_t>(i));
    }
    reorder(rows_.tags, order);
    reorder(rows_.labels, order);
    reorder(rows_.parts, order);
    reorder(rows_.vertices, order, width_);
    reorder(rows_.places, order);
    reorder(set_of_, order);
  }

  GmshRows& rows_;
  std::size_t width_;
  GroupSets& sets_;
  std::vector<std::uint32_t> set_of_;
  std::vector<bool> kept_;
  std::map<std::size_t, std::set<Label>> merged_;  // groups of rows that others were put to
  bool any_merged_ = false;
};

/// Parts of one dimension: one for each entity and set of groups.
class Parts {
 public:
  void reserve(std::span<const Label> entities) {
    Label last = 0;
    for (const Label entity : entities) {
      if (entity != last) taken_.insert(entity);
      last = entity;
    }
  }
  Label part(Label entity, std::uint32_t set) {
    if (entity == last_.first && set == last_.second) return last_part_;
    const auto [at, is_new] = parts_.try_emplace({entity, set}, entity);
    if (is_new && !with_own_number_.insert(entity).second) {
      while (!taken_.insert(++next_).second) {
      }
      at->second = next_;
    }
    last_ = {entity, set};
    return last_part_ = at->second;
  }
  const std::map<std::pair<Label, std::uint32_t>, Label>& all() const { return parts_; }

 private:
  std::set<Label> taken_;
  std::set<Label> with_own_number_;
  std::map<std::pair<Label, std::uint32_t>, Label> parts_;
  std::pair<Label, std::uint32_t> last_{0, UINT32_MAX};
  Label last_part_ = 0;
  Label next_ = 0;
};

template <class Element>
void move_elements(GmshRows& rows, std::vector<Element>& elements, std::vector<Label>& parts,
                   GmshTags& tags) {
  constexpr std::size_t kWidth = std::tuple_size_v<decltype(Element::vertices)>;
  elements.resize(rows.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    std::copy_n(rows.vertices.data() + i * kWidth, kWidth, elements[i].vertices.begin());
    elements[i].label = rows.labels[i];
  }
  parts = std::move(rows.parts);
  tags = GmshTags(std::move(rows.tags));
  rows = {};
}

}  // namespace

void GmshDraft::merge_repeated() {
  GroupSets sets;
  std::array<Parts, 4> parts;
  std::array<std::vector<std::uint32_t>, kGmshTypes> set_of;
  for (int type = 1; type < kGmshTypes; ++type) {
    const auto t = static_cast<std::size_t>(type);
    if (rows[t].size() == 0) continue;
    set_of[t] = Merger(rows[t], gmsh_type(type).width, sets).run();
    parts[static_cast<std::size_t>(gmsh_type(type).dimension)].reserve(rows[t].parts);
  }
  for (int type = 1; type < kGmshTypes; ++type) {
    const auto t = static_cast<std::size_t>(type);
    for (std::size_t i = 0; i < rows[t].size(); ++i) {
      Label& part = rows[t].parts[i];
      part = parts[static_cast<std::size_t>(gmsh_type(type).dimension)].part(part, set_of[t][i]);
    }
  }
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (const auto& [key, part] : parts[static_cast<std::size_t>(dimension)].all()) {
      groups_of[{dimension, part}] = sets[key.second];
    }
  }
}

void GmshDraft::sort() {
  for (int type = 1; type < kGmshTypes; ++type) {
    GmshRows& of_type = rows[static_cast<std::size_t>(type)];
    if (std::is_sorted(of_type.tags.begin(), of_type.tags.end())) continue;
    const auto order = ascending_order(of_type.tags);
    reorder(of_type.tags, order);
    reorder(of_type.labels, order);
    reorder(of_type.parts, order);
    reorder(of_type.vertices, order, gmsh_type(type).width);
    reorder(of_type.places, order);
  }
}

void GmshDraft::move_into(MeshData& mesh, std::array<GmshTags, 3>& tags) {
  add_groups(mesh);
  add_points(mesh);
  move_elements(rows[gmsh_tet], mesh.tets, mesh.tet_parts, tags[0]);
  move_elements(rows[gmsh_triangle], mesh.triangles, mesh.triangle_parts, tags[1]);
  move_elements(rows[gmsh_edge], mesh.edges, mesh.edge_parts, tags[2]);
  for (int type = 1; type < kGmshTypes; ++type) {
    GmshRows& of_type = rows[static_cast<std::size_t>(type)];
    const GmshType& kind = gmsh_type(type);
    if (of_type.size() == 0) continue;
    if (kind.has_own_order()) {
      const std::vector<std::uint32_t> listed = of_type.vertices;
      for (std::size_t i = 0; i < listed.size(); ++i) {
        const std::size_t k = i % kind.width;
        of_type.vertices[i] = listed[i - k + kind.order[k]];
      }
    }
    mesh.other_elements.push_back({kind.vtk_type,
                                   kind.width,
                                   std::move(of_type.vertices),
                                   std::move(of_type.labels),
                                   std::move(of_type.parts),
                                   {},
                                   {}});
  }
}

void GmshDraft::add_groups(MeshData& mesh) {
  mesh.groups = std::move(named);
  std::map<std::pair<int, Label>, std::size_t> known;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    known[{mesh.groups[i].dimension, mesh.groups[i].number}] = i;
  }
  for (const auto& [entity, numbers] : groups_of) {
    for (const Label number : numbers) {
      const auto [at, is_new] = known.try_emplace({entity.first, number}, mesh.groups.size());
      if (is_new) mesh.groups.push_back({entity.first, number, {}, {}, {}});
      // What points belong to says add_points().
      if (entity.first > 0) mesh.groups[at->second].parts.push_back(entity.second);
    }
  }
}

/// Points in groups become members of these; what is left stays among the other elements.
void GmshDraft::add_points(MeshData& mesh) {
  GmshRows& points = rows[gmsh_point];
  std::map<Label, std::size_t> group_of_number;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    if (mesh.groups[i].dimension == 0) group_of_number[mesh.groups[i].number] = i;
  }
  GmshRows rest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto groups = groups_of.find({0, points.parts[i]});
    if (groups == groups_of.end() || groups->second.empty()) {
      rest.tags.push_back(points.tags[i]);
      rest.labels.push_back(points.labels[i]);
      rest.parts.push_back(points.parts[i]);
      rest.vertices.push_back(points.vertices[i]);
      continue;
    }
    for (const Label number : groups->second) {
      mesh.groups[group_of_number[number]].members.push_back(points.vertices[i]);
    }
  }
  points = std::move(rest);
}

}  // namespace tetmend::formats
