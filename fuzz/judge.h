// SPDX-License-Identifier: MIT
// The promises of a run, from plain arrays by formulas of its own: shares nothing with the kernel.
#pragma once

#include <tetmend/improve.h>
#include <tetmend/mesh.h>

namespace tetmend::fuzz {

/// Ends the program when a run, finished or failed, broke a promise: the surface and the faces
/// between labels have the same triangles with the same coordinates, bit for bit; every label has its
/// volume; there are no more tets without positive volume.
void require_same_space(const MeshArrays& before, const MeshArrays& after);

/// The same, and for a run that came to an end: the smallest angle is no smaller, no more tets miss
/// the goal.
void require_promises(const MeshArrays& before, const MeshArrays& after, const Goal& goal);

/// A tetrahedral grid of 2 x 2 x 2 cubes with 27 vertices, of two labels.
MeshArrays small_mesh();

}  // namespace tetmend::fuzz
