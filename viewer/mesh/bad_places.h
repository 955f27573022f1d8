// SPDX-License-Identifier: MIT
// Where bad tets are many: what a picture of a hundred thousand of them does not tell.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/quality.h"
#include "kernel/tet_mesh.h"
#include "viewer/mesh/camera.h"

namespace tetmend::viewer {

/// A cube of the box around the mesh, with bad tets.
struct BadPlace {
  Ball ball;             ///< encloses the cube
  std::size_t bad = 0;   ///< tets of a quality below the bound with their centre in it
  std::size_t tets = 0;  ///< all tets with their centre in it
  TetHandle worst;       ///< of them
  Quality q_worst = 0;
};

/// The places with most bad tets, at most `most`, in that order; equal ones from the corner of least
/// coordinates on. The longest side of the box has kPlacesAlong cubes.
/// @param below tets whose angles are of less quality are bad; 1: the goal
/// Cost: linear.
inline constexpr unsigned kPlacesAlong = 12;
std::vector<BadPlace> bad_places(const TetMesh& mesh, double below, std::size_t most);

}  // namespace tetmend::viewer
