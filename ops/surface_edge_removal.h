// SPDX-License-Identifier: MIT
// Removes an edge of a surface that may change.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// Target: an edge. Replaces the shell of an edge inside a patch by the best complete covering of
/// its open ring, as edge removal does inside: the two faces of the surface at the edge give way to
/// the two at the chord that closes the ring. Between two labels the shells of both sides have the
/// same chord. Refuses feature edges.
const OperatorInfo& surface_edge_removal_info();

}  // namespace tetmend
