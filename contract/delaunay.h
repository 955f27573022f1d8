// SPDX-License-Identifier: MIT
// Delaunay tetrahedra of a few points, for small meshes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::contract {

/// Positive tets whose circumspheres hold no other point. Inserts one point after the other (Bowyer
/// and Watson) with exact predicates. Precondition: no five points on a sphere, no four on a plane,
/// all in the ball of radius 2. Cost: quadratic.
std::vector<std::array<std::uint32_t, 4>> delaunay(std::span<const Point> points);

}  // namespace tetmend::contract
