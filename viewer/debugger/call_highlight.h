// SPDX-License-Identifier: MIT
// What the picture of a mesh shows of the call at hand.
#pragma once

#include <cstdint>
#include <vector>

#include "explain/call_study.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/selection.h"

namespace tetmend::viewer {

/// The chords of the covering that the call made or tried, and the sides of its core, as lines on
/// top of the picture. Empty without a covering.
Highlight highlight_covering(const CallStudy& study, const glm::dvec3& origin);

/// The target as something to select in the mesh as it is now, or nothing.
Selection target_in(const TetMesh& mesh, const Call& call);

/// By slot: 1 for the tets of the mesh that the call found or made. Cost: linear.
std::vector<std::uint8_t> tets_of(const TetMesh& mesh, const CallStudy& study);

}  // namespace tetmend::viewer
