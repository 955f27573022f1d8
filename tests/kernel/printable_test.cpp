// SPDX-License-Identifier: MIT
// Text of strangers on a terminal.
#include "kernel/printable.h"

#include <string>
#include <string_view>

#include <doctest/doctest.h>

using namespace tetmend;
using namespace std::string_view_literals;

TEST_CASE("text that can be shown stays as it is") {
  for (const std::string_view text :
       {""sv, "smallest angle 12.5 \\ of 30"sv, "Güte ≥ 0.4 — 網 🙂"sv}) {
    CHECK(printable(text) == text);
  }
}

TEST_CASE("control characters are written out") {
  CHECK(printable("a\0b\x1b[31mred\n\tnew\x7f"sv) == "a\\x00b\\x1b[31mred\\n\\tnew\\x7f");
  CHECK(printable("\xc2\x9b"
                  "31m") == "\\xc2\\x9b31m");  // U+009B does what ESC [ does
}

TEST_CASE("bytes that are no UTF-8 are written out") {
  CHECK(printable("\xff") == "\\xff");
  CHECK(printable("a\xc3") == "a\\xc3");                           // cut off
  CHECK(printable("\xc0\x80") == "\\xc0\\x80");                    // overlong
  CHECK(printable("\xe0\x80\xaf") == "\\xe0\\x80\\xaf");           // overlong
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // half of a pair
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // behind the last
}

TEST_CASE("long text is cut, with dots") {
  CHECK(printable(std::string(50, 'x'), 10) == "xxxxxxxxxx...");
  CHECK(printable("xxxxxxxxxx", 10) == "xxxxxxxxxx");
}
