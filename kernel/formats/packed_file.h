// SPDX-License-Identifier: MIT
// Whole files that are packed: by gzip, bzip2, xz or Zstandard.
#pragma once

#include <filesystem>
#include <string_view>

#include "kernel/formats/compression.h"

namespace tetmend::formats {

/// Known by its first bytes.
bool is_packed(std::string_view bytes);

/// All that a packed file holds, of one stream or several. Memory is taken as bytes come out; see
/// is_bomb(). Precondition: is_packed().
/// @throws Error with the reason, without the name of the file; also where tetmend is built without
/// the library for it
Inflated unpack(std::string_view bytes);

/// True if the name ends as those of packed files do: ".gz", ".bz2", ".xz", ".zst". Only the first is
/// written.
bool has_packed_name(const std::filesystem::path& file);

/// @throws Error for the name of a packed file that is not written
void check_packing_to_write(const std::filesystem::path& file);

}  // namespace tetmend::formats
