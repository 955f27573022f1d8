// SPDX-License-Identifier: MIT
// Bad tets one by one, as users see them.
#pragma once

#include <tetmend/measure.h>

#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// All but its numbers. Lengths are those of the file.
BadTet describe(const TetMesh& mesh, TetHandle t, Hindrance hindrance);

}  // namespace tetmend::face
