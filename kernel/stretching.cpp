// SPDX-License-Identifier: MIT
// Looks at each tet's least altitude, and at the direction of it in the flat neighbours.
#include "kernel/stretching.h"

#include <algorithm>
#include <cmath>

#include "kernel/chunks.h"

namespace tetmend {

namespace {

constexpr double kFlatTet = 0.25;  // least altitude in longest edges
constexpr double kMostTets = 0.5;
constexpr double kAligned = 0.8;

struct Flatness {
  Point normal = Point::Zero();  // of the largest face, a unit vector
  bool flat = false;
};

Flatness flatness_of(const TetMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  double longest2 = 0;
  for (const auto& edge : kEdgeVertices) {
    longest2 = std::max(longest2, (mesh.point(v[edge[1]]) - mesh.point(v[edge[0]])).squaredNorm());
  }
  Flatness shape;
  double area = 0;  // twice
  for (const auto& face : kFaceVertices) {
    const Point& a = mesh.point(v[face[0]]);
    const Point normal = (mesh.point(v[face[1]]) - a).cross(mesh.point(v[face[2]]) - a);
    if (const double norm = normal.norm(); norm > area) {
      area = norm;
      shape.normal = normal / norm;
    }
  }
  const double volume =
      volume6(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  shape.flat = std::abs(volume) < kFlatTet * area * std::sqrt(longest2);
  return shape;
}

struct Sums {
  std::size_t tets = 0;
  std::size_t flat = 0;
  std::size_t pairs = 0;
  double cosines = 0;

  void add(const TetMesh& mesh, TetHandle t) {
    ++tets;
    const Flatness shape = flatness_of(mesh, t);
    if (!shape.flat) return;
    ++flat;
    for (const HalfFace neighbour : mesh.neighbours(t)) {
      // Each pair once.
      if (neighbour.is_outside() || neighbour.tet() < t || mesh.is_frozen(neighbour.tet()))
        continue;
      const Flatness other = flatness_of(mesh, neighbour.tet());
      if (!other.flat) continue;
      ++pairs;
      cosines += std::abs(shape.normal.dot(other.normal));
    }
  }
};

}  // namespace

bool Stretching::is_throughout() const {
  return static_cast<double>(flat) > kMostTets * static_cast<double>(tets) && alignment > kAligned;
}

Stretching measure_stretching(const TetMesh& mesh) {
  const auto parts = map_chunks<Sums>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t i = begin; i < end; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(i));
      if (!mesh.is_deleted(t) && !mesh.is_frozen(t)) part.add(mesh, t);
    }
    return part;
  });
  Sums sum;
  for (const Sums& part : parts) {
    sum.tets += part.tets;
    sum.flat += part.flat;
    sum.pairs += part.pairs;
    sum.cosines += part.cosines;
  }
  const double alignment = sum.pairs == 0 ? 0 : sum.cosines / static_cast<double>(sum.pairs);
  return {.tets = sum.tets, .flat = sum.flat, .alignment = alignment};
}

}  // namespace tetmend
