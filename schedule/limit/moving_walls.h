// SPDX-License-Identifier: MIT
// Walls where the surface may move: which of them stay nevertheless, and what flat ones allow.
#pragma once

#include <cstdint>
#include <vector>

#include "schedule/limit/walls.h"

namespace tetmend {

/// A guard may let the wall be replaced by others, or move.
inline bool may_change(const TetMesh& mesh, HalfFace wall) {
  const SurfaceGuard* const guard = mesh.surface_guard();
  return guard != nullptr && guard->patch(mesh.vertices(wall)) != SurfaceGuard::kNone;
}

/// No operation may move the vertex.
bool is_held(const TetMesh& mesh, VertexHandle v);

/// A constraint of the tet stays whatever the surface does: of a face or an edge that is not on it.
bool has_lasting_constraint(const TetMesh& mesh, TetHandle t);

/// A sector at a feature line whose walls never leave their planes. All tets in it have an angle of
/// at most `angle`, and there always is one.
struct SharpLine {
  double angle = 0;              ///< of the smallest sector at the line, radians
  std::vector<TetHandle> worst;  ///< the worst tet of the sector, for each edge of the line
};

/// The lines of sectors below `most` (radians) where the surface may move with tolerance 0; none for
/// any other mesh. The sharpest first. Cost: a pass over the tets, and three sectors for each wall.
std::vector<SharpLine> find_sharp_lines(const TetMesh& mesh, double most);

}  // namespace tetmend
