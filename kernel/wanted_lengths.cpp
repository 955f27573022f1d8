// SPDX-License-Identifier: MIT
#include "kernel/wanted_lengths.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tetmend {

namespace {

std::size_t hash_of_point(const Point& p) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;
  std::uint64_t hash = 0;
  for (const double x : {p.x(), p.y(), p.z()}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * kOdd;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

double WantedLengths::length(const Point& p) const {
  if (!at_) return everywhere_;
  std::vector<Asked>& asked = asked_.local();
  if (asked.empty()) asked.resize(kAsked);
  Asked& entry = asked[hash_of_point(p) % kAsked];
  if (entry.place != p) {
    entry.length = at_(p);
    entry.place = p;
  }
  return entry.length;
}

double WantedLengths::relative_length(const Point& a, const Point& b) const {
  return relative_length(a, b, (b - a).norm(), length(a), length(b));
}

/// @param length,at_a,at_b of the edge, and wanted at its ends
double WantedLengths::relative_length(const Point& a, const Point& b, double length, double at_a,
                                      double at_b) const {
  const double by_ends = relative_length(length, at_a, at_b);
  if (!at_ || by_ends <= kMost) return by_ends;
  constexpr double kMuch = 1.5;  // far beyond what samples of a linear field are off by
  // Where lengths fall from both ends as steeply as they may, the mean of 1 / wanted is -log(1 - u) / u of
  // that at the shorter end, u = steepest length / (2 at the end): less than kMuch below that.
  constexpr double kFlat = 1.16;
  if (steepest_ * length <= kFlat * std::min(at_a, at_b)) return by_ends;
  const double between = length * sampled(a, b);
  return between > kMuch * by_ends ? between : by_ends;
}

/// The mean of 1 / wanted along the edge: ends that want long edges say nothing of what lies between.
double WantedLengths::sampled(const Point& a, const Point& b) const {
  constexpr int kParts = 8;
  if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) return sampled(b, a);
  double sum = 0;
  for (int i = 0; i <= kParts; ++i) {
    const double weight = i == 0 || i == kParts ? 0.5 : 1;
    sum += weight / this->length(a + i / double{kParts} * (b - a));
  }
  return sum / kParts;
}

/// The integral of 1 / wanted along the edge: the logarithmic mean of the ends.
double WantedLengths::relative_length(double length, double wanted_at_a, double wanted_at_b) {
  const double ratio = wanted_at_b / wanted_at_a;
  constexpr double kNearlyOne = 1e-4;  // where the mean of both is as good as rounding allows
  if (std::abs(ratio - 1) < kNearlyOne) return 2 * length / (wanted_at_a + wanted_at_b);
  return length * std::log(ratio) / (wanted_at_b - wanted_at_a);
}

double WantedLengths::fit(double relative_length) {
  return std::min({1.0, relative_length / kLeast, kMost / relative_length});
}

Point WantedLengths::middle(const Point& a, const Point& b) const {
  const double root_a = std::sqrt(length(a));
  const double root_b = std::sqrt(length(b));
  return a + root_a / (root_a + root_b) * (b - a);
}

std::vector<Quality> WantedLengths::misfits(std::span<const EdgePlaces> edges) const {
  std::vector<Quality> misfits;
  for (const auto& [a, b] : edges) {
    const double length = (b - a).norm();
    const double at_a = this->length(a);
    const double at_b = this->length(b);
    // Most are in range by either end, and so by what lies between: without a logarithm.
    if (length >= kLeast * std::max(at_a, at_b) && length <= kMost * std::min(at_a, at_b)) continue;
    const double fit = WantedLengths::fit(relative_length(a, b, length, at_a, at_b));
    if (fit < 1) misfits.push_back(static_cast<Quality>(fit));
  }
  std::sort(misfits.begin(), misfits.end());
  return misfits;
}

bool WantedLengths::admits(std::span<const EdgePlaces> before,
                           std::span<const EdgePlaces> now) const {
  const std::vector<Quality> after = misfits(now);
  if (after.empty()) return true;
  const std::vector<Quality> old = misfits(before);
  return after.size() <= old.size() &&
         std::equal(after.begin(), after.end(), old.begin(),
                    [](Quality is, Quality was) { return is >= was; });
}

}  // namespace tetmend
