// SPDX-License-Identifier: MIT
// Quasi-Newton descent of what the terms of a patch lack.
//
//   for p = 16, 64:
//     repeat: gradient of the p-norm -> direction from the last steps -> step, halved until the
//             norm falls and no tet turns over; stop when it falls by little
//   keep the best of start and ends
#include "search/patch_optimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/handles.h"
#include "kernel/judge.h"
#include "kernel/quality_of_points.h"

namespace tetmend {

namespace {

// Lengths and gradients are in units of the vertices' scales, so that nothing depends on the size
// of the mesh.
double dot(const std::vector<Point>& x, const std::vector<Point>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].dot(y[i]);
  return sum;
}

void add(std::vector<Point>& x, double factor, const std::vector<Point>& y) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += factor * y[i];
}

/// x^(2^n).
double raise(double x, int n) {
  for (int i = 0; i < n; ++i) x *= x;
  return x;
}

/// The 2^n-th root.
double lower(double x, int n) {
  for (int i = 0; i < n; ++i) x = std::sqrt(x);
  return x;
}

/// The two corners that an edge lacks; it lies on the faces opposite them.
constexpr std::array<std::array<unsigned, 2>, 6> other_corners() {
  std::array<std::array<unsigned, 2>, 6> others{};
  for (unsigned e = 0; e < 6; ++e) {
    unsigned n = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (i != kEdgeVertices[e][0] && i != kEdgeVertices[e][1]) others[e][n++] = i;
    }
  }
  return others;
}
constexpr auto kOtherCorners = other_corners();

/// Of a tet: the gradients of its volume V6 by the corners, which are the normals of the faces
/// opposite, and the terms of the standard.
struct Shape {
  std::array<Point, 4> normal;
  std::array<double, 4> norm2;
  std::array<double, 6> length2;
  double v6;
  double sum = 0;  // of length2

  explicit Shape(const std::array<Point, 4>& p) {
    const Point u = p[1] - p[0];
    const Point v = p[2] - p[0];
    const Point w = p[3] - p[0];
    normal[1] = v.cross(w);
    normal[2] = w.cross(u);
    normal[3] = u.cross(v);
    normal[0] = -(normal[1] + normal[2] + normal[3]);
    v6 = u.dot(normal[1]);
    for (unsigned i = 0; i < 4; ++i) norm2[i] = normal[i].squaredNorm();
    for (unsigned e = 0; e < 6; ++e) {
      length2[e] = (p[kEdgeVertices[e][0]] - p[kEdgeVertices[e][1]]).squaredNorm();
      sum += length2[e];
    }
  }
  bool is_degenerate() const {
    return !(norm2[0] > 0 && norm2[1] > 0 && norm2[2] > 0 && norm2[3] > 0);
  }
  bool is_obtuse(unsigned e) const {
    const auto& [k, l] = kOtherCorners[e];
    return normal[k].dot(normal[l]) > 0;
  }
  /// Term of an edge over V6.
  double ratio(unsigned e, const Standard& standard) const {
    const auto& [k, l] = kOtherCorners[e];
    const bool obtuse = !standard.is_even() && is_obtuse(e);
    const double weight2 = obtuse ? standard.obtuse2() : standard.acute2();
    return std::sqrt(weight2 * (length2[e] / (norm2[k] * norm2[l])));
  }
  /// The part of the length in the square of its term.
  double length_part(const Standard& standard) const {
    return standard.length() * v6 * v6 / (sum * sum * sum);
  }
  double length_term(const Standard& standard) const {
    const double size = std::sqrt(standard.flat2() + length_part(standard));
    return v6 < 0 ? -size : size;
  }
};

using Terms = std::array<double, 7>;
constexpr unsigned kLength = 6;  // the term that no edge has

/// The most that a term lacks of its goal.
double lack_of(const Terms& terms, const Terms& goals) {
  double most = goals[0] - terms[0];
  for (std::size_t i = 1; i < terms.size(); ++i) most = std::max(most, goals[i] - terms[i]);
  return most;
}

Terms all_terms(double value) {
  Terms terms{};
  terms.fill(value);
  return terms;
}

double quality_of(const Terms& terms) {
  return terms[0] < 0 ? *std::max_element(terms.begin(), terms.end())
                      : *std::min_element(terms.begin(), terms.end());
}

}  // namespace

void PatchOptimiser::clear(const Standard& standard) {
  standard_ = standard;
  points_.clear();
  tets_.clear();
}

void PatchOptimiser::add_tet(const std::array<Point, 4>& corners,
                             const std::array<int, 4>& vertex) {
  tets_.push_back({corners, vertex, false});
}

/// Computes all terms with the vertices at `points`. False if a positive tet would turn over.
bool PatchOptimiser::measure(const std::vector<Point>& points, std::vector<Terms>& terms) {
  terms.resize(tets_.size());
  for (std::size_t n = 0; n < tets_.size(); ++n) {
    Tet& tet = tets_[n];
    for (unsigned i = 0; i < 4; ++i) {
      if (tet.vertex[i] != kFixed) {
        tet.corners[i] = points[static_cast<std::size_t>(tet.vertex[i])];
      }
    }
    const Shape shape(tet.corners);
    if (tet.positive && !(shape.v6 > 0)) return false;
    if (shape.is_degenerate()) {
      terms[n].fill(0);
      continue;
    }
    if (standard_.is_own()) {
      const auto& p = tet.corners;
      terms[n] = all_terms(quality_of_points(standard_, p[0], p[1], p[2], p[3]));
      continue;
    }
    for (unsigned e = 0; e < 6; ++e) terms[n][e] = shape.v6 * shape.ratio(e, standard_);
    terms[n][kLength] = shape.length_term(standard_);
  }
  return true;
}

double PatchOptimiser::worst() {
  for (Tet& tet : tets_) tet.positive = false;
  measure(points_, terms_);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < tets_.size(); ++n) {
    const double q = quality_of(terms_[n]);
    tets_[n].positive = q > 0;
    least = std::min(least, q);
  }
  return least;
}

double PatchOptimiser::total_deficit() const {
  double sum = 0;
  for (const Terms& terms : terms_) sum += deficit(quality_of(terms));
  return sum;
}

void PatchOptimiser::measure_scales() {
  scale_.assign(points_.size(), 0);
  trial_.assign(points_.size(), Point::Zero());  // x: number of edges
  for (const Tet& tet : tets_) {
    for (unsigned i = 0; i < 4; ++i) {
      if (tet.vertex[i] == kFixed) continue;
      const auto v = static_cast<std::size_t>(tet.vertex[i]);
      for (unsigned j = 0; j < 4; ++j) {
        if (j != i) scale_[v] += (tet.corners[i] - tet.corners[j]).norm();
      }
      trial_[v].x() += 3;
    }
  }
  for (std::size_t v = 0; v < scale_.size(); ++v) scale_[v] /= std::max(trial_[v].x(), 1.0);
}

double PatchOptimiser::norm(const std::vector<Terms>& terms, int doublings) const {
  double most = 0;
  for (std::size_t n = 0; n < terms.size(); ++n)
    most = std::max(most, lack_of(terms[n], goals_[n]));
  if (!(most > 0)) return 0;
  double sum = 0;
  for (std::size_t n = 0; n < terms.size(); ++n) {
    for (std::size_t i = 0; i < kTerms; ++i) {
      const double lack = goals_[n][i] - terms[n][i];
      if (lack > 0) sum += raise(lack / most, doublings);
    }
  }
  return most * lower(sum, doublings);
}

/// Of the quality of a tet by a measure of a program, by differences.
void PatchOptimiser::add_own_gradient(const Tet& tet, double weight,
                                      std::vector<Point>& gradient) const {
  constexpr double kShare = 1e-6;
  for (unsigned i = 0; i < 4; ++i) {
    if (tet.vertex[i] == kFixed) continue;
    const auto v = static_cast<std::size_t>(tet.vertex[i]);
    const double step = kShare * scale_[v];
    const auto quality = [&](int axis, double offset) {
      auto p = tet.corners;
      p[i][axis] += offset;
      return quality_of_points(standard_, p[0], p[1], p[2], p[3]);
    };
    Point slope;
    for (int axis = 0; axis < 3; ++axis) {
      slope[axis] = (quality(axis, step) - quality(axis, -step)) / (2 * step);
    }
    if (slope.allFinite()) gradient[v] += weight * scale_[v] * slope;
  }
}

/// Of the norm at the current points, whose value is given.
void PatchOptimiser::find_gradient(int doublings, double norm, std::vector<Point>& gradient) {
  constexpr double kNegligible = 1e-8;
  gradient.assign(points_.size(), Point::Zero());
  for (std::size_t n = 0; n < tets_.size(); ++n) {
    const Terms& terms = terms_[n];
    const Terms& goals = goals_[n];
    if (!(raise(std::max(0.0, lack_of(terms, goals)) / norm, doublings) > kNegligible)) continue;
    Tet& tet = tets_[n];
    for (unsigned i = 0; i < 4; ++i) {
      if (tet.vertex[i] != kFixed) {
        tet.corners[i] = points_[static_cast<std::size_t>(tet.vertex[i])];
      }
    }
    if (standard_.is_own()) {
      double weight = 0;
      for (std::size_t e = 0; e < kTerms; ++e) {
        const double share = (goals[e] - terms[e]) / norm;
        if (share > 0) weight -= raise(share, doublings) / share;
      }
      add_own_gradient(tet, weight, gradient);
      continue;
    }
    const auto& p = tet.corners;
    const Shape shape(p);
    if (shape.is_degenerate()) continue;
    // The term of an edge is V6 l / (N N'), weighted; d|u|/du = (u / |u|)^(p - 1).
    double by_volume = 0;
    std::array<Point, 4> slope;
    slope.fill(Point::Zero());
    std::array<double, 4> by_face{};
    for (unsigned e = 0; e < 6; ++e) {
      const double share = (goals[e] - terms[e]) / norm;
      if (!(share > 0)) continue;
      const double weight = -raise(share, doublings) / share;
      by_volume += weight * shape.ratio(e, standard_);
      const double by_log = weight * terms[e];
      const auto& [i, j] = kEdgeVertices[e];
      const Point along = (by_log / shape.length2[e]) * (p[i] - p[j]);
      slope[i] += along;
      slope[j] -= along;
      for (const unsigned k : kOtherCorners[e]) by_face[k] += by_log;
    }
    const double share = (goals[kLength] - terms[kLength]) / norm;
    if (share > 0 && shape.v6 > 0) {
      // d(term) = part / term (dV6 / V6 - 3/2 dS / S).
      const double by_log =
          -raise(share, doublings) / share * shape.length_part(standard_) / terms[kLength];
      by_volume += by_log / shape.v6;
      for (unsigned i = 0; i < 4; ++i) {
        slope[i] -= (3 * by_log / shape.sum) * (4 * p[i] - (p[0] + p[1] + p[2] + p[3]));
      }
    }
    for (unsigned f = 0; f < 4; ++f) {
      if (by_face[f] == 0) continue;
      const Point normal = (by_face[f] / shape.norm2[f]) * shape.normal[f];
      const auto& [a, b, c] = kFaceVertices[f];
      // The face as seen from inside: its normal is the gradient of the volume.
      slope[a] += (p[b] - p[c]).cross(normal);
      slope[b] += (p[c] - p[a]).cross(normal);
      slope[c] += (p[a] - p[b]).cross(normal);
    }
    for (unsigned i = 0; i < 4; ++i) {
      if (tet.vertex[i] == kFixed) continue;
      const auto v = static_cast<std::size_t>(tet.vertex[i]);
      gradient[v] += scale_[v] * (slope[i] + by_volume * shape.normal[i]);
    }
  }
}

/// From the gradient and the steps of the past: the two-loop recursion.
void PatchOptimiser::find_direction() {
  direction_ = gradient_;
  const std::size_t count = std::min(remembered_, kMemory);
  if (count == 0) {
    // The largest move is a tenth of the neighbourhood.
    double longest = 0;
    for (const Point& g : gradient_) longest = std::max(longest, g.norm());
    for (Point& d : direction_) d *= -0.1 / longest;
    return;
  }
  std::array<double, kMemory> factor{};
  for (std::size_t i = 0; i < count; ++i) {
    const Memory& memory = memory_[(remembered_ - 1 - i) % kMemory];
    factor[i] = dot(memory.way, direction_) / memory.product;
    add(direction_, -factor[i], memory.turn);
  }
  const Memory& last = memory_[(remembered_ - 1) % kMemory];
  const double curvature = last.product / dot(last.turn, last.turn);
  for (Point& d : direction_) d *= curvature;
  for (std::size_t i = count; i-- > 0;) {
    const Memory& memory = memory_[(remembered_ - 1 - i) % kMemory];
    add(direction_, factor[i] - dot(memory.turn, direction_) / memory.product, memory.way);
  }
  for (Point& d : direction_) d = -d;
}

/// Goes along the direction as far as the norm falls; `value` follows. False if it nowhere does.
bool PatchOptimiser::search_line(int doublings, double slope, double& value) {
  constexpr double kLeastShare = 1e-4;  // of the fall that the slope promises
  constexpr int kTrials = 10;
  step_ = 1;
  for (int i = 0; i < kTrials; ++i) {
    trial_ = points_;
    for (std::size_t v = 0; v < trial_.size(); ++v) {
      trial_[v] += step_ * scale_[v] * direction_[v];
    }
    double shrink = 0.25;
    if (measure(trial_, trial_terms_)) {
      const double reached = norm(trial_terms_, doublings);
      if (reached <= value + kLeastShare * step_ * slope) {
        value = reached;
        points_.swap(trial_);
        terms_.swap(trial_terms_);
        return true;
      }
      // The lowest point of the parabola through what is known.
      shrink = std::clamp(-0.5 * slope * step_ / (reached - value - slope * step_), 0.1, 0.5);
    }
    step_ *= shrink;
  }
  return false;
}

/// The last step, unless the slope did not rise along it.
void PatchOptimiser::remember() {
  Memory& memory = memory_[remembered_ % kMemory];
  memory.way = direction_;
  for (Point& d : memory.way) d *= step_;
  memory.turn = gradient_;
  add(memory.turn, -1, last_gradient_);
  memory.product = dot(memory.way, memory.turn);
  if (memory.product > 1e-10 * dot(memory.turn, memory.turn)) ++remembered_;
}

/// Lowers the norm for p = 2^doublings.
void PatchOptimiser::descend(int doublings, const Limits& limits) {
  remembered_ = 0;
  double value = norm(terms_, doublings);
  if (!(value > 0)) return;
  find_gradient(doublings, value, gradient_);
  for (int i = 0; i < limits.steps; ++i) {
    if (!(dot(gradient_, gradient_) > 0)) return;
    find_direction();
    double slope = dot(gradient_, direction_);
    const double before = value;
    if (!(slope < 0) || !search_line(doublings, slope, value)) {
      if (remembered_ == 0) return;
      remembered_ = 0;  // the past misleads: along the gradient
      continue;
    }
    if (before - value < limits.least_gain) return;
    last_gradient_.swap(gradient_);
    find_gradient(doublings, value, gradient_);
    remember();
  }
}

bool PatchOptimiser::lift(std::size_t tet, double goal, double least, const Limits& limits) {
  // What is aimed at beyond the goals: near them the norm falls slowly.
  constexpr double kMargin = 2e-3;
  constexpr int kSquares = 1;
  worst();
  best_ = points_;
  measure_scales();
  goals_.clear();
  for (const Terms& terms : terms_) {
    goals_.push_back(all_terms(std::min(quality_of(terms), least) + kMargin));
  }
  const Shape shape(tets_[tet].corners);
  const Terms& terms = terms_[tet];
  const auto sharpest = std::min_element(terms.begin(), terms.begin() + kLength) - terms.begin();
  for (unsigned e = 0; e < 6; ++e) {
    const bool alike = shape.is_obtuse(e) == shape.is_obtuse(static_cast<unsigned>(sharpest));
    goals_[tet][e] = (alike ? goal : std::min(terms[e], least)) + kMargin;
  }
  goals_[tet][kLength] = goal + kMargin;
  // A tet that has not come half the way in its first steps hardly ever arrives.
  constexpr int kFirst = 30;
  const double lacked = lack_of(terms_[tet], goals_[tet]);
  Limits part = limits;
  part.steps = std::min(kFirst, limits.steps);
  descend(kSquares, part);
  if (lack_of(terms_[tet], goals_[tet]) < 0.5 * lacked) {
    part.steps = limits.steps - part.steps;
    descend(kSquares, part);
  }
  bool reached = true;
  for (std::size_t n = 0; n < tets_.size() && reached; ++n) {
    reached = lack_of(terms_[n], goals_[n]) <= kMargin + kQualityTolerance;
  }
  if (!reached) {
    points_ = best_;
    worst();
  }
  return reached;
}

double PatchOptimiser::optimise(const Limits& limits) {
  double best = worst();
  goals_.assign(tets_.size(), all_terms(limits.enough));
  best_ = points_;
  measure_scales();
  for (int doublings = limits.mildest; doublings <= limits.sharpest; doublings += 2) {
    descend(doublings, limits);
    double reached = std::numeric_limits<double>::infinity();
    for (const Terms& terms : terms_) reached = std::min(reached, quality_of(terms));
    if (reached > best) {
      best = reached;
      best_ = points_;
    }
  }
  points_ = best_;
  return worst();
}

}  // namespace tetmend
