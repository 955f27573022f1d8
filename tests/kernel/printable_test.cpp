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
                  "31m") == "\\x9b31m");  // U+009B does what ESC [ does
}

TEST_CASE("bytes that are no UTF-8 are letters of Latin-1") {
  CHECK(printable("caf\xe9") == "café");
  CHECK(printable("\xff") == "ÿ");
  CHECK(printable("\x9b") == "\\x9b");                         // a control character
  CHECK(printable("a\xc3") == "aÃ");                           // cut off
  CHECK(printable("Güte \xfc") == "Güte ü");                   // both
  CHECK(printable("\xc0\x80") == "À\\x80");                    // overlong
  CHECK(printable("\xe0\x80\xaf") == "à\\x80¯");               // overlong
  CHECK(printable("\xed\xa0\x80") == "í\xc2\xa0\\x80");        // half of a pair
  CHECK(printable("\xf4\x90\x80\x80") == "ô\\x90\\x80\\x80");  // behind the last
}

TEST_CASE("marks of text direction, line separators and what is no character are written out") {
  CHECK(printable("\u202eevil\u2066") == "\\u202eevil\\u2066");
  CHECK(printable("a\u2028b\u2029") == "a\\u2028b\\u2029");
  CHECK(printable("\u200f\u061c") == "\\u200f\\u061c");
  CHECK(printable("\xef\xbf\xbe\xef\xbf\xbf") == "\\ufffe\\uffff");
  CHECK(printable("\U0001ffff\ufdd0") == "\\U0001ffff\\ufdd0");
  CHECK(printable("\ufffd") == "\ufffd");
}

TEST_CASE("in text of several lines breaks stay") {
  CHECK(printable_lines("one\n\ttwo\r\nthree\rfour\x1b") == "one\n\ttwo\r\nthree\\x0dfour\\x1b");
}

TEST_CASE("what is made printable stays so, and only that") {
  for (const std::string_view text : {"a\xe9"sv, "\u202e"sv, "\n"sv, "\0"sv, "\xef\xbf\xbe"sv}) {
    CAPTURE(printable(text));
    CHECK_FALSE(is_printable(text));
    CHECK(is_printable(printable(text)));
  }
  CHECK(is_printable("Güte ≥ 0.4 — 網 🙂"));
  CHECK(is_printable(""));
}

TEST_CASE("long text is cut, with dots") {
  CHECK(printable(std::string(50, 'x'), 10) == "xxxxxxxxxx...");
  CHECK(printable("xxxxxxxxxx", 10) == "xxxxxxxxxx");
}
