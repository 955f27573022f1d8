// SPDX-License-Identifier: MIT
#include "viewer/overlay.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/viewer/session.h"
#include "viewer/mesh/tet_values.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

std::vector<std::string> words_of(const figure::Drawing& drawing) {
  std::vector<std::string> words;
  for (const figure::Shape& shape : drawing.shapes) {
    if (const auto* text = std::get_if<figure::Text>(&shape)) words.push_back(text->text);
  }
  return words;
}

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

TEST_CASE("nothing lies over the mesh unless the view asks for it") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  CHECK(draw_overlay(s.document, 1).shapes.empty());
  s.document.view.title = "A cube";
  CHECK(words_of(draw_overlay(s.document, 1)) == std::vector<std::string>{"A cube"});
}

TEST_CASE("a colour bar has the name of the measure, and numbers at their places") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.run("colour", {"quality"});
  s.run("colour_bar");
  const figure::Drawing drawing = draw_overlay(s.document, 1);
  const auto words = words_of(drawing);
  CHECK(has(words, "quality"));
  for (const char* number : {"0", "0.5", "1", "1.5", "2"}) CHECK(has(words, number));
  // The colours from the top down are those of the map from its best end on.
  const ColourMap& map = find_colour_map(s.document.view.scene.map);
  const auto* first = std::get_if<figure::Area>(&drawing.shapes[1]);
  REQUIRE(first != nullptr);
  CHECK(first->fill == map.at(1 - 0.5 / 128));
  s.run("colour", {"region"});
  CHECK(has(words_of(draw_overlay(s.document, 1)),
            fmt::format("region {}", s.document.regions().front())));
}

TEST_CASE("a scale bar is as long as it says") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.document.view.camera.orthographic = true;
  s.run("scale_bar");
  const figure::Drawing drawing = draw_overlay(s.document, 1);
  const auto words = words_of(drawing);
  REQUIRE(words.size() == 1);
  const double length = std::stod(words[0]);
  const auto* bar = std::get_if<figure::Stroke>(&drawing.shapes[0]);
  REQUIRE(bar != nullptr);
  const double pixels = bar->places[1].x - bar->places[0].x;
  // Two points that far from each other at the target, across the direction of sight.
  const Camera& camera = s.document.view.camera;
  const auto a = camera.project(camera.target, s.document.canvas);
  const auto b = camera.project(camera.target + length * camera.right(), s.document.canvas);
  REQUIRE((a && b));
  CHECK(glm::distance(*a, *b) == doctest::Approx(pixels));
  CHECK(pixels <= 0.22 * s.document.canvas.width);
  CHECK(pixels > 0.08 * s.document.canvas.width);
}

TEST_CASE("twice the scale makes words twice as large, at twice the distance from the border") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.document.view.title = "t";
  const auto one = std::get<figure::Text>(draw_overlay(s.document, 1).shapes[0]);
  s.document.resize({800, 600});
  const auto two = std::get<figure::Text>(draw_overlay(s.document, 2).shapes[0]);
  CHECK(two.size == 2 * one.size);
  CHECK(two.at.x == 2 * one.at.x);
  CHECK(two.at.y == doctest::Approx(2 * one.at.y));
}
