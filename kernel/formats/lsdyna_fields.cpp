// SPDX-License-Identifier: MIT
#include "kernel/formats/lsdyna_fields.h"

#include <array>
#include <charconv>
#include <cmath>

#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

namespace {

/// "e-05" is "e-5", "e+10" is "e10".
std::string with_short_exponent(const std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  return fmt::format("{}e{}", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string lsdyna_real(double value, std::size_t room) {
  std::string text = fmt::format("{}", value);
  if (text.size() <= room) return text;
  const std::size_t zero = text.find("0.");
  if (zero == 0 || (zero == 1 && text[0] == '-')) {
    std::string bare = text;
    bare.erase(zero, 1);
    if (bare.size() <= room && bare.find('e') == std::string::npos) return bare;
  }
  std::array<char, 40> memory{};
  const auto [end, error] = std::to_chars(memory.data(), memory.data() + memory.size(), value,
                                          std::chars_format::scientific);
  text = with_short_exponent(std::string(memory.data(), end));
  for (int digits = 17; text.size() > room && digits > 0; --digits) {
    text = with_short_exponent(fmt::format("{:.{}g}", value, digits));
  }
  // The largest numbers may be rounded out of the range of a double.
  double again = 0;
  if (std::isfinite(value) && (!nastran_real(text, again) || !std::isfinite(again))) {
    return lsdyna_real(value * (1 - 1e-8), room);
  }
  return text;
}

bool lsdyna_rounds(double value, std::size_t room) {
  double again = 0;
  return !nastran_real(lsdyna_real(value, room), again) || again != value;
}

}  // namespace tetmend::formats
