// SPDX-License-Identifier: MIT
#include "envelope/features.h"

#include <algorithm>
#include <limits>

#include "envelope/feature_finder.h"

namespace tetmend {

double flatness(const TetMesh& mesh) {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    if (mesh.is_deleted(VertexHandle(i))) continue;
    low = low.cwiseMin(mesh.point(VertexHandle(i)));
    high = high.cwiseMax(mesh.point(VertexHandle(i)));
  }
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  return std::max(1e-13 * (high - low).norm(), kRounding * largest);
}

SurfaceFeatures find_features(const TetMesh& mesh, const FeatureOptions& options) {
  return FeatureFinder(mesh, options).find();
}

}  // namespace tetmend
