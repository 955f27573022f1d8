// SPDX-License-Identifier: MIT
// Reals where the standard library cannot read them.
#include "kernel/from_chars.h"

#include <cstddef>
#include <string_view>
#include <system_error>

#include <doctest/doctest.h>

using namespace tetmend;

namespace {

struct Reading {
  double value = -7;  // what is left when nothing is read
  std::errc error{};
  std::ptrdiff_t length = 0;
  friend bool operator==(const Reading&, const Reading&) = default;
};

template <class Read>
Reading read_with(std::string_view text, const Read& read) {
  Reading made;
  const auto [end, error] = read(text.data(), text.data() + text.size(), made.value);
  made.error = error;
  made.length = end - text.data();
  return made;
}

}  // namespace

TEST_CASE("reals are read as std::from_chars() reads them, also where they are out of range") {
  for (const std::string_view text :
       {"1",     "-0.5",     ".5",     "1.",     "1e5x",    "1E-5",   "1e",       "0x1p3",
        "1e999", "-1e999",   "1e-999", "0e-999", "0.000e5", "2e-324", "4.9e-324", "inf",
        "-inf",  "INFINITY", "+1",     " 1",     "-",       "",       "x"}) {
    CAPTURE(text);
    const auto by_hand = [](const char* first, const char* last, double& value) {
      return real_from_chars(first, last, value);
    };
    const auto by_standard = [](const char* first, const char* last, double& value) {
      return std::from_chars(first, last, value);
    };
    CHECK(read_with(text, by_hand) == read_with(text, by_standard));
  }
}

TEST_CASE("whole numbers are read as std::from_chars() reads them") {
  int value = 0;
  const std::string_view text = "-12,";
  CHECK(from_chars(text.data(), text.data() + text.size(), value).ptr == text.data() + 3);
  CHECK(value == -12);
}
