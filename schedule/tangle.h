// SPDX-License-Identifier: MIT
// The parts of a mesh where so many tets are inverted that one after the other cannot be mended.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "kernel/tet_mesh.h"
#include "schedule/pass_options.h"

namespace tetmend {

/// Tets around free vertices that can be moved independently of the rest.
struct Tangle {
  std::vector<VertexHandle> free;  ///< in the order of a walk from the first
  std::vector<TetHandle> tets;     ///< all around them
  TetHandle worst;                 ///< lowest quality, the first of such
};

/// Finds the inverted and flat tets with a free vertex, gathers those that are neighbours, and takes
/// what reaches the limits, with the rings around. Those rings may join several. Where no part of
/// the mesh is tangled, costs one scan and a walk around each inverted tet.
/// @param proceed asked often; false: nothing is found
std::vector<Tangle> find_tangles(const TetMesh& mesh, const TangleLimits& limits,
                                 const std::function<bool()>& proceed);

}  // namespace tetmend
