// SPDX-License-Identifier: MIT
// What becomes of a mesh between two runs of a program that moves its points in between.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// From now on the mesh counts as just built of what to_data() gives: origins are its numbers, no
/// tet is touched or created, nothing was ever changed. Collects garbage. The bounds hold no stable
/// step then: set_bounds(Bounds()), then what they are. Precondition: no guard, no open
/// transaction.
/// Cost: linear.
void count_as_new(TetMesh& mesh);

/// Puts all points to other places, by TetMesh::origin(), in lengths of the file. Unlike a
/// Transaction it asks no constraint: boundary and walls move, too. Tets that were certified
/// positive stay so: otherwise nothing moves, and the number of those that would not is returned.
/// Precondition: the mesh has nothing deleted; one point for each vertex. Cost: linear.
std::size_t place_points(TetMesh& mesh, std::span<const std::array<double, 3>> points);

/// Makes fixed the vertices that stay, besides those that are anyway; frees what it held before.
/// Cost: linear.
void hold(TetMesh& mesh, const std::function<bool(VertexHandle)>& stays);

}  // namespace tetmend
