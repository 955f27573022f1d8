// SPDX-License-Identifier: MIT
// Rows of a mesh file, formatted in blocks on all threads and written in order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

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

/// As text: the shortest digits from which the same number is read back.
template <class Value>
void put_number(OutputBuffer& buffer, Value value) {
  if constexpr (std::is_integral_v<Value>) {
    buffer.put_integer(value);
  } else if constexpr (std::is_same_v<Value, float>) {
    std::array<char, 32> text{};
    const char* const end = fmt::format_to(text.data(), FMT_COMPILE("{}"), value);
    buffer.put(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
  } else {
    buffer.put_real(value);
  }
}

}  // namespace tetmend::formats
