// SPDX-License-Identifier: MIT
#include "contract/moving_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "envelope/envelope.h"

namespace tetmend::contract {

namespace {

using Triangle = SurfaceShape::Triangle;

double segment_distance(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0;
  return (p - (a + t * along)).norm();
}

double distance(const Point& p, const Triangle& t) {
  const Point normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double length = normal.norm();
  bool inside = length > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (unsigned k = 0; k < 3; ++k) {
    const Point& a = t[k];
    const Point& b = t[(k + 1) % 3];
    inside = inside && normal.dot((b - a).cross(p - a)) >= 0;
    nearest = std::min(nearest, segment_distance(p, a, b));
  }
  return inside ? std::abs(normal.dot(p - t[0])) / length : nearest;
}

/// From the corner that comes first on, the sense kept.
std::array<std::array<double, 3>, 3> key_of(const Triangle& t) {
  std::array<std::array<double, 3>, 3> key;
  for (unsigned k = 0; k < 3; ++k) key[k] = {t[k].x(), t[k].y(), t[k].z()};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

/// Those of `some` that are not among `others`.
std::vector<Triangle> missing(const std::vector<Triangle>& some,
                              const std::vector<Triangle>& others) {
  std::vector<std::array<std::array<double, 3>, 3>> known;
  for (const Triangle& t : others) known.push_back(key_of(t));
  std::sort(known.begin(), known.end());
  std::vector<Triangle> rest;
  for (const Triangle& t : some) {
    if (!std::binary_search(known.begin(), known.end(), key_of(t))) rest.push_back(t);
  }
  return rest;
}

/// Calls f(p) at samples of a triangle.
template <class F>
void sample(const Triangle& t, F&& f) {
  constexpr int kParts = 5;
  for (int i = 0; i <= kParts; ++i) {
    for (int k = 0; i + k <= kParts; ++k) {
      const double u = static_cast<double>(i) / kParts;
      const double v = static_cast<double>(k) / kParts;
      f(Point(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])));
    }
  }
}

/// Triangles, and how near a point must be to each of them.
struct Targets {
  const std::vector<Triangle>& triangles;
  std::vector<double> tolerances;  ///< none: 0

  /// By how much the point is too far from all of them; negative: it is near enough.
  double excess(const Point& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Triangle& t = triangles[i];
      const double tolerance = tolerances.empty() ? 0 : tolerances[i];
      const double reach = std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
      if ((p - t[0]).norm() - reach - tolerance >= least) continue;
      least = std::min(least, distance(p, t) - tolerance);
    }
    return least;
  }
};

/// The worst excess of samples of either surface, and which way it was found.
struct Excess {
  double most = -std::numeric_limits<double>::infinity();
  bool of_old = false;

  void note(double excess, bool old) {
    if (excess > most) *this = {excess, old};
  }
};

Excess worst_excess(const SurfaceShape& before, const std::vector<Triangle>& old,
                    const std::vector<Triangle>& now) {
  Excess worst;
  Targets near{old, {}};
  for (const Triangle& t : old) near.tolerances.push_back(before.tolerance(t));
  for (const Triangle& t : missing(now, old)) {
    sample(t, [&](const Point& p) { worst.note(near.excess(p), false); });
  }
  const Targets present{now, {}};
  for (const Triangle& t : missing(old, now)) {
    const double tolerance = before.tolerance(t);
    sample(t, [&](const Point& p) { worst.note(present.excess(p) - tolerance, true); });
  }
  return worst;
}

double area(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2;
  return sum;
}

}  // namespace

double SurfaceShape::tolerance(const Triangle& t) const {
  if (length > 0) return length;
  const double edges = (t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm();
  return std::min(share * edges / 3, 0.01 * diagonal);
}

SurfaceShape surface_shape(const TetMesh& mesh) {
  SurfaceShape shape;
  const auto& envelope = dynamic_cast<const Envelope&>(*mesh.surface_guard());
  shape.share = envelope.reference().share;
  shape.length = envelope.reference().length;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low = Point::Constant(kFar);
  Point high = Point::Constant(-kFar);
  for (std::uint32_t i = 0; i < 4 * mesh.tet_slots(); ++i) {
    const HalfFace f = HalfFace::from_code(i);
    if (mesh.is_deleted(f.tet())) continue;
    const HalfFace twin = mesh.twin(f);
    const Label label = mesh.label(f.tet());
    const bool outer = twin.is_outside();
    if (!outer && !(mesh.is_constrained(f) && label <= mesh.label(twin.tet()))) continue;
    const Label other = outer ? 0 : mesh.label(twin.tet());
    if (!outer && label == other && twin < f) continue;
    Triangle points;
    for (unsigned k = 0; k < 3; ++k) {
      points[k] = mesh.point(mesh.vertices(f)[k]);
      low = low.cwiseMin(points[k]);
      high = high.cwiseMax(points[k]);
    }
    shape.faces[{label, {outer, other}}].push_back(points);
  }
  shape.diagonal = shape.faces.empty() ? 0 : (high - low).norm();
  return shape;
}

std::string complaint_about_shape(const SurfaceShape& before, const SurfaceShape& now) {
  const double rounding = 1e-12 * before.diagonal;
  for (const auto& [sides, faces] : now.faces) {
    const auto old = before.faces.find(sides);
    if (old == before.faces.end()) return "labels meet that did not meet before";
    const Excess excess = worst_excess(before, old->second, faces);
    if (excess.most > rounding) {
      return fmt::format("a point of the {} surface lies {:.3g} farther off than it may",
                         excess.of_old ? "old" : "new", excess.most);
    }
    const double was = area(old->second);
    if (before.is_flat() && std::abs(area(faces) - was) > 1e-12 * was) {
      return "the area of the surface changed";
    }
  }
  return now.faces.size() == before.faces.size() ? "" : "a part of the surface vanished";
}

}  // namespace tetmend::contract
