// SPDX-License-Identifier: MIT
#include "envelope/features.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "envelope/feature_finder.h"

namespace tetmend {

std::span<const Point> points_by_slot(const TetMesh& mesh) {
  if (mesh.vertex_slots() == 0) return {};
  return {&mesh.point(VertexHandle(0)), mesh.vertex_slots()};  // a mesh has them in one array
}

double flatness(const TetMesh& mesh) {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    if (mesh.is_deleted(VertexHandle(i))) continue;
    low = low.cwiseMin(mesh.point(VertexHandle(i)));
    high = high.cwiseMax(mesh.point(VertexHandle(i)));
  }
  return flatness(low, high);
}

double flatness(const Point& low, const Point& high) {
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  return std::max(1e-13 * (high - low).norm(), kRounding * largest);
}

SurfaceFeatures find_features(const TetMesh& mesh, const FeatureOptions& options) {
  return find_features(read_surface(mesh), points_by_slot(mesh), flatness(mesh), options);
}

SurfaceFeatures find_features(SurfaceInput surface, std::span<const Point> points, double flatness,
                              const FeatureOptions& options) {
  return FeatureFinder(std::move(surface), points, flatness, options).find();
}

}  // namespace tetmend
