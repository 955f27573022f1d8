// SPDX-License-Identifier: MIT
// Text of the bytes of strangers: of a file, a script, a plugin, the command line. All that goes to
// a terminal, into JSON, XML, HTML, SVG and DOT is made here.
#pragma once

#include <string>
#include <string_view>

namespace tetmend {

/// The bytes as UTF-8 of one line that any reader takes and no terminal acts on. Bytes that are no
/// UTF-8 are letters of Latin-1. Control characters, line separators, marks of text direction and
/// what is no character are written as \n, \t, \x1b or \u202e. Cut after `most` bytes, with three dots.
std::string printable(std::string_view bytes, std::size_t most = std::string_view::npos);

/// The same of any number of lines: line breaks and tabs stay.
std::string printable_lines(std::string_view bytes);

/// printable() leaves it as it is.
bool is_printable(std::string_view bytes);

}  // namespace tetmend
