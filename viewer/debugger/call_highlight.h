// SPDX-License-Identifier: MIT
// What the picture of a mesh shows of the call at hand.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "explain/call_study.h"
#include "figure/colour.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/selection.h"

namespace tetmend::viewer {

/// The chords of the covering that the polygon of the call shows, and the sides of its core, as
/// lines on top of the picture. Empty without a covering.
Highlight highlight_covering(const CallStudy& study, const PolygonView& polygon,
                             const glm::dvec3& origin);

/// The pocket of the cell of the tables that the polygon shows, and the triangle that it has chosen.
/// Empty without a cell.
Highlight highlight_cell(const CallStudy& study, const PolygonView& polygon,
                         const glm::dvec3& origin);

/// The tets around an edge, as the caller of a recursive call has them now: a ghost.
Highlight highlight_caller(const TetMesh& mesh, TetEdge edge, const glm::dvec3& origin);

/// The face that a recursive call is to remove. Empty if one of its vertices is gone.
Highlight highlight_face(const TetMesh& mesh, const std::array<VertexHandle, 3>& face,
                         const glm::dvec3& origin);

/// The tets of something in the mesh, each once, ascending: a tet, a shell, a ball.
std::vector<TetHandle> tets_of(const TetMesh& mesh, const Selection& selection);

/// The target as something to select in the mesh as it is now, or nothing. `around` lists the tets
/// that contain it.
Selection target_in(const TetMesh& mesh, const Call& call, std::span<const TetHandle> around);

/// The tets of the mesh that the call found or made, each once.
std::vector<TetHandle> tets_of(const TetMesh& mesh, const CallStudy& study);

using figure::kFaceToRemoveColour;
using figure::kGhostColour;

}  // namespace tetmend::viewer
