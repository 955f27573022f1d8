// SPDX-License-Identifier: MIT
// Bytes as text: 64 characters, each for 6 bits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tetmend::formats {

/// Takes groups of four characters from `text` and puts their bytes behind `bytes` until it has `size`
/// or some more, or until a character comes that has no place there. White space is passed over.
/// After padding another stream may begin.
void decode_base64(std::string_view& text, std::size_t size, std::string& bytes);

/// With padding.
std::string encode_base64(std::string_view bytes);

}  // namespace tetmend::formats
