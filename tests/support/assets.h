// SPDX-License-Identifier: MIT
// Files of the project that tests read.
#pragma once

#include <filesystem>
#include <string>

namespace tetmend::test {

/// The folder of all sources.
inline const std::filesystem::path kSource = TETMEND_SOURCE_DIR;

/// The path of a mesh of the project.
inline std::string asset(const std::string& name) {
  return (kSource / "assets/meshes" / name).string();
}

}  // namespace tetmend::test
