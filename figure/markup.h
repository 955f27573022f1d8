// SPDX-License-Identifier: MIT
// Text in SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace tetmend::figure {

/// Text as text, between tags and in quotes: printable_lines().
std::string escaped(std::string_view text);

}  // namespace tetmend::figure
