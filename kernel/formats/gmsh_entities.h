// SPDX-License-Identifier: MIT
// The entities of one dimension that a Gmsh file lists, and the sets of groups behind them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// In which groups that name their members an element is.
class GmshMembership {
 public:
  /// `data` may be null.
  GmshMembership(const MeshData* data, int dimension, std::size_t elements);

  /// The set that an element is in; 0 is empty.
  std::uint32_t set_of(std::size_t element) const { return set_of_.empty() ? 0 : set_of_[element]; }
  const std::vector<Label>& groups(std::uint32_t set) const { return sets_[set]; }

 private:
  std::vector<std::uint32_t> set_of_;
  std::vector<std::vector<Label>> sets_;
};

/// Finds the entity of an element. In a Gmsh file an entity alone has groups, not an element.
class GmshEntities {
 public:
  /// Begins with the entities of `data`, which may be null.
  GmshEntities(const MeshData* data, int dimension);

  struct Key {
    bool has_part = true;  ///< else `part` is the label
    Label part = 0;
    Label label = 0;
    std::uint32_t set = 0;  ///< of groups
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  /// The entity for elements of this part, with this label and in these groups besides.
  std::uint32_t find(const Key& key, std::span<const Label> member_of) {
    if (last_found_ != kNone && last_ == key) return last_found_;
    last_ = key;
    return last_found_ = look_up(key, member_of);
  }
  /// The entity with this number, which a point names.
  std::uint32_t of_number(Label tag);
  /// An entity of the data that is just this point and in just these groups, each once; else kNone.
  std::uint32_t alone_at(const Point& point, std::span<const Label> groups);
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::size_t size() const { return list_.size(); }
  bool is_new(std::uint32_t entity) const { return entity >= listed_; }
  bool has_groups(std::uint32_t entity) const { return !list_[entity].groups.empty(); }
  void extend(std::uint32_t entity, const Point& point);

  /// The list, in which each entity has a number of its own now.
  std::vector<GeometricEntity> finish();

 private:
  std::uint32_t look_up(const Key& key, std::span<const Label> member_of);
  std::uint32_t search(const Key& key, std::span<const Label> member_of);
  std::uint32_t create(Label part, std::vector<Label> groups);
  bool belongs_to(std::uint32_t entity, Label group) const;

  int dimension_;
  std::vector<GeometricEntity> list_;
  std::size_t listed_ = 0;                             // by the data
  std::map<Label, std::uint32_t> of_tag_;              // those
  std::set<std::pair<std::uint32_t, Label>> members_;  // those, and the groups that they are in
  std::map<Label, std::vector<Label>> groups_of_part_;
  std::set<Label> explicit_groups_;  // which name parts or members
  std::map<Key, std::uint32_t> found_;
  std::map<Key, std::uint32_t> created_;    // by what tells them apart
  std::map<Label, std::uint32_t> of_part_;  // the first that was created for a part
  std::multimap<std::array<double, 6>, std::uint32_t> of_box_;  // those of the data that are free
  bool has_boxes_ = false;
  Key last_;
  std::uint32_t last_found_ = kNone;
};

}  // namespace tetmend::formats
