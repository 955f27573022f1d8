// SPDX-License-Identifier: MIT
// What the picture of a mesh shows of the call at hand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "explain/call_study.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/selection.h"

namespace tetmend::viewer {

/// The chords of the covering that the call made or tried, and the sides of its core, as lines on
/// top of the picture. Empty without a covering.
Highlight highlight_covering(const CallStudy& study, const glm::dvec3& origin);

/// The target as something to select in the mesh as it is now, or nothing. `around` lists the tets
/// that contain it.
Selection target_in(const TetMesh& mesh, const Call& call, std::span<const TetHandle> around);

/// The tets of the mesh that the call found or made, each once.
std::vector<TetHandle> tets_of(const TetMesh& mesh, const CallStudy& study);

}  // namespace tetmend::viewer
