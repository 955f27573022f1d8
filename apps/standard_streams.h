// SPDX-License-Identifier: MIT
// What the program says, to streams that may be closed, full or broken.
#pragma once

#include <cstdio>
#include <string_view>

namespace tetmend::apps {

/// Fills those of the descriptors 0 to 2 that are closed, so that no file that is opened later gets
/// what is said. Reading and writing fail there as before.
void reserve_standard_streams() noexcept;

/// Writes the text as far as it goes. std::ferror() knows of a failure.
void say(std::FILE* stream, std::string_view text) noexcept;

/// A reader that goes away is from now on an error of the stream, not the end of the program.
void ignore_broken_pipes() noexcept;

}  // namespace tetmend::apps
