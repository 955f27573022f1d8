// SPDX-License-Identifier: MIT
#include "search/untangler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/chunks.h"
#include "kernel/geometry.h"
#include "kernel/handles.h"

namespace tetmend {

namespace {

/// Share of the cost that asks for the right volume: little, for the shape is what matters.
constexpr double kVolumeShare = 1.0 / 64;
constexpr double kSqrt2 = 1.4142135623730951;

constexpr std::size_t kChunk = std::size_t{1} << 11;

/// x, which takes the place of the volume, and its derivative.
struct Softened {
  double value;
  double slope;

  Softened(double volume, double softness) {
    const double root = std::sqrt(softness * softness + volume * volume);
    value = volume > 0 ? 0.5 * (volume + root) : 0.5 * softness * softness / (root - volume);
    slope = value / root;
  }
};

double chunked_dot(const std::vector<Point>& x, const std::vector<Point>& y) {
  double sum = 0;
  const auto part = [&](std::size_t begin, std::size_t end) {
    double chunk = 0;
    for (std::size_t i = begin; i < end; ++i) chunk += x[i].dot(y[i]);
    return chunk;
  };
  for (const double chunk : map_chunks<double>(x.size(), part, kChunk)) sum += chunk;
  return sum;
}

/// x += factor y
void chunked_add(std::vector<Point>& x, double factor, const std::vector<Point>& y) {
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) x[i] += factor * y[i];
  };
  for_chunks(x.size(), work, kChunk);
}

void scale(std::vector<Point>& x, double factor) {
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) x[i] *= factor;
  };
  for_chunks(x.size(), work, kChunk);
}

}  // namespace

// --- one tet -------------------------------------------------------------------------------------

TangledTet::TangledTet(const std::array<Point, 4>& corners, double size)
    : corners_(corners), size_(size) {
  const auto& p = corners;
  double sum = 0;
  for (const auto& [i, j] : kEdgeVertices) sum += ((p[j] - p[i]) / size).squaredNorm();
  squares_ = sum / 6;
  volume_ = kSqrt2 * ((p[1] - p[0]) / size).dot(((p[2] - p[0]) / size).cross((p[3] - p[0]) / size));
}

double TangledTet::cost(double softness) const {
  const double x = Softened(volume_, softness).value;
  const double root = cube_root(x);
  return (1 - kVolumeShare) * squares_ / (root * root) +
         kVolumeShare * (volume_ * volume_ + 1) / (2 * x);
}

void TangledTet::gradient(double softness, std::array<Point, 4>& out) const {
  const auto& p = corners_;
  const auto [x, slope] = Softened(volume_, softness);
  const double root = cube_root(x);
  const double shape = (1 - kVolumeShare) / (root * root);
  const double excess = (volume_ * volume_ + 1) / (2 * x);
  const double by_volume =
      -2.0 / 3 * shape * squares_ * slope / x + kVolumeShare * (volume_ - excess * slope) / x;
  const Point sum = p[0] + p[1] + p[2] + p[3];
  const double by_place = shape / (3 * size_ * size_);
  const double by_normal = by_volume * kSqrt2 / size_;
  for (unsigned i = 0; i < 4; ++i) {
    const auto& [a, b, c] = kFaceVertices[i];
    // The face as seen from inside: its normal is the gradient of the volume.
    const Point normal = ((p[c] - p[a]) / size_).cross((p[b] - p[a]) / size_);
    out[i] = by_place * (4 * p[i] - sum) + by_normal * normal;
  }
}

// --- the patch -----------------------------------------------------------------------------------

void Untangler::State::include(const State& other) {
  cost += other.cost;
  least = std::min(least, other.least);
  inverted += other.inverted;
}

Untangler::Untangler(TangledPatch patch)
    : points_(std::move(patch.points)), free_count_(patch.free_count) {
  tets_.reserve(patch.tets.size());
  for (const auto& corners : patch.tets) tets_.push_back({corners});
  list_stars();
  measure_sizes();
  parts_.resize(tets_.size());
  gradient_.resize(free_count_);
}

void Untangler::list_stars() {
  star_begin_.assign(free_count_ + 1, 0);
  const auto for_free = [&](const auto& take) {
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      for (unsigned i = 0; i < 4; ++i) {
        if (tets_[t].corners[i] < free_count_) take(tets_[t].corners[i], 4 * t + i);
      }
    }
  };
  for_free([&](std::uint32_t v, std::size_t) { ++star_begin_[v + 1]; });
  for (std::size_t v = 0; v < free_count_; ++v) star_begin_[v + 1] += star_begin_[v];
  stars_.resize(star_begin_[free_count_]);
  std::vector<std::uint32_t> next(star_begin_.begin(), star_begin_.end() - 1);
  for_free([&](std::uint32_t v, std::size_t place) {
    stars_[next[v]++] = static_cast<std::uint32_t>(place);
  });
}

/// The edges of a tangled mesh are too long, but about as much everywhere: where they are longer,
/// tets are to be larger, and all have the volume of the patch.
void Untangler::measure_sizes() {
  constexpr int kSmoothings = 2;
  std::vector<double> length(points_.size(), 0);
  std::vector<double> count(points_.size(), 0);
  for (const Tet& tet : tets_) {
    for (const auto& [i, j] : kEdgeVertices) {
      const double l = (points_[tet.corners[i]] - points_[tet.corners[j]]).norm();
      for (const unsigned k : {i, j}) {
        length[tet.corners[k]] += l;
        count[tet.corners[k]] += 1;
      }
    }
  }
  for (std::size_t v = 0; v < length.size(); ++v) length[v] /= std::max(count[v], 1.0);
  for (int n = 0; n < kSmoothings; ++n) {
    std::vector<double> sum(length.size(), 0);
    std::fill(count.begin(), count.end(), 0.0);
    for (const Tet& tet : tets_) {
      double mean = 0;
      for (const std::uint32_t v : tet.corners) mean += length[v] / 4;
      for (const std::uint32_t v : tet.corners) {
        sum[v] += mean;
        count[v] += 1;
      }
    }
    for (std::size_t v = 0; v < length.size(); ++v) length[v] = sum[v] / std::max(count[v], 1.0);
  }
  double wanted = 0;
  double volume = 0;
  for (Tet& tet : tets_) {
    double size = 0;
    for (const std::uint32_t v : tet.corners) size += length[v] / 4;
    tet.size = size;
    const auto& c = tet.corners;
    wanted += size * size * size;
    volume += kSqrt2 * volume6(points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]]);
  }
  const double factor = volume > 0 ? std::cbrt(volume / wanted) : 1;
  for (Tet& tet : tets_) tet.size *= factor;
  scale_.resize(free_count_);
  for (std::size_t v = 0; v < free_count_; ++v) scale_[v] = factor * length[v];
}

std::array<Point, 4> Untangler::corners(const Tet& tet) const {
  return {points_[tet.corners[0]], points_[tet.corners[1]], points_[tet.corners[2]],
          points_[tet.corners[3]]};
}

/// Costs of the patch as it is, and the gradient by steps in units of `scale_`.
void Untangler::look(const Proceed& proceed) {
  ++looks_;
  const auto part = [&](std::size_t begin, std::size_t end) {
    State sum{.least = std::numeric_limits<double>::infinity()};
    if (stopped_ || !proceed(looks_)) {
      stopped_ = true;
      return sum;
    }
    for (std::size_t t = begin; t < end; ++t) {
      const Tet& tet = tets_[t];
      const std::array<Point, 4> p = corners(tet);
      const TangledTet tangled(p, tet.size);
      sum.inverted += tangled.volume() > 0 ? 0 : 1;
      sum.least = std::min(sum.least, tangled.volume());
      sum.cost += tangled.cost(softness_);
      tangled.gradient(softness_, parts_[t]);
    }
    return sum;
  };
  state_ = {.least = std::numeric_limits<double>::infinity()};
  for (const State& chunk : map_chunks<State>(tets_.size(), part, kChunk)) state_.include(chunk);
}

void Untangler::find_gradient() {
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Point sum = Point::Zero();
      for (std::uint32_t i = star_begin_[v]; i < star_begin_[v + 1]; ++i) {
        sum += parts_[stars_[i] / 4][stars_[i] % 4];
      }
      gradient_[v] = scale_[v] * sum;
    }
  };
  for_chunks(free_count_, work, kChunk);
}

/// From the gradient and the steps of the past: the two-loop recursion.
void Untangler::find_direction() {
  direction_ = gradient_;
  const std::size_t count = std::min(remembered_, kMemory);
  if (count == 0) {
    // The largest move is a tenth of the neighbourhood.
    double longest = 0;
    for (const Point& g : gradient_) longest = std::max(longest, g.norm());
    scale(direction_, -0.1 / longest);
    return;
  }
  std::array<double, kMemory> factor{};
  for (std::size_t i = 0; i < count; ++i) {
    const Memory& memory = memory_[(remembered_ - 1 - i) % kMemory];
    factor[i] = chunked_dot(memory.way, direction_) / memory.product;
    chunked_add(direction_, -factor[i], memory.turn);
  }
  const Memory& last = memory_[(remembered_ - 1) % kMemory];
  scale(direction_, last.product / chunked_dot(last.turn, last.turn));
  for (std::size_t i = count; i-- > 0;) {
    const Memory& memory = memory_[(remembered_ - 1 - i) % kMemory];
    chunked_add(direction_, factor[i] - chunked_dot(memory.turn, direction_) / memory.product,
                memory.way);
  }
  scale(direction_, -1);
}

/// Goes along the direction as far as the cost falls. False, and back, if it nowhere does.
bool Untangler::search_line(double slope, const Proceed& proceed) {
  constexpr double kLeastShare = 1e-4;  // of the fall that the slope promises
  constexpr int kTrials = 10;
  const double before = state_.cost;
  start_.assign(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(free_count_));
  step_ = 1;
  for (int i = 0; i < kTrials; ++i) {
    const auto work = [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        points_[v] = start_[v] + step_ * scale_[v] * direction_[v];
      }
    };
    for_chunks(free_count_, work, kChunk);
    look(proceed);
    if (state_.cost <= before + kLeastShare * step_ * slope) return true;
    // The lowest point of the parabola through what is known.
    const double rise = state_.cost - before - slope * step_;
    step_ *= rise > 0 ? std::clamp(-0.5 * slope * step_ / rise, 0.1, 0.5) : 0.25;
  }
  std::copy(start_.begin(), start_.end(), points_.begin());
  look(proceed);
  return false;
}

/// The last step, unless the slope did not rise along it.
void Untangler::remember() {
  Memory& memory = memory_[remembered_ % kMemory];
  memory.way = direction_;
  scale(memory.way, step_);
  memory.turn = gradient_;
  chunked_add(memory.turn, -1, last_gradient_);
  memory.product = chunked_dot(memory.way, memory.turn);
  if (memory.product > 1e-10 * chunked_dot(memory.turn, memory.turn)) ++remembered_;
}

void Untangler::keep_best() {
  if (state_.inverted > best_inverted_) return;
  best_inverted_ = state_.inverted;
  best_.assign(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(free_count_));
}

/// Lowers the cost at one softness. False if the search is to end.
bool Untangler::descend(const Limits& limits, const Proceed& proceed) {
  constexpr double kLeastFall = 1e-5;  // of the cost, in a step
  remembered_ = 0;
  find_gradient();
  for (unsigned i = 0; i < limits.steps; ++i) {
    if (stopped_ || looks_ >= limits.looks) return false;
    if (!(chunked_dot(gradient_, gradient_) > 0)) return true;
    find_direction();
    const double slope = chunked_dot(gradient_, direction_);
    const double before = state_.cost;
    if (!(slope < 0) || !search_line(slope, proceed)) {
      if (remembered_ == 0) return true;
      remembered_ = 0;  // the past misleads: along the gradient
      continue;
    }
    last_gradient_.swap(gradient_);
    gradient_.resize(free_count_);
    find_gradient();
    remember();
    if (before - state_.cost < kLeastFall * before) return true;
  }
  return true;
}

std::size_t Untangler::untangle(const Limits& limits, const Proceed& proceed) {
  constexpr double kHardest = 1e-3;
  constexpr double kHardening = 0.3;
  constexpr unsigned kPatience = 5;
  look(proceed);
  best_inverted_ = stopped_ ? tets_.size() : state_.inverted;
  keep_best();
  softness_ = std::max(kHardest, -0.2 * state_.least);
  unsigned in_vain = 0;
  while (true) {
    look(proceed);
    const double before = state_.cost;
    const std::size_t fewest = best_inverted_;
    const bool goes_on = descend(limits, proceed);
    if (stopped_) break;
    keep_best();
    if (!goes_on || (state_.inverted == 0 && softness_ <= kHardest)) break;
    in_vain = best_inverted_ < fewest || state_.inverted == 0 ? 0 : in_vain + 1;
    if (in_vain == kPatience) break;
    // Less than [garanzha] allows takes too long where one tet was turned over by far.
    const double fall = std::max(1 - state_.cost / before, 0.1);
    const double target = (1 - fall) * Softened(state_.least, softness_).value;
    const double allowed =
        state_.least < target ? 2 * std::sqrt(target * (target - state_.least)) : 0.0;
    softness_ = std::max(std::min(allowed, kHardening * softness_), kHardest);
  }
  std::copy(best_.begin(), best_.end(), points_.begin());
  return best_inverted_;
}

}  // namespace tetmend
