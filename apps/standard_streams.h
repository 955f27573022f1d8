// SPDX-License-Identifier: MIT
// What the program says, to streams that may be closed, full or broken.
#pragma once

#include <cstdio>
#include <string_view>

namespace tetmend::apps {

/// Writes printable_lines() of the text, as far as it goes. std::ferror() knows of a failure.
void say(std::FILE* stream, std::string_view text) noexcept;

}  // namespace tetmend::apps
