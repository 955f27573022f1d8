// SPDX-License-Identifier: MIT
// Insertion of a vertex on a surface that may change, into the cavity that suits it best.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet with a face on the surface. As cavity_insertion(), but the vertex lies on the surface: its
/// places are the centroids of these faces and the middles of their edges that are no feature edges. Faces of
/// the same patch in the cavity give way to faces at the vertex; between regions the cavity has tets of both
/// sides, which keep their labels. The vertex moves in the plane of the face that it began with; the guard of
/// the surface decides. Refuses as `constrained` where there is no such face, or where the guard does.
/// Cost: that of cavity_insertion() for at most 4 places for each face.
const OperatorInfo& surface_insertion_info();

}  // namespace tetmend
