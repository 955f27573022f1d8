// SPDX-License-Identifier: MIT
// Labels of points that are new on a surface that has changed.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// A new point of the boundary, or of a face between labels, gets the label that the corners of the
/// nearest old triangle have in common; where it lies on an edge or a corner of that, only these
/// count. Else its label is 0, as of a new point inside.
/// @param vertex_map of the points before, see maps.h
/// Cost: n log n in the number of faces; nothing if no point has a label.
void label_surface_points(const MeshData& before, std::span<const std::uint32_t> vertex_map,
                          MeshData& now);

/// Of a point of a triangle: what the corners that carry it have in common; 0 if they differ.
Label common_label(const std::array<Point, 3>& corners, const std::array<Label, 3>& labels,
                   const Point& p);

}  // namespace tetmend::face
