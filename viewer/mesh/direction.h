// SPDX-License-Identifier: MIT
// From where something small is seen best, and how near to it the mouse is.
#pragma once

#include <array>

#include "viewer/mesh/camera.h"

namespace tetmend::viewer {

/// Area of the shadow that a tet throws along a direction of unit length.
double shadow_of(const std::array<glm::dvec3, 4>& tet, const glm::dvec3& direction);

/// Turns the camera, no further than it must, to where the shadow of the tet is nearly as large as
/// it can be: a flat tet is not seen from its edge. The target stays.
void turn_to(Camera& camera, const std::array<glm::dvec3, 4>& tet);

/// Of a point and a straight line between two, in pixels.
double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b);

}  // namespace tetmend::viewer
