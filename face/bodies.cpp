// SPDX-License-Identifier: MIT
//   kinds: label and part of each tet -> a slot for each point and kind of tets there, those of a tet in one
//   set -> sets are bodies
#include "face/bodies.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include <tetmend/improve.h>

namespace tetmend::face {

namespace {

std::vector<std::uint32_t> all_tets(const MeshData& data) {
  std::vector<std::uint32_t> all(data.tets.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

Bodies::Bodies(const MeshData& data) : Bodies(data, all_tets(data)) {}

Bodies::Bodies(const MeshData& data, std::span<const std::uint32_t> tets) : data_(data) {
  number_kinds(tets);
  find_slots(tets);
  number_bodies();
}

void Bodies::number_kinds(std::span<const std::uint32_t> tets) {
  using Kind = std::pair<Label, Label>;
  const auto kind_of = [this](std::uint32_t t) -> Kind {
    return {data_.tets[t].label, data_.tet_parts.empty() ? 0 : data_.tet_parts[t]};
  };
  if (tets.empty()) return;
  kind_labels_ = {data_.tets[tets[0]].label};
  std::size_t i = 1;
  while (i < tets.size() && kind_of(tets[i]) == kind_of(tets[0])) ++i;
  if (i == tets.size()) return;
  std::map<Kind, std::uint32_t> numbers = {{kind_of(tets[0]), 0}};
  kinds_.assign(data_.tets.size(), 0);
  for (; i < tets.size(); ++i) {
    const std::uint32_t t = tets[i];
    const std::uint32_t before = tets[i - 1];
    if (kind_of(t) == kind_of(before)) {
      kinds_[t] = kinds_[before];
      continue;
    }
    const auto next = static_cast<std::uint32_t>(numbers.size());
    kinds_[t] = numbers.try_emplace(kind_of(t), next).first->second;
    if (kinds_[t] == kind_labels_.size()) kind_labels_.push_back(data_.tets[t].label);
  }
}

/// Until bodies are numbered, `body_of_` has a slot of the same set that is nearer to its root.
void Bodies::find_slots(std::span<const std::uint32_t> tets) {
  first_kind_.assign(data_.points.size(), kNone);
  body_of_.resize(data_.points.size());
  std::iota(body_of_.begin(), body_of_.end(), 0U);
  std::vector<std::uint32_t> mixed;  // tets with points whose first tet is of another kind
  for (const std::uint32_t t : tets) {
    const auto& vertices = data_.tets[t].vertices;
    const std::uint32_t kind = kind_of(t);
    bool is_mixed = false;
    for (const std::uint32_t v : vertices) {
      if (first_kind_[v] == kNone) first_kind_[v] = kind;
      is_mixed |= first_kind_[v] != kind;
    }
    if (is_mixed) {
      mixed.push_back(t);
    } else {
      join(vertices);
    }
  }
  for (const std::uint32_t t : mixed) {
    for (const std::uint32_t v : data_.tets[t].vertices) {
      if (first_kind_[v] != kinds_[t]) further_.push_back({v, kinds_[t]});
    }
  }
  std::sort(further_.begin(), further_.end());
  further_.erase(std::unique(further_.begin(), further_.end()), further_.end());
  if (!further_.empty()) has_further_.assign(data_.points.size(), 0);
  for (const Further& each : further_) {
    has_further_[each.point] = 1;
    body_of_.push_back(static_cast<std::uint32_t>(body_of_.size()));
  }
  for (const std::uint32_t t : mixed) {
    std::array<std::uint32_t, 4> slots = data_.tets[t].vertices;
    for (std::uint32_t& v : slots) v = slot_of(v, kinds_[t]);
    join(slots);
  }
}

std::uint32_t Bodies::slot_of(std::uint32_t point, std::uint32_t kind) const {
  if (first_kind_[point] == kind) return point;
  const auto found = std::lower_bound(further_.begin(), further_.end(), Further{point, kind});
  return static_cast<std::uint32_t>(data_.points.size() +
                                    static_cast<std::size_t>(found - further_.begin()));
}

std::uint32_t Bodies::root_of(std::uint32_t slot) {
  while (body_of_[slot] != slot) slot = body_of_[slot] = body_of_[body_of_[slot]];
  return slot;
}

void Bodies::join(const std::array<std::uint32_t, 4>& slots) {
  std::uint32_t root = root_of(slots[0]);
  for (std::size_t i = 1; i < 4; ++i) {
    if (body_of_[slots[i]] == root) continue;
    const std::uint32_t other = root_of(slots[i]);
    const auto [low, high] = std::minmax(root, other);
    body_of_[high] = low;
    root = low;
  }
}

/// A root is the lowest of its set, so it comes first.
void Bodies::number_bodies() {
  const std::size_t points = data_.points.size();
  for (std::uint32_t slot = 0; slot < body_of_.size(); ++slot) body_of_[slot] = root_of(slot);
  std::vector<std::uint32_t> numbers(body_of_.size(), kNone);
  for (std::size_t slot = 0; slot < body_of_.size(); ++slot) {
    const std::uint32_t kind = slot < points ? first_kind_[slot] : further_[slot - points].kind;
    if (kind == kNone || numbers[body_of_[slot]] != kNone) continue;
    numbers[body_of_[slot]] = static_cast<std::uint32_t>(labels_.size());
    labels_.push_back(kind_labels_[kind]);
  }
  for (std::uint32_t& body : body_of_) body = numbers[body];
}

std::uint32_t Bodies::of_tet(std::uint32_t tet) const {
  return body_of_[slot_of(data_.tets[tet].vertices[0], kind_of(tet))];
}

template <class Act>
void Bodies::for_bodies_at(std::uint32_t point, const Act& act) const {
  if (body_of_[point] != kNone) act(body_of_[point]);
  if (!has_further(point)) return;
  auto next = std::lower_bound(further_.begin(), further_.end(), Further{point, 0});
  for (; next != further_.end() && next->point == point; ++next) {
    act(body_of_[data_.points.size() + static_cast<std::size_t>(next - further_.begin())]);
  }
}

std::uint32_t Bodies::of_point(std::uint32_t point, Label label) const {
  std::uint32_t found = kNone;
  std::size_t count = 0;
  for_bodies_at(point, [&](std::uint32_t body) {
    if (labels_[body] != label) return;
    found = body;
    ++count;
  });
  return count == 1 ? found : kNone;
}

/// The body of all of these points, if each has one alone; kNone where some have several or differ.
std::uint32_t Bodies::only_one_of(std::span<const std::uint32_t> points, Label label) const {
  std::uint32_t found = kNone;
  for (const std::uint32_t point : points) {
    const std::uint32_t body = body_of_[point];
    if (body == kNone || labels_[body] != label || has_further(point)) return kNone;
    if (found != kNone && found != body) return kNone;
    found = body;
  }
  return found;
}

void Bodies::common(std::span<const std::uint32_t> points, Label label,
                    std::vector<std::uint32_t>& found) const {
  found.clear();
  if (const std::uint32_t one = only_one_of(points, label); one != kNone) {
    found.push_back(one);
    return;
  }
  std::vector<std::uint32_t> here;
  bool is_first = true;
  for (const std::uint32_t point : points) {
    here.clear();
    for_bodies_at(point, [&](std::uint32_t body) {
      if (labels_[body] == label) here.push_back(body);
    });
    if (here.empty()) continue;
    std::sort(here.begin(), here.end());
    if (std::exchange(is_first, false)) {
      found = here;
    } else {
      std::erase_if(found, [&](std::uint32_t body) {
        return !std::binary_search(here.begin(), here.end(), body);
      });
    }
  }
  if (!found.empty()) return;
  for (std::uint32_t body = 0; body < labels_.size(); ++body) {
    if (labels_[body] == label) found.push_back(body);
  }
}

bool Bodies::have_one_in_common(std::span<const std::uint32_t> points) const {
  bool found = false;
  for_bodies_at(points[0], [&](std::uint32_t body) {
    found = found || std::all_of(points.begin() + 1, points.end(), [&](std::uint32_t point) {
              bool is_there = false;
              for_bodies_at(point, [&](std::uint32_t other) { is_there |= other == body; });
              return is_there;
            });
  });
  return found;
}

namespace {

/// Points of tets of different labels.
std::vector<char> points_between_labels(const std::vector<MeshData::Tet>& tets,
                                        std::span<const std::uint32_t> which, std::size_t points) {
  constexpr char kOne = 1;
  constexpr char kSeveral = 2;
  std::vector<char> state(points, 0);
  std::vector<Label> labels(points, 0);
  for (const std::uint32_t t : which) {
    for (const std::uint32_t v : tets[t].vertices) {
      if (state[v] == 0) labels[v] = tets[t].label;
      state[v] = state[v] != kSeveral && labels[v] == tets[t].label ? kOne : kSeveral;
    }
  }
  for (char& each : state) each = each == kSeveral ? 1 : 0;
  return state;
}

}  // namespace

void spread_anchors(const std::vector<MeshData::Tet>& tets, std::span<const std::uint32_t> which,
                    const std::function<bool(std::uint32_t, Label)>& may_lead,
                    std::vector<std::uint32_t>& anchors) {
  const auto has_none = [&](std::uint32_t v) { return anchors[v] == Bodies::kNone; };
  std::vector<std::uint32_t> open;  // tets that may get on
  for (const std::uint32_t t : which) {
    const auto& vertices = tets[t].vertices;
    if (std::any_of(vertices.begin(), vertices.end(), has_none)) open.push_back(t);
  }
  if (open.empty()) return;
  const std::vector<char> is_between = points_between_labels(tets, which, anchors.size());
  const auto is_open = [&](std::uint32_t v) { return has_none(v) && is_between[v] == 0; };
  for (bool gets_on = true; gets_on;) {
    gets_on = false;
    std::erase_if(open, [&](std::uint32_t t) {
      const auto& vertices = tets[t].vertices;
      if (std::none_of(vertices.begin(), vertices.end(), is_open)) return true;
      std::uint32_t lead = Bodies::kNone;
      for (const std::uint32_t v : vertices) {
        const std::uint32_t anchor = anchors[v];
        if (anchor < lead && may_lead(anchor, tets[t].label)) lead = anchor;
      }
      if (lead == Bodies::kNone) return false;
      for (const std::uint32_t v : vertices) {
        if (is_open(v)) anchors[v] = lead;
      }
      gets_on = true;
      return true;
    });
  }
}

Origins::Origins(const MeshData& now, std::span<const std::uint32_t> old_point,
                 std::span<const std::uint32_t> changed, Bodies bodies)
    : now_(now),
      bodies_(std::move(bodies)),
      anchors_(old_point.begin(), old_point.end()),
      tet_at_(now.points.size(), kGone) {
  static_assert(kGone == Bodies::kNone);
  for (const std::uint32_t t : changed) {
    for (const std::uint32_t v : now.tets[t].vertices) tet_at_[v] = std::min(tet_at_[v], t);
  }
  const bool is_one = bodies_.count() == 1;
  const auto may_lead = [&](std::uint32_t point, Label label) {
    return is_one || bodies_.of_point(point, label) != Bodies::kNone;
  };
  spread_anchors(now.tets, changed, may_lead, anchors_);
}

void Origins::of_tet(std::uint32_t tet, Origin& origin) const {
  origin.clear();
  for (const std::uint32_t v : now_.tets[tet].vertices) {
    if (anchors_[v] != Bodies::kNone) origin.points.push_back(anchors_[v]);
  }
  if (bodies_.count() > 1) bodies_.common(origin.points, now_.tets[tet].label, origin.bodies);
}

void Origins::of_point(std::uint32_t point, Origin& origin) const {
  origin.clear();
  if (tet_at_[point] != kGone) of_tet(tet_at_[point], origin);
}

bool Origins::may_be_one(std::span<const std::uint32_t> made,
                         std::span<const std::uint32_t> old) const {
  if (bodies_.count() == 1) return true;
  std::vector<std::uint32_t> points(old.begin(), old.end());
  for (const std::uint32_t v : made) {
    if (anchors_[v] != Bodies::kNone) points.push_back(anchors_[v]);
  }
  return bodies_.have_one_in_common(points);
}

}  // namespace tetmend::face
