// SPDX-License-Identifier: MIT
#include "figure/drawing.h"

#include <doctest/doctest.h>

using namespace tetmend::figure;

TEST_CASE("words are as wide as Helvetica makes them") {
  // By Adobe's metrics: H 722, e 556, l 222, o 556.
  CHECK(text_width("Hello", 10) == doctest::Approx(22.78));
  CHECK(text_width("Hello", 10, Font::oblique) == text_width("Hello", 10));
  CHECK(text_width("Hello", 10, Font::bold) == doctest::Approx(24.45));  // 722 556 278 278 611
  CHECK(text_width("", 10) == 0);
  CHECK(text_width("0123456789", 8) == doctest::Approx(8 * 5.56));
}

TEST_CASE("each letter beyond ASCII is shown as one question mark") {
  CHECK(printable("na\xC3\xAFve \xE2\x86\x92\t~") == "na?ve ??~");
  CHECK(text_width("\xC3\xA4", 10) == text_width("?", 10));
}

TEST_CASE("the box of a text lies where its anchor says") {
  Text text{{100, 50}, "aa", 10};
  CHECK(box_of(text).left == 100);
  CHECK(box_of(text).right == doctest::Approx(111.12));
  text.anchor = Anchor::middle;
  CHECK(box_of(text).left == doctest::Approx(94.44));
  text.anchor = Anchor::end;
  CHECK(box_of(text).right == 100);
  CHECK(box_of(text).top < 50);
  CHECK(box_of(text).bottom > 50);
}

TEST_CASE("lines break at blanks, and words stay whole") {
  const auto lines = wrap("one two threethreethree four", 40, 10);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] == "one two");
  CHECK(lines[1] == "threethreethree");
  CHECK(lines[2] == "four");
  for (const auto& line : wrap("a b c d e f g h i j k l m n o p", 30, 8)) {
    CHECK(text_width(line, 8) <= 30);
  }
  CHECK(wrap("", 40, 10) == std::vector<std::string>{""});
}

TEST_CASE("ticks are round numbers in the range") {
  CHECK(ticks(0, 10, 5) == std::vector<double>{0, 2, 4, 6, 8, 10});
  CHECK(ticks(3622, 3641, 4) == std::vector<double>{3625, 3630, 3635, 3640});
  const auto small = ticks(0, 0.7, 7);
  CHECK(small.size() == 8);
  CHECK(small.front() == 0);
  CHECK(tick_text(small[3]) == "0.3");
  CHECK(tick_text(20000) == "20000");
  CHECK(tick_text(0.25) == "0.25");
}
