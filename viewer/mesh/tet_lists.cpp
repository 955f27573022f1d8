// SPDX-License-Identifier: MIT
#include "viewer/mesh/tet_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetmend::viewer {

void WorstTets::build(std::span<const float> values, std::size_t count) {
  count_ = count;
  kept_.clear();
  limit_.reset();
  for (const TetHandle t : worst_tets(values, kReserve * count)) {
    kept_.emplace_back(values[t.index()], t.index());
  }
  if (kept_.size() == kReserve * count) limit_ = kept_.back();
}

void WorstTets::change(TetHandle t, float before, std::span<const float> values) {
  const auto place_of = [&](const Entry& entry) {
    return std::lower_bound(kept_.begin(), kept_.end(), entry);
  };
  if (!std::isnan(before)) {
    const auto old = place_of({before, t.index()});
    if (old != kept_.end() && *old == Entry(before, t.index())) kept_.erase(old);
  }
  const Entry now(values[t.index()], t.index());
  if (!std::isnan(now.first) && (!limit_ || now <= *limit_)) kept_.insert(place_of(now), now);
  if (limit_ && kept_.size() > 2 * kReserve * count_) {
    kept_.resize(kReserve * count_);
    limit_ = kept_.back();
  }
  if (limit_ && kept_.size() < count_) build(values, count_);
}

std::vector<TetHandle> WorstTets::list() const {
  std::vector<TetHandle> tets;
  for (std::size_t i = 0; i < std::min(count_, kept_.size()); ++i) {
    tets.emplace_back(kept_[i].second);
  }
  return tets;
}

void TetLists::forget() {
  values_.clear();
  listed_.clear();
}

void TetLists::update(const TetMesh& mesh, std::span<const TetHandle> changed) {
  for (auto& [measure, values] : values_) {
    const TetValue& value = find_tet_value(measure);
    constexpr float kNoTet = std::numeric_limits<float>::quiet_NaN();
    const std::size_t slots = mesh.tet_slots();
    values.resize(std::max(slots, values.size()), kNoTet);
    for (const TetHandle t : changed) {
      if (t.index() >= values.size()) continue;
      const float before = values[t.index()];
      values[t.index()] = t.index() < slots ? evaluate_tet(mesh, value, t) : kNoTet;
      if (measure != listed_) continue;
      histogram_.remove(before);
      histogram_.add(values[t.index()]);
      order_.change(t, before, values);
    }
    values.resize(slots);
  }
  worst_ = order_.list();
}

std::span<const float> TetLists::values(const TetMesh& mesh, const std::string& measure) {
  auto found = values_.find(measure);
  if (found == values_.end()) {
    found = values_.emplace(measure, evaluate_tets(mesh, find_tet_value(measure))).first;
  }
  return found->second;
}

const Histogram& TetLists::histogram(const TetMesh& mesh, const std::string& measure) {
  list(mesh, measure);
  return histogram_;
}

const std::vector<TetHandle>& TetLists::worst(const TetMesh& mesh, const std::string& measure) {
  list(mesh, measure);
  return worst_;
}

void TetLists::list(const TetMesh& mesh, const std::string& measure) {
  if (listed_ == measure) return;
  const auto all = values(mesh, measure);
  histogram_ = Histogram(all, find_tet_value(measure).range);
  order_.build(all, kWorstListed);
  worst_ = order_.list();
  listed_ = measure;
}

}  // namespace tetmend::viewer
