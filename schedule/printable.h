// SPDX-License-Identifier: MIT
// Text of a stranger's script, as it may be shown on a terminal and written to a report.
#pragma once

#include <string>
#include <string_view>

namespace tetmend {

/// The text with control characters, and bytes that are no UTF-8, written as \n, \t or \x1b. Cut
/// after `most` bytes, with three dots.
std::string printable(std::string_view text, std::size_t most = std::string_view::npos);

}  // namespace tetmend
