// SPDX-License-Identifier: MIT
#include "report/svg.h"

#include <doctest/doctest.h>

using namespace tetmend::report;

TEST_CASE("a place has two decimals at most") {
  CHECK(coordinate(12) == "12");
  CHECK(coordinate(1.5) == "1.5");
  CHECK(coordinate(2.0 / 3) == "0.67");
  CHECK(coordinate(-0.001) == "0");
  CHECK(coordinate(100) == "100");
}

TEST_CASE("ticks are round numbers within the range") {
  using Ticks = std::vector<double>;
  CHECK(round_ticks(10, 5) == Ticks{0, 2, 4, 6, 8, 10});
  CHECK(round_ticks(0.9, 3) == Ticks{0, 0.5});
  CHECK(round_ticks(1234, 4) == Ticks{0, 500, 1000});
  CHECK(decade_ticks(123456, 4) == Ticks{1, 100, 10000});
  CHECK(decade_ticks(99, 4) == Ticks{1, 10});
  CHECK(decade_ticks(1, 4) == Ticks{1});
  CHECK(tick_text(0) == "0");
  CHECK(tick_text(1500) == "1.5k");
  CHECK(tick_text(2e6) == "2M");
}

TEST_CASE("a single one has a height on a logarithmic scale, and none has none") {
  CHECK(log_share(0, 1e6) == 0);
  CHECK(log_share(1, 1e6) > 0.04);
  CHECK(log_share(1e6, 1e6) == doctest::Approx(1));
  CHECK(log_share(0, 0) == 0);
}

TEST_CASE("texts are escaped") {
  const std::string text = text_at(1, 2, "start", "tick", "<&>");
  CHECK(text == R"(<text x="1" y="2" text-anchor="start" class="tick">&lt;&amp;&gt;</text>)");
  CHECK(drawing(1, 2, "a", "\"", "").find("aria-label=\"&quot;\"") != std::string::npos);
}
