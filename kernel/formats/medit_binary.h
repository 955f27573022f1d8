// SPDX-License-Identifier: MIT
// MEDIT's binary format `.meshb` (also known as GMF: Gamma Mesh Format).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

inline constexpr std::int32_t kNewestMeditVersion = 4;  ///< of binary files

/// True of the first bytes of a binary MEDIT file, whatever its name: the cookie and a version, in
/// either byte order.
bool looks_like_medit_binary(std::string_view bytes);

/// Versions 1 to 4 (4- or 8-byte coordinates, file positions and integers) in both byte orders;
/// keeps the same sections as `read_medit_ascii`. @throws Error
MeshData read_medit_binary(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Version 2, or 3 when the file grows beyond 2 GiB, or 4 when a count needs more than 31 bits. The
/// byte order is that of this machine, as the format wants it. @throws Error
void write_medit_binary(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
