// SPDX-License-Identifier: MIT
// Lengths at vertices from a solution file of MEDIT, `.sol` in text or `.solb` in binary.
#pragma once

#include <filesystem>
#include <vector>

#include <tetmend/api.h>

namespace tetmend::formats {

/// What the file holds for each vertex, which must be one number above 0. Other sections are passed
/// over.
/// @throws Error with file and line or byte: for a file that is none of these or is damaged, for vectors
/// or metrics at the vertices, and for a number that is no length.
TETMEND_API std::vector<double> read_medit_sizes(const std::filesystem::path& file);

}  // namespace tetmend::formats
