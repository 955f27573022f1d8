// SPDX-License-Identifier: MIT
// Standard input and output under the name of a file.
#pragma once

#include <filesystem>

namespace tetmend::formats {

/// True for "-.msh" and the like, without a folder: the extension tells the format of what comes
/// from standard input or goes to standard output. A file of such a name is reached as "./-.msh".
inline bool is_standard_stream(const std::filesystem::path& file) {
  return !file.has_parent_path() && file.string().starts_with("-.");
}

}  // namespace tetmend::formats
