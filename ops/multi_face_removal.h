// SPDX-License-Identifier: MIT
// Multi-face removal: replaces the faces sandwiched between two vertices, by the same search as for
// a shell.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a face. It and the faces connected to it that both apexes a and b of its two tets see
/// form a polygon. Their tets are replaced by the best covering of the virtual shell of ab: with a
/// core (ab appears) or without (re-triangulation) ([chen, 5.4]; [shewchuk_two]). Refuses boundary
/// and constrained faces. Cost: O(m^3) for m polygon vertices.
const OperatorInfo& multi_face_removal_info();

}  // namespace tetmend
