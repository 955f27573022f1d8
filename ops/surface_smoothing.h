// SPDX-License-Identifier: MIT
// Smoothing of one vertex of a surface that may change.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: a vertex. Moves a vertex of a patch in its tangent plane, one of a feature line along
/// it, to where the worst tet of its ball is best ([freitag_ollivier_gooch]); each place is pulled
/// back to the nearest of the patch or line. Where the guard of the surface refuses, half of the way
/// is tried. Vertices inside are for `smoothing`.
const OperatorInfo& surface_smoothing_info();

}  // namespace tetmend
