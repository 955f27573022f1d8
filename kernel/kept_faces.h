// SPDX-License-Identifier: MIT
// Which tets a scan for faces that stay need look at.
#pragma once

#include "kernel/tet_mesh.h"

namespace tetmend {

/// A face of the tet lies on the boundary, a face or an edge of it is constrained, or it is frozen.
/// Most tets have nothing of the kind.
inline bool may_have_kept_face(const TetMesh& mesh, TetHandle t) {
  const auto& twins = mesh.neighbours(t);
  return twins[0].is_outside() || twins[1].is_outside() || twins[2].is_outside() ||
         twins[3].is_outside() || mesh.has_constraints(t);
}

}  // namespace tetmend
