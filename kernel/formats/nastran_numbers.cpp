// SPDX-License-Identifier: MIT
// Cards of Nastran in each of the three forms, and numbers in the room that they have.
#include "kernel/formats/nastran_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {
namespace {

/// "1.25e-01" as ".125" or "1.25-1", in as few characters as possible.
std::string short_form(std::string_view scientific) {
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(std::string(scientific.substr(e + 1)));
  const std::string_view sign = scientific.starts_with('-') ? "-" : "";
  std::string memory(scientific.substr(sign.size(), e - sign.size()));
  std::erase(memory, '.');
  memory.resize(std::max<std::size_t>(1, memory.find_last_not_of('0') + 1));
  const std::string_view digits = memory;
  const std::string with_exponent =
      fmt::format("{}{}.{}{:+}", sign, digits.substr(0, 1), digits.substr(1), exponent);
  constexpr int kRoom = static_cast<int>(kNastranRoom);
  if (exponent < -kRoom || exponent >= kRoom) return with_exponent;
  std::string fixed;
  if (exponent < 0) {
    fixed = fmt::format("{}.{:0>{}}{}", sign, "", -exponent - 1, digits);
  } else {
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    const std::size_t given = std::min(whole, digits.size());
    fixed = fmt::format("{}{}{:0>{}}.{}", sign, digits.substr(0, given), "", whole - given,
                        digits.substr(given));
  }
  return fixed.size() <= with_exponent.size() ? fixed : with_exponent;
}

}  // namespace

std::string nastran_short_form(double value, std::size_t room) {
  constexpr std::size_t kMostDigits = 15;
  std::array<char, 32> memory{};
  const auto [end, error] = std::to_chars(memory.data(), memory.data() + memory.size(), value,
                                          std::chars_format::scientific);
  const std::string_view shortest(memory.data(), static_cast<std::size_t>(end - memory.data()));
  constexpr std::size_t kSigns = 2;  // of the number, and its point
  if (shortest.find('e') > kMostDigits + kSigns) return {};
  std::string text = short_form(shortest);
  return text.size() <= room ? text : std::string();
}

std::string nastran_rounded(double value) {
  constexpr int kMostDigits = 15;
  for (int digits = kMostDigits; digits > 0; --digits) {
    std::string text = short_form(fmt::format("{:.{}e}", value, digits - 1));
    double again = 0;  // the greatest numbers must not be rounded up
    if (text.size() <= kNastranRoom && nastran_real(text, again)) return text;
  }
  return nastran_digits(value);
}

std::string nastran_digits(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  std::string digits(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t exponent = std::min(digits.find('e'), digits.size());
  if (digits.find('.') == std::string::npos) digits.insert(exponent, 1, '.');
  return digits;
}

std::string nastran_real_field(double value, std::size_t room) {
  std::string digits = nastran_digits(value);
  return digits.size() <= room ? digits : nastran_short_form(value, room);
}

void put_nastran_card(OutputBuffer& buffer, std::string_view name,
                      std::span<const std::string> fields, std::string_view form) {
  const auto fit = [&](std::size_t room) {
    return std::all_of(fields.begin(), fields.end(),
                       [&](const std::string& field) { return field.size() <= room; });
  };
  constexpr std::string_view kBlanks = "                ";
  const bool is_short = form == kNastranShort && fit(kNastranShortRoom);
  const bool is_long = form != kNastranFree && !is_short && fit(kNastranRoom);
  const std::size_t width = is_short ? kNastranShortRoom : is_long ? kNastranRoom : 0;
  const std::size_t fields_of_line = is_long ? 4 : 8;
  buffer.put(name);
  if (is_long) buffer.put('*');
  const std::size_t used = name.size() + (is_long ? 1 : 0);
  if (width > 0)
    buffer.put(kBlanks.substr(0, kNastranShortRoom - std::min(used, kNastranShortRoom)));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (k > 0 && k % fields_of_line == 0)
      buffer.put(is_short ? "\n+       " : is_long ? "\n*       " : ",+\n+");
    if (width > 0)
      buffer.put(kBlanks.substr(0, width - fields[k].size()));
    else
      buffer.put(',');
    buffer.put(fields[k]);
  }
  buffer.put('\n');
}

}  // namespace tetmend::formats
