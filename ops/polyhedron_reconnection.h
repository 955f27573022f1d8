// SPDX-License-Identifier: MIT
// Small polyhedron reconnection: empties the surroundings of a tet and fills them again in the best
// way.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Grows a polyhedron around it, vertex by vertex, and searches its best
/// tetrahedralisation until one is better ([liu_spr]; the growing cavity is that of
/// [marot_quality]). By itself it keeps all vertices where they are. With `relax` it takes any
/// tetrahedralisation without the target, and smooths the vertices of the polyhedron before the
/// change is judged. With `insert` there is one vertex more, and the search finds the best cavity
/// for it. With `remove`, vertices inside may vanish.
///
/// A change is kept if the quality vector is better, there are no more bad tets, and they lack no
/// more in sum. The last two do not count when the old worst tet is desperate and gains 0.002 for
/// each new bad one. Refuses as `no_improvement` when no size brings that, as `budget_spent` when
/// the search of the largest was cut short, as `not_applicable` where tets overlap. Cost: a search
/// for each size, see PolyhedronSearch, and with `relax` the smoothing of its vertices.
const OperatorInfo& polyhedron_reconnection_info();

}  // namespace tetmend
