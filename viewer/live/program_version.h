// SPDX-License-Identifier: MIT
// Which tetmend this is.
#pragma once

#include <string_view>

namespace tetmend::viewer {

/// "0.1.0".
std::string_view program_version();

}  // namespace tetmend::viewer
