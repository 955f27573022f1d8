// SPDX-License-Identifier: MIT
// What the walls of a mesh allow at best, and why each bad tet of the mesh is still there.
#pragma once

#include <tetmend/limit.h>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// Proves that tets are bad in every mesh with the same walls, one wall and its neighbours at a
/// time (see WallProbe). More may be forced than is found. n_forced and the bounds depend on the
/// walls and the order of their vertices, not on the tets between them nor on the number of
/// threads. Cost: one pass over the walls and their sectors (0.07 s for 125 thousand), and up to a
/// millisecond for each bad tet on a wall.
SurfaceLimit compute_surface_limit(const TetMesh& mesh);

}  // namespace tetmend
