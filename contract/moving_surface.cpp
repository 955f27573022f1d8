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

double distance(const Point& p, const std::vector<Triangle>& triangles) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    const double reach = std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
    if ((p - t[0]).norm() - reach < nearest) nearest = std::min(nearest, distance(p, t));
  }
  return nearest;
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

/// The largest distance of samples of what is not among `others` to them.
double farthest(const std::vector<Triangle>& some, const std::vector<Triangle>& others) {
  constexpr int kParts = 4;
  double worst = 0;
  for (const Triangle& t : missing(some, others)) {
    for (int i = 0; i <= kParts; ++i) {
      for (int k = 0; i + k <= kParts; ++k) {
        const double u = static_cast<double>(i) / kParts;
        const double v = static_cast<double>(k) / kParts;
        worst = std::max(worst, distance(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]), others));
      }
    }
  }
  return worst;
}

double area(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2;
  return sum;
}

}  // namespace

SurfaceShape surface_shape(const TetMesh& mesh) {
  SurfaceShape shape;
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

double surface_tolerance(const TetMesh& mesh) {
  const auto& envelope = dynamic_cast<const Envelope&>(*mesh.surface_guard());
  const auto& tolerances = envelope.reference().tolerances;
  return tolerances.empty() ? 0 : *std::max_element(tolerances.begin(), tolerances.end());
}

std::string complaint_about_shape(const SurfaceShape& before, const SurfaceShape& now,
                                  double tolerance) {
  const double rounding = 1e-12 * before.diagonal;
  for (const auto& [sides, faces] : now.faces) {
    const auto old = before.faces.find(sides);
    if (old == before.faces.end()) return "labels meet that did not meet before";
    const double there = farthest(faces, old->second);
    const double back = farthest(old->second, faces);
    if (std::max(there, back) > tolerance + rounding) {
      return fmt::format("the surface is {:.3g} off, and may be {:.3g}", std::max(there, back),
                         tolerance);
    }
    const double was = area(old->second);
    if (tolerance == 0 && std::abs(area(faces) - was) > 1e-12 * was) {
      return "the area of the surface changed";
    }
  }
  return now.faces.size() == before.faces.size() ? "" : "a part of the surface vanished";
}

}  // namespace tetmend::contract
