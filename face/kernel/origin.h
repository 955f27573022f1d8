// SPDX-License-Identifier: MIT
// What a program's mesh was made of, as far as the way back needs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "face/kernel/tet_mesh.h"
#include "kernel/mesh_data.h"

namespace tetmend::kernel {

struct TetMesh::Origin {
  std::size_t point_count = 0;
  std::vector<std::string> notes;
  bool holds_more = false;  ///< than tetmend::TetMesh knows; the rest is empty otherwise
  MeshData data;            ///< its points as they are worked with
  std::vector<std::uint32_t> tet_numbers;  ///< in it, by slot
};

}  // namespace tetmend::kernel
