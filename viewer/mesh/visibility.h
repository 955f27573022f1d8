// SPDX-License-Identifier: MIT
// Which tets are shown: whole tets only; exact cuts are the business of the scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/tet_mesh.h"
#include "viewer/mesh/camera.h"
#include "viewer/mesh/view_settings.h"

namespace tetmend::viewer {

/// A plane in world coordinates: what has normal . x > offset is cut away.
struct Plane {
  glm::dvec3 normal{1, 0, 0};  ///< unit length
  double offset = 0;
  double height(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

/// The planes that are on, exact ones or the others. `ball` encloses the mesh.
std::vector<Plane> planes_of(const SceneSettings& settings, const Ball& ball, bool exact);

glm::dvec3 to_glm(const Point& p);

/// Measured per tet, by slot.
struct TetFigures {
  std::span<const float> values;          ///< of settings.measure
  std::span<const std::uint32_t> layers;  ///< may be empty when nothing is peeled
};

/// Which tets the settings let through. What it is made of must outlive it.
class TetFilter {
 public:
  /// `ball` encloses the mesh.
  TetFilter(const TetMesh& mesh, const SceneSettings& settings, const TetFigures& figures,
            const Ball& ball);
  /// It is there, in the chosen regions, and passes the filter.
  bool is_chosen(TetHandle t) const;
  /// It is peeled off, or whole-tet cuts hide it.
  bool is_cut_away(TetHandle t) const;

 private:
  const TetMesh& mesh_;
  const SceneSettings& settings_;
  const TetFigures& figures_;
  std::vector<Plane> planes_;
};

}  // namespace tetmend::viewer
