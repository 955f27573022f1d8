// SPDX-License-Identifier: MIT
#include "explain/outcome_look.h"

#include <algorithm>
#include <array>
#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;
using namespace tetmend::explain;

namespace {

std::vector<Outcome> all_outcomes() {
  std::vector<Outcome> all;
  for (std::size_t i = 0; i < kOutcomeCount; ++i) all.push_back(static_cast<Outcome>(i));
  return all;
}

}  // namespace

TEST_CASE("each way to end has a colour and a name of its own") {
  std::vector<figure::Colour> seen;
  std::vector<std::string_view> names;
  for (const Outcome outcome : all_outcomes()) {
    const figure::Colour colour = outcome_colour(outcome);
    CHECK(std::find(seen.begin(), seen.end(), colour) == seen.end());
    seen.push_back(colour);
    CHECK(std::find(names.begin(), names.end(), outcome_name(outcome)) == names.end());
    names.push_back(outcome_name(outcome));
  }
}

TEST_CASE("each way to end has a mark of its own, which lies in its square") {
  std::vector<std::vector<std::vector<figure::Place>>> seen;
  for (const Outcome outcome : all_outcomes()) {
    const auto lines = outcome_mark(outcome);
    REQUIRE(!lines.empty());
    seen.emplace_back(lines.begin(), lines.end());
    CHECK(std::count(seen.begin(), seen.end(), seen.back()) == 1);
    for (const auto& line : lines) {
      REQUIRE(line.size() >= 2);
      for (const figure::Place& at : line) {
        CHECK(std::min(at.x, at.y) >= 0.08);
        CHECK(std::max(at.x, at.y) <= 0.92);
      }
    }
  }
}

TEST_CASE("hatching stays on its bar") {
  figure::Drawing drawing;
  add_hatching(drawing, {10, 20}, 31, 9);
  REQUIRE(drawing.shapes.size() > 3);
  for (const figure::Shape& shape : drawing.shapes) {
    for (const figure::Place& at : std::get<figure::Stroke>(shape).places) {
      CHECK(at.x >= 10);
      CHECK(at.x <= 41);
      CHECK(at.y >= 20 - 1e-9);
      CHECK(at.y <= 29 + 1e-9);
    }
  }
}

TEST_CASE("a bar of many calls has as much of each colour as ended so") {
  std::array<std::uint32_t, kOutcomeCount> ended{};
  ended[static_cast<std::size_t>(Outcome::undone)] = 3;
  ended[static_cast<std::size_t>(Outcome::limit)] = 1;
  figure::Drawing drawing;
  add_shares(drawing, ended, {5, 10}, 4, 20);
  REQUIRE(drawing.shapes.size() == 2);
  std::vector<double> heights;
  for (const figure::Shape& shape : drawing.shapes) {
    const auto& corners = std::get<figure::Area>(shape).corners;
    const auto [low, high] = std::minmax_element(
        corners.begin(), corners.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    heights.push_back(high->y - low->y);
  }
  CHECK(heights[0] == doctest::Approx(15));
  CHECK(heights[1] == doctest::Approx(5));
  CHECK(std::get<figure::Area>(drawing.shapes[0]).fill == outcome_colour(Outcome::undone));
}
