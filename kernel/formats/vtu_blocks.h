// SPDX-License-Identifier: MIT
// Packed blocks of the arrays of a .vtu file, by which of VTK's compressors they may be.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace tetmend::formats {

enum class VtuPacking { none, zlib, lz4, lzma };

/// By the attribute `compressor`, which may be empty; nothing for an unknown one.
std::optional<VtuPacking> vtu_packing(std::string_view compressor);

/// False where tetmend is built without the library for it.
bool can_unpack(VtuPacking packing);

/// A block of `size` bytes to `to`. False if it is damaged or has another size.
bool unpack_block(VtuPacking packing, std::string_view block, char* to, std::size_t size);

}  // namespace tetmend::formats
