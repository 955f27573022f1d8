// SPDX-License-Identifier: MIT
// std::from_chars() also of reals, which the standard library of macOS does not have.
#pragma once

#include <charconv>
#include <cmath>
#include <string_view>
#include <type_traits>

#include <fast_float/fast_float.h>

namespace tetmend {

/// What std::from_chars() says of a real. fast_float takes what is out of range for infinity or 0.
template <class Real>
std::from_chars_result real_from_chars(const char* first, const char* last, Real& value) {
  Real found{};
  const auto [end, error] = fast_float::from_chars(first, last, found);
  if (error != std::errc()) return {first, error};
  const std::string_view text(first, static_cast<std::size_t>(end - first));
  const std::string_view digits = text.substr(0, text.find_first_of("eE"));
  const bool overflows = std::isinf(found) && text.find_first_of("nN") == text.npos;
  const bool underflows = found == 0 && digits.find_first_of("123456789") != text.npos;
  if (overflows || underflows) return {end, std::errc::result_out_of_range};
  value = found;
  return {end, std::errc()};
}

template <class Number>
std::from_chars_result from_chars(const char* first, const char* last, Number& value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::is_floating_point_v<Number>) {
    return real_from_chars(first, last, value);
  } else
#endif
  {
    return std::from_chars(first, last, value);
  }
}

}  // namespace tetmend
