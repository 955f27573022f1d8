// SPDX-License-Identifier: MIT
// What is wrong with a file that is to be a mesh and has no name of one: it is not there, or a trace.
#pragma once

#include <filesystem>

namespace tetmend {

/// The file begins as a trace does, of whatever version. False for one that cannot be read.
bool is_trace(const std::filesystem::path& file);

/// For whoever is given a mesh. Readers of meshes would speak of the extension alone; where a format
/// has it, nothing is looked at.
/// @throws Error with the name when the file is not there, or is a trace
void refuse_what_is_no_mesh(const std::filesystem::path& file);

}  // namespace tetmend
