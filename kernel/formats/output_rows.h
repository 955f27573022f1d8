// SPDX-License-Identifier: MIT
// Rows of a mesh file, formatted in blocks on all threads and written in order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/formats/output_file.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// put(i, buffer) for each row from 0 on.
template <class Put>
void put_rows(OutputFile& out, std::size_t rows, const Put& put) {
  constexpr std::size_t kRowsOfBlock = std::size_t{1} << 13;
  out.put_blocks((rows + kRowsOfBlock - 1) / kRowsOfBlock,
                 [&](std::size_t block, OutputBuffer& buffer) {
                   const std::size_t end = std::min(rows, (block + 1) * kRowsOfBlock);
                   for (std::size_t i = block * kRowsOfBlock; i < end; ++i) put(i, buffer);
                 });
}

/// put(number, tet, buffer) for each tet.
template <class Put>
void put_tets(OutputFile& out, const MeshView& mesh, const Put& put) {
  out.put_blocks(mesh.tet_blocks(), [&](std::size_t block, OutputBuffer& buffer) {
    std::vector<MeshData::Tet> memory;
    std::size_t number = mesh.first_tet(block);
    for (const MeshData::Tet& tet : mesh.tets(block, memory)) put(number++, tet, buffer);
  });
}

}  // namespace tetmend::formats
