// SPDX-License-Identifier: MIT
// The entities of one dimension that a Gmsh file lists, and the sets of groups behind them.
#include "kernel/formats/gmsh_entities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

#include "kernel/formats/set_chains.h"

namespace tetmend::formats {
namespace {

/// Puts those of `more` that are not there behind the others.
void add_missing(std::vector<Label>& groups, std::span<const Label> more) {
  if (more.empty()) return;
  std::unordered_set<Label> known(groups.begin(), groups.end());
  for (const Label group : more) {
    if (known.insert(group).second) groups.push_back(group);
  }
}

}  // namespace

GmshMembership::GmshMembership(const MeshData* data, int dimension, std::size_t elements)
    : sets_(1) {
  if (data == nullptr) return;
  SetChains chains;
  chains.begin();
  std::unordered_set<Label> before;
  for (const Group& group : data->groups) {
    if (group.dimension != dimension || group.members.empty()) continue;
    set_of_.resize(elements);
    const auto number = static_cast<std::uint32_t>(group.number);
    const bool is_new = before.insert(group.number).second;  // so only a member named twice has it
    for (const std::uint32_t element : group.members) {
      std::uint32_t& set = set_of_[element];
      const bool has = set != 0 && (is_new ? chains.last(set) == number : chains.has(set, number));
      if (!has) set = chains.with(set, number);
    }
  }
  sets_.resize(chains.size());
  for (const std::uint32_t set : set_of_) {
    if (set == 0 || !sets_[set].empty()) continue;
    for (const std::uint32_t number : chains.sets(set)) {
      sets_[set].push_back(static_cast<Label>(number));
    }
  }
}

GmshEntities::GmshEntities(const MeshData* data, int dimension) : dimension_(dimension) {
  if (data == nullptr) return;
  for (const Group& group : data->groups) {
    if (group.dimension != dimension) continue;
    for (const Label part : group.parts) groups_of_part_[part].push_back(group.number);
    if (!group.parts.empty() || !group.members.empty()) explicit_groups_.insert(group.number);
  }
  for (const GeometricEntity& entity : data->entities) {
    if (entity.dimension != dimension) continue;
    of_tag_[entity.tag] = static_cast<std::uint32_t>(list_.size());
    const auto number = of_tag_[entity.tag];
    list_.push_back(entity);
    for (const Label group : entity.groups) members_.insert({number, group});
    const auto groups = groups_of_part_.find(entity.tag);
    if (groups == groups_of_part_.end()) continue;
    for (const Label group : groups->second) {
      if (belongs_to(number, group)) continue;
      list_.back().groups.push_back(group);
      members_.insert({number, group});
    }
  }
  listed_ = list_.size();
}

/// An entity may name a group by its number with the other sign.
bool GmshEntities::belongs_to(std::uint32_t entity, Label group) const {
  return members_.contains({entity, group}) || (group > 0 && members_.contains({entity, -group}));
}

std::uint32_t GmshEntities::look_up(const Key& key, std::span<const Label> member_of) {
  const auto [at, is_new] = found_.try_emplace(key, 0);
  if (is_new) at->second = search(key, member_of);
  return at->second;
}

std::uint32_t GmshEntities::search(const Key& key, std::span<const Label> member_of) {
  std::vector<Label> groups;
  std::uint32_t listed = kNone;
  if (key.has_part) {
    const auto of_part = groups_of_part_.find(key.part);
    if (of_part != groups_of_part_.end()) groups = of_part->second;
    const auto of_tag = of_tag_.find(key.part);
    if (of_tag != of_tag_.end()) listed = of_tag->second;
  }
  add_missing(groups, member_of);
  // A label alone makes a group, unless the group says itself what it has.
  const bool makes_group = key.label != 0 && !explicit_groups_.contains(key.label) &&
                           !(listed != kNone && belongs_to(listed, key.label));
  if (makes_group) groups.push_back(key.label);
  const auto has = [&](Label group) { return belongs_to(listed, group); };
  if (listed != kNone && std::all_of(groups.begin(), groups.end(), has)) return listed;
  const auto label = std::find(groups.begin(), groups.end(), key.label);
  if (label != groups.end()) std::rotate(groups.begin(), label, label + 1);
  const auto [at, is_new] =
      created_.try_emplace({key.has_part, key.part, makes_group ? key.label : 0, key.set}, 0);
  if (is_new) at->second = create(key.part, std::move(groups));
  return at->second;
}

std::uint32_t GmshEntities::of_number(Label tag) {
  const auto listed = of_tag_.find(tag);
  if (listed != of_tag_.end()) return listed->second;
  const auto made = of_part_.find(tag);
  return made != of_part_.end() ? made->second : create(tag, {});
}

std::uint32_t GmshEntities::alone_at(const Point& point, std::span<const Label> groups) {
  if (!std::exchange(has_boxes_, true)) {
    for (std::size_t i = 0; i < listed_; ++i) {
      const std::array<double, 6>& box = list_[i].box;
      if (std::any_of(box.begin(), box.end(), [](double x) { return std::isnan(x); })) continue;
      of_box_.emplace(box, static_cast<std::uint32_t>(i));
    }
  }
  const std::set<Label> wanted(groups.begin(), groups.end());
  auto [at, end] =
      of_box_.equal_range({point.x(), point.y(), point.z(), point.x(), point.y(), point.z()});
  for (; at != end; ++at) {
    const std::vector<Label>& own = list_[at->second].groups;
    if (std::set<Label>(own.begin(), own.end()) != wanted) continue;
    const std::uint32_t found = at->second;
    of_box_.erase(at);
    return found;
  }
  return kNone;
}

std::uint32_t GmshEntities::create(Label part, std::vector<Label> groups) {
  GeometricEntity entity;
  entity.dimension = dimension_;
  entity.tag = part;
  entity.groups = std::move(groups);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  entity.box = {kFar, kFar, kFar, -kFar, -kFar, -kFar};
  const auto number = static_cast<std::uint32_t>(list_.size());
  list_.push_back(std::move(entity));
  of_part_.try_emplace(part, number);
  return number;
}

void GmshEntities::extend(std::uint32_t entity, const Point& point) {
  std::array<double, 6>& box = list_[entity].box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = point[static_cast<Eigen::Index>(axis)];
    box[axis] = std::min(box[axis], x);
    box[axis + 3] = std::max(box[axis + 3], x);
  }
}

std::vector<GeometricEntity> GmshEntities::finish() {
  std::set<Label> taken;
  for (std::size_t i = 0; i < listed_; ++i) taken.insert(list_[i].tag);
  std::vector<std::size_t> without_number;
  for (std::size_t i = listed_; i < list_.size(); ++i) {
    if (list_[i].tag <= 0 || !taken.insert(list_[i].tag).second) without_number.push_back(i);
  }
  Label next = 1;
  for (const std::size_t i : without_number) {
    while (!taken.insert(next).second) ++next;
    list_[i].tag = next;
  }
  return std::move(list_);
}

}  // namespace tetmend::formats
