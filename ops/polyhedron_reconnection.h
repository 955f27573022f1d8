// SPDX-License-Identifier: MIT
// Small polyhedron reconnection: empties the surroundings of a tet and fills them anew in the best
// way.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Grows a polyhedron around it, vertex by vertex, and searches its best
/// tetrahedralisation until one is better ([liu_spr]; the growing cavity is that of
/// [marot_quality]). By itself it keeps all vertices where they are. With `relax` it asks for any
/// tetrahedralisation without the target, smooths the vertices of the polyhedron, and then judges;
/// with `insert` there is one vertex more, and the search finds the best cavity for it; with
/// `remove`, those inside may vanish.
///
/// A change is kept if the quality vector is better and, unless the old worst tet is desperate
/// and gains 0.001 for each new bad one, there are no more bad tets and they lack no more in sum.
/// Refuses as `no_improvement` when no size brings that; as `budget_spent` when the search of the
/// largest was cut short; as `not_applicable` where tets overlap. Cost: a search for each size, see
/// PolyhedronSearch, and with `relax` the smoothing of its vertices.
const OperatorInfo& polyhedron_reconnection_info();

}  // namespace tetmend
