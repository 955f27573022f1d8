// SPDX-License-Identifier: MIT
#include "kernel/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/chunks.h"
#include "kernel/solver_rulers.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

namespace {

/// Edges of a tet may differ by this factor, also where those of the mesh do not.
constexpr double kEdgeRatio = 10;

/// The figures of a tet that have bounds.
struct Shape {
  double sine2 = 1;         // least of the acute angles
  double obtuse_sine2 = 1;  // least of the obtuse ones
  double volume_length2 = 1;
  double radius_ratio = 1;
  double edge_ratio2 = 1;

  Shape() = default;
  /// Of one that is not positive angles and lengths; a mean and a radius ratio of 0.
  Shape(const Point& a, const Point& b, const Point& c, const Point& d) {
    const std::array<Point, 4> p = {a, b, c, d};
    std::array<Point, 4> normal;
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [i, j, k] = kFaceVertices[f];
      normal[f] = (p[j] - p[i]).cross(p[k] - p[i]);
    }
    const double v6 = volume6(a, b, c, d);
    double sum = 0;
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (std::size_t e = 0; e < 6; ++e) {
      const double length2 = (p[kEdgeVertices[e][1]] - p[kEdgeVertices[e][0]]).squaredNorm();
      const auto& [k, l] = kEdgeVertices[5 - e];  // the faces at an edge are opposite these
      const double product = normal[k].squaredNorm() * normal[l].squaredNorm();
      const double square = product > 0 ? v6 * v6 * length2 / product : 0;
      double& least = normal[k].dot(normal[l]) > 0 ? obtuse_sine2 : sine2;
      least = std::min(least, square);
      sum += length2;
      shortest = std::min(shortest, length2);
      longest = std::max(longest, length2);
    }
    edge_ratio2 = shortest > 0 ? longest / shortest : std::numeric_limits<double>::infinity();
    if (!(v6 > 0)) {
      volume_length2 = radius_ratio = 0;
      return;
    }
    volume_length2 = 432 * v6 * v6 / (sum * sum * sum);
    double area = 0;
    for (const Point& n : normal) area += n.norm();
    // Radii: of the inscribed ball v6 / area, of the ball around it |around| / (2 v6).
    const Point u = b - a;
    const Point v = c - a;
    const Point w = d - a;
    const Point around =
        u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v);
    radius_ratio = 6 * v6 * v6 / (area * around.norm());
  }
  void include(const Shape& other) {
    sine2 = std::min(sine2, other.sine2);
    obtuse_sine2 = std::min(obtuse_sine2, other.obtuse_sine2);
    volume_length2 = std::min(volume_length2, other.volume_length2);
    radius_ratio = std::min(radius_ratio, other.radius_ratio);
    edge_ratio2 = std::max(edge_ratio2, other.edge_ratio2);
  }
};

/// Worst of the tets of a quality from `from` to less than `to`.
Shape worst_shape(const TetMesh& mesh, Quality from, Quality to) {
  const auto parts = map_chunks<Shape>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Shape worst;
    for (std::size_t i = begin; i < end; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(i));
      const Quality quality = mesh.quality(t);
      if (!(quality >= from && quality < to) || mesh.is_deleted(t)) continue;
      const TetVertices& v = mesh.vertices(t);
      Shape shape(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
      if (!mesh.is_certified_positive(v)) shape.volume_length2 = shape.radius_ratio = 0;
      worst.include(shape);
    }
    return worst;
  });
  Shape worst;
  for (const Shape& part : parts) worst.include(part);
  return worst;
}

}  // namespace

Bounds Bounds::of(const TetMesh& mesh, Holding holding) {
  if (holding == Holding::angles) return of(mesh, std::optional<double>());
  return of(mesh, p1_diagonals(mesh));
}

Bounds Bounds::of(const TetMesh& mesh, const P1Diagonals& diagonals) {
  return of(mesh, std::optional(stable_step(diagonals)));
}

Bounds Bounds::of(const TetMesh& mesh, std::optional<double> step) {
  constexpr Quality kInfinity = std::numeric_limits<Quality>::infinity();
  const Standard& standard = mesh.standard();
  Shape worst = worst_shape(mesh, -kInfinity, kBadThreshold);
  const auto bounds_by = [&] {
    Bounds bounds;
    bounds.least_sine2_ = worst.sine2;
    bounds.least_obtuse_sine2_ = worst.obtuse_sine2;
    bounds.least_volume_length2_ = worst.volume_length2;
    bounds.least_radius_ratio_ = worst.radius_ratio;
    bounds.most_edge_ratio2_ = std::max(worst.edge_ratio2, kEdgeRatio * kEdgeRatio);
    bounds.safe_ = 0;
    return bounds.under(standard);
  };
  // What is safe cannot be worse: with some bad tets that is all the rest, as a rule.
  const bool has_flat = worst.obtuse_sine2 < 1 / standard.obtuse2();
  const bool is_soft = !step;
  if (is_soft && !has_flat) worst.obtuse_sine2 = 1 / standard.obtuse2();
  const Quality safe = has_flat || is_soft ? bounds_by().safe() : kInfinity;
  if (safe > kBadThreshold) worst.include(worst_shape(mesh, kBadThreshold, safe));
  Bounds now = bounds_by();
  const double held = step.value_or(0);
  now.least_step2_ = held * held * (1 - 1e-9);  // sums in another order differ by rounding
  // A mesh that has bounds keeps them, with its angles of now where these are tighter.
  if (!mesh.bounds().any()) return now;
  Bounds tighter = mesh.bounds();
  tighter.least_sine2_ = std::max(tighter.least_sine2_, now.least_sine2_);
  tighter.least_obtuse_sine2_ = std::max(tighter.least_obtuse_sine2_, now.least_obtuse_sine2_);
  return tighter.under(standard);
}

Bounds Bounds::under(const Standard& standard) const {
  Bounds bounds = *this;
  if (!any()) return bounds;
  bounds.safe_ = std::numeric_limits<double>::infinity();
  if (standard.terms() != Standard::Terms::sine_and_length) return bounds;
  // Mean ratio^3 <= radius ratio [liu_joe].
  const double least_length2 = std::max(least_volume_length2_, least_radius_ratio_);
  const double safe2 =
      std::max({standard.acute2() * least_sine2_, standard.obtuse2() * least_obtuse_sine2_,
                standard.flat2() + standard.length() / 432 * least_length2,
                1.0});  // no tet of quality 1 has an edge ratio of 10
  bounds.safe_ = std::sqrt(safe2) * (1 + 1e-6);
  return bounds;
}

Bounds Bounds::with_mean(double mean_ratio) const {
  Bounds bounds = *this;
  bounds.least_mean_ = mean_ratio;
  return bounds;
}

Bounds Bounds::for_mending() const {
  Bounds bounds = *this;
  if (any() && are_of_inverted()) bounds.least_radius_ratio_ = -1;
  return bounds;
}

Bounds Bounds::of_goal(const Standard& standard) {
  Bounds bounds;
  bounds.least_sine2_ = bounds.least_volume_length2_ = bounds.least_radius_ratio_ = 1;
  bounds.least_obtuse_sine2_ = 1 / standard.obtuse2();
  bounds.most_edge_ratio2_ = kEdgeRatio * kEdgeRatio;
  bounds.safe_ = 0;
  return bounds.under(standard);
}

void Bounds::widen(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Shape shape(a, b, c, d);
  Bounds other;
  other.least_sine2_ = shape.sine2;
  other.least_obtuse_sine2_ = shape.obtuse_sine2;
  other.least_volume_length2_ = shape.volume_length2;
  other.least_radius_ratio_ = shape.radius_ratio;
  other.most_edge_ratio2_ = shape.edge_ratio2;
  widen(other);
}

void Bounds::widen(const Bounds& other) {
  least_sine2_ = std::min(least_sine2_, other.least_sine2_);
  least_obtuse_sine2_ = std::min(least_obtuse_sine2_, other.least_obtuse_sine2_);
  least_volume_length2_ = std::min(least_volume_length2_, other.least_volume_length2_);
  least_radius_ratio_ = std::min(least_radius_ratio_, other.least_radius_ratio_);
  most_edge_ratio2_ = std::max(most_edge_ratio2_, other.most_edge_ratio2_);
}

bool Bounds::admit(const Point& a, const Point& b, const Point& c, const Point& d) const {
  const Shape shape(a, b, c, d);
  return shape.sine2 >= least_sine2_ && shape.obtuse_sine2 >= least_obtuse_sine2_ &&
         shape.volume_length2 >= least_volume_length2_ &&
         shape.radius_ratio >= least_radius_ratio_ && shape.edge_ratio2 <= most_edge_ratio2_;
}

}  // namespace tetmend
