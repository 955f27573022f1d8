// SPDX-License-Identifier: MIT
#include "trace/recorded_measures.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace tetmend {

namespace {

std::uint64_t scatter(std::uint64_t state, double value) {
  state = (state ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
  return state ^ (state >> 29);
}

/// The same for every order of the four.
std::uint64_t key_of(const std::array<Point, 4>& tet) {
  std::uint64_t sum = 0;
  for (const Point& p : tet) {
    std::uint64_t state = 0x243F6A8885A308D3u;
    for (int axis = 0; axis < 3; ++axis) state = scatter(state, p[axis]);
    sum += state * 0xBF58476D1CE4E5B9u;
  }
  return sum;
}

}  // namespace

/// Qualities by the key of a tet, in ascending order once all are there.
struct RecordedMeasures::Table {
  std::vector<std::pair<std::uint64_t, Quality>> values;

  std::optional<Quality> find(const std::array<Point, 4>& tet) const {
    const std::uint64_t key = key_of(tet);
    const auto at =
        std::lower_bound(values.begin(), values.end(), key,
                         [](const auto& value, std::uint64_t k) { return value.first < k; });
    if (at == values.end() || at->first != key) return std::nullopt;
    return at->second;
  }
};

auto RecordedMeasures::find(const Standard& standard) const -> const Measure* {
  const OwnMeasure& own = *standard.own();
  for (const Measure& known : measures_) {
    const OwnMeasure& other = *known.standard.own();
    if (other.name == own.name && other.good == own.good) return &known;
  }
  return nullptr;
}

auto RecordedMeasures::find_or_add(const Standard& standard) -> Measure& {
  if (const Measure* known = find(standard))
    return measures_[static_cast<std::size_t>(known - measures_.data())];
  const auto table = std::make_shared<Table>();
  const Standard angles = standard.of_angles();
  OwnMeasure measure{standard.own()->name, standard.own()->good, {}};
  measure.evaluate = [table, angles, good = measure.good](const Point& a, const Point& b,
                                                          const Point& c, const Point& d) {
    const std::optional<Quality> noted = table->find({a, b, c, d});
    return good * (noted ? double{*noted} : angles.quality(a, b, c, d));
  };
  measures_.push_back({Standard::of(std::move(measure), standard.goal(), standard.price()), table});
  return measures_.back();
}

Standard RecordedMeasures::known(const Standard& standard) {
  if (standard.is_own()) find_or_add(standard);
  return of(standard);
}

Standard RecordedMeasures::of(const Standard& standard) const {
  const Measure* known = standard.is_own() ? find(standard) : nullptr;
  if (known == nullptr) return standard;
  return known->standard.with_goal(standard.goal()).with_price(standard.price());
}

void RecordedMeasures::note(const Standard& standard, const std::array<Point, 4>& tet,
                            Quality quality) {
  find_or_add(standard).table->values.emplace_back(key_of(tet), quality);
}

void RecordedMeasures::complete() {
  for (Measure& measure : measures_) {
    auto& values = measure.table->values;
    std::stable_sort(values.begin(), values.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    values.erase(std::unique(values.begin(), values.end(),
                             [](const auto& a, const auto& b) { return a.first == b.first; }),
                 values.end());
    values.shrink_to_fit();
  }
}

}  // namespace tetmend
