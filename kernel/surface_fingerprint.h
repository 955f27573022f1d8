// SPDX-License-Identifier: MIT
// A number that tells whether a surface is still the same.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// A number that changes when a boundary triangle or a constrained face comes, goes, or moves in
/// the last bit of a coordinate. It does not depend on numbering.
std::uint64_t surface_fingerprint(const TetMesh& mesh);

/// Of some faces: that of all is the sum over sets that divide them. `counts` is asked by several
/// threads for each face of a tet by its vertices.
std::uint64_t surface_fingerprint(
    const TetMesh& mesh, const std::function<bool(const std::array<VertexHandle, 3>&)>& counts);

}  // namespace tetmend
