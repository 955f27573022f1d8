// SPDX-License-Identifier: MIT
// A number that tells whether a surface is still the same.
#pragma once

#include <cstdint>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// A number that changes when a boundary triangle or a constrained face comes, goes, or moves in
/// the last bit of a coordinate. It does not depend on numbering.
std::uint64_t surface_fingerprint(const TetMesh& mesh);

}  // namespace tetmend
