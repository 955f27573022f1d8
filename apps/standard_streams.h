// SPDX-License-Identifier: MIT
// What the program says, to streams that may be closed, full or broken.
#pragma once

#include <cstdio>
#include <string_view>

namespace tetmend::apps {

/// Writes printable_lines() of the text, as far as it goes. std::ferror() knows of a failure.
void say(std::FILE* stream, std::string_view text) noexcept;

enum class Colour : unsigned char { red = 31, green = 32 };

/// The same in a colour, where a person sees it: on a terminal that can show one, unless the
/// environment variable NO_COLOR is there and not empty.
void say(std::FILE* stream, std::string_view text, Colour colour) noexcept;

}  // namespace tetmend::apps
