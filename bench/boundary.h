// SPDX-License-Identifier: MIT
// The boundary of a mesh from its plain arrays, by sorting faces: independent of the kernel's
// adjacency.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::bench {

using Face = std::array<std::uint32_t, 3>;

/// The vertex numbers of a face in ascending order: what identifies it.
Face face_key(Face face);

/// Faces of exactly one tet, each counterclockwise as seen from outside a positive tet; ordered by
/// their keys.
std::vector<Face> boundary_faces(const MeshData& mesh);

}  // namespace tetmend::bench
