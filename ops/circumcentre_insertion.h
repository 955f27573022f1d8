// SPDX-License-Identifier: MIT
// A new vertex at the circumcentre of a tet: the step of Delaunay refinement, a baseline.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a tet. Inserts a vertex at its circumcentre, see VertexInsertion. That is often another
/// tet, and outside the mesh for flat tets at the boundary: then the verdict is `constrained`.
const OperatorInfo& circumcentre_insertion_info();

}  // namespace tetmend
