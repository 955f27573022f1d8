// SPDX-License-Identifier: MIT
// The faces of the tets of a MeshData, which has no adjacency.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

struct TetFace {
  std::array<std::uint32_t, 3> vertices{};  ///< ascending
  std::uint32_t tet = 0;
};

/// Of all tets: those of the same vertices beside each other, by the number of their tet. Cost:
/// n log n; takes 64 bytes a tet.
std::vector<TetFace> sorted_tet_faces(const MeshData& mesh);

/// Calls act(first, second) for each face; `second` is null if only one tet has it.
template <class Action>
void for_face_pairs(const std::vector<TetFace>& faces, Action act) {
  for (std::size_t i = 0; i < faces.size();) {
    const bool is_pair = i + 1 < faces.size() && faces[i + 1].vertices == faces[i].vertices;
    act(faces[i], is_pair ? &faces[i + 1] : nullptr);
    i += is_pair ? 2 : 1;
  }
}

}  // namespace tetmend
