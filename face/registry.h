// SPDX-License-Identifier: MIT
// The operators that a run works with.
#pragma once

#include <filesystem>
#include <vector>

#include "ops/registry.h"

namespace tetmend::kernel {
class Operators;
}

namespace tetmend::face {

/// The operators of tetmend, then those of the plugins and of the program, where there are any. A file that is named
/// twice is loaded once. @param own must outlive the registry and its copies
/// @throws Error for a plugin that cannot be loaded, and for a name that is taken
Registry load_registry(const std::vector<std::filesystem::path>& plugins,
                       const kernel::Operators* own = nullptr);

}  // namespace tetmend::face
