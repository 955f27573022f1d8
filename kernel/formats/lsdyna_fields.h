// SPDX-License-Identifier: MIT
// The fields of a line that is written to a keyword file of LS-DYNA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kernel/formats/output_rows.h"

namespace tetmend::formats {

/// In at most `room` characters, with all digits if they have room. "0.5" may be ".5".
std::string lsdyna_real(double value, std::size_t room);
/// True if fewer digits have room.
bool lsdyna_rounds(double value, std::size_t room);

/// Fields of one line: of fixed width, or with commas, where a number is wider than its field.
struct LsDynaLine {
  static constexpr std::string_view kSpaces = "                    ";

  OutputBuffer& buffer;
  bool is_free = false;
  bool is_first = true;

  void put(std::string_view text, std::size_t width) {
    if (is_free) {
      if (!is_first) buffer.put(',');
    } else if (text.size() < width) {
      buffer.put(kSpaces.substr(0, width - text.size()));
    }
    buffer.put(text);
    is_first = false;
  }
  void put(std::int64_t number, std::size_t width) {
    const fmt::format_int text(number);
    put(std::string_view(text.data(), text.size()), width);
  }
  void end() {
    buffer.put('\n');
    is_first = true;
  }
};

}  // namespace tetmend::formats
