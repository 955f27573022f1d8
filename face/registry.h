// SPDX-License-Identifier: MIT
// The operators that a run works with.
#pragma once

#include <filesystem>
#include <vector>

#include "ops/registry.h"

namespace tetmend::face {

/// The operators of tetmend, then those of the plugins. A file that is named twice is loaded once.
/// @throws Error for a plugin that cannot be loaded.
Registry load_registry(const std::vector<std::filesystem::path>& plugins);

}  // namespace tetmend::face
