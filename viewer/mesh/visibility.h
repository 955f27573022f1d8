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

/// By slot: 1 for a tet that is in the chosen regions and passes the filter. Cost: linear.
std::vector<std::uint8_t> chosen_tets(const TetMesh& mesh, const SceneSettings& settings,
                                      const TetFigures& figures);

/// Takes away what is peeled and what whole-tet cuts hide. Cost: linear.
void hide_cut_and_peeled(const TetMesh& mesh, const SceneSettings& settings,
                         const TetFigures& figures, const Ball& ball,
                         std::vector<std::uint8_t>& shown);

}  // namespace tetmend::viewer
