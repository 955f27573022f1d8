// SPDX-License-Identifier: MIT
// Small polyhedron reconnection: empties the surroundings of a tet and fills them anew in the best
// way.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Grows a polyhedron around it, vertex by vertex, and searches its best
/// tetrahedralisation until one is better ([liu_spr]; the growing cavity is that of
/// [marot_quality]). All vertices are kept. Parameters: min_vertices (7) and max_vertices (20) of
/// the polyhedron, max_nodes (500) of each search, desperate as in edge_split. Refuses as
/// `no_improvement` when the largest polyhedron has nothing better, as `budget_spent` when that
/// could not be settled. Cost: for each size a search, see PolyhedronSearch.
const OperatorInfo& polyhedron_reconnection_info();

}  // namespace tetmend
