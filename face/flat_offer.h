// SPDX-License-Identifier: MIT
// How many bad tets a surface would free that may change where that changes no shape.
#pragma once

#include <cstddef>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// An estimate of how many of the bad tets left would go with `--surface flat`, from where they
/// lie: no operator is tried. 0 for a mesh of second order, whose surface must stay. Looks at frozen
/// tets no more than a run does. Cost: one look at each bad tet, and that of find_features().
/// @param input what the mesh was built of
/// @param bad how many tets are bad that are not frozen
/// @param least  where fewer than that can go, the answer is 0: then too few bad tets lie at the
/// surface, and nothing else is looked at
std::size_t estimate_freed_by_flat(const TetMesh& mesh, const MeshData& input, std::size_t bad,
                                   std::size_t least);

}  // namespace tetmend::face
