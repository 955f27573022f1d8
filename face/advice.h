// SPDX-License-Identifier: MIT
// What a user should know about a mesh before a run, and about what held the run back.
#pragma once

#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// Says where points touch without being joined and which boundary layers are kept, and warns of a
/// mesh that is stretched throughout. Reads the statistics before the run and the numbers of layers.
/// Cost: that of find_unjoined(); linear where a third of the tets is bad.
std::vector<std::string> advice_before(const TetMesh& mesh, const Result& result);

/// Says how many tets are inverted or flat and why, unless the run was cancelled; which constraints
/// hold a tenth or more of the bad tets that are left, and what would free them. A constraint holds
/// a tet if a face or an edge of the tet is one, or if it alone fixes one of its vertices. Offers
/// `--surface flat` where it would remove 10 of them or more, and a twentieth. Cost: linear, little
/// where no constraints are inside; see count_inverted(), estimate_freed_by_flat().
/// @param input what the mesh was built of
std::vector<std::string> advice_after(const TetMesh& mesh, const MeshData& input,
                                      const Options& options, const Result& result);

}  // namespace tetmend::face
