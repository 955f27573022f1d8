// SPDX-License-Identifier: MIT
// What the walls of a mesh allow at best, and why each bad tet of the mesh is still there.
//
// A wall is a face that must stay. Two facts carry the proofs. Each side of a wall has one tet; its
// apex is a point, and the three dihedral angles at the wall say which (search/apex_search.h). And
// the angles at an edge between two walls add up to the angle between the walls. Either one tet
// fills it alone, and its vertices are known; or several share it, and the one on the next wall has
// at most what the first leaves (wall_probe.h). Only places that cannot mean the same tet are
// counted. A wall that only stands in the way, as the far side of a thin plate does, is not looked
// at.
//
// Where the surface may move, its walls prove nothing, and only what depends on others alone is
// looked at. With tolerance 0 patches stay in their planes. So the angle between two of them at a
// line is what it is, and bounds the tets at the line.
#pragma once

#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include <tetmend/limit.h>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// Proves that tets are bad in every mesh with the same walls, one wall and its neighbours at a
/// time (see WallProbe). More may be forced than is found. n_forced and the bounds depend on the
/// walls and the order of their vertices, but not on the tets between them or the number of
/// threads. Cost: one pass over the walls and their sectors (0.07 s for 125 thousand), and up to a
/// millisecond for each bad tet on a wall.
/// @param bad null, or filled with each bad tet and why it is there, by slot
SurfaceLimit compute_surface_limit(const TetMesh& mesh,
                                   std::vector<std::pair<TetHandle, Hindrance>>* bad = nullptr);

/// The same; nothing if `cancel` becomes true meanwhile. Null: nobody cancels.
/// @param bad as above; what is in it without a limit means nothing
std::optional<SurfaceLimit> find_surface_limit(
    const TetMesh& mesh, const std::atomic<bool>* cancel,
    std::vector<std::pair<TetHandle, Hindrance>>* bad = nullptr);

}  // namespace tetmend
