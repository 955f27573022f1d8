// SPDX-License-Identifier: MIT
// What no change of a run may make worse.
#pragma once

#include "kernel/bounds.h"
#include "kernel/solver_rulers.h"
#include "kernel/tet_mesh.h"

namespace tetmend::face {

struct BoundsOfRun {
  Bounds bounds;
  bool holds_solver = false;  ///< the stable step and the largest angle are held, too
};

/// A mesh with inverted tets has no step, and what its angles are says little. Cost: linear.
/// @param diagonals of the mesh, where a step is kept; null where it is not
inline BoundsOfRun bounds_of_run(const TetMesh& mesh, const P1Diagonals* diagonals) {
  if (diagonals != nullptr) {
    const Bounds of_solver = Bounds::of(mesh, *diagonals);
    if (!of_solver.are_of_inverted()) return {of_solver, true};
  }
  return {Bounds::of(mesh), false};
}

}  // namespace tetmend::face
