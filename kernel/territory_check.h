// SPDX-License-Identifier: MIT
// Whether a worker may make an edit: all that it changes lies in its territory.
#pragma once

#include <span>

#include "kernel/transaction.h"
#include "kernel/workspace.h"

namespace tetmend {

/// All of these tets are the worker's; a "no" is noted in the workspace, as that of one who did not ask.
/// Looks at nothing where the territory is the whole mesh; else four loads a tet.
bool holds_all(const TetMesh& mesh, std::span<const TetHandle> tets, Workspace& workspace);
/// The same for the vertices and the tets around them.
bool holds_all(const TetMesh& mesh, std::span<const VertexMove> moves, Workspace& workspace);
/// The same for a vertex that new tets have and old ones do not.
bool holds_new(VertexHandle v, Workspace& workspace);

}  // namespace tetmend
