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
  CHECK(draw_overlay(s.document, {}).shapes.empty());
  s.document.view.title = "A cube";
  CHECK(words_of(draw_overlay(s.document, {})) == std::vector<std::string>{"A cube"});
}

TEST_CASE("a colour bar has the name of the measure, and numbers at their places") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.run("colour", {"quality"});
  s.run("colour_bar");
  const figure::Drawing drawing = draw_overlay(s.document, {});
  const auto words = words_of(drawing);
  CHECK(has(words, "quality"));
  for (const char* number : {"0", "0.5", "1", "1.5", "2"}) CHECK(has(words, number));
  // The colours from the top down are those of the map from its best end on.
  const ColourMap& map = find_colour_map(s.document.view.scene.map);
  const auto first =
      std::find_if(drawing.shapes.begin(), drawing.shapes.end(),
                   [](const auto& shape) { return std::holds_alternative<figure::Area>(shape); });
  REQUIRE(first != drawing.shapes.end());
  CHECK(std::get<figure::Area>(*first).fill == map.at(1 - 0.5 / 128));
  s.run("colour", {"min_angle"});
  CHECK(has(words_of(draw_overlay(s.document, {})), "min angle, degrees"));
  s.run("colour", {"region"});
  CHECK(has(words_of(draw_overlay(s.document, {})),
            fmt::format("region {}", s.document.regions().front())));
}

TEST_CASE("all words of a colour bar stand on a ground where the mesh can be behind them") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.run("colour", {"quality"});
  s.run("colour_bar");
  const auto on_nothing = [&] {
    const figure::Drawing drawing = draw_overlay(s.document, {});
    std::size_t count = 0;
    for (const figure::Shape& shape : drawing.shapes) {
      const auto* text = std::get_if<figure::Text>(&shape);
      if (text == nullptr) continue;
      const auto holds = [&](const figure::Shape& other) {
        const auto* area = std::get_if<figure::Area>(&other);
        if (area == nullptr) return false;
        const auto [low, high] = std::minmax_element(
            area->corners.begin(), area->corners.end(),
            [](const figure::Place& p, const figure::Place& q) { return p.x < q.x; });
        const figure::Box box = box_of(*text);
        return low->x <= box.left && high->x >= box.right;
      };
      if (std::none_of(drawing.shapes.begin(), drawing.shapes.end(), holds)) ++count;
    }
    return count;
  };
  s.document.view.background = Background::gradient;
  CHECK(on_nothing() == 0);
  s.document.view.background = Background::white;  // for papers
  CHECK(on_nothing() > 0);
}

TEST_CASE("a scale bar is as long as it says") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.document.view.camera.orthographic = true;
  s.run("scale_bar");
  const figure::Drawing drawing = draw_overlay(s.document, {});
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

TEST_CASE("the words of a short scale bar begin in the picture") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.document.resize({260, 200});
  s.run("scale_bar");
  const figure::Drawing drawing = draw_overlay(s.document, {.scale = 1.5});
  const auto found = std::find_if(
      drawing.shapes.begin(), drawing.shapes.end(),
      [](const figure::Shape& shape) { return std::holds_alternative<figure::Text>(shape); });
  REQUIRE(found != drawing.shapes.end());
  CHECK(box_of(std::get<figure::Text>(*found)).left >= 0);
}

TEST_CASE("the colour bar names no red where tets have the colours of a measure, and none is red") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.run("colour", {"quality"});
  s.run("colour_bar");
  s.document.view.scene.bad_below = 2;
  REQUIRE(s.document.scene().bad_shown == 0);
  for (const figure::Shape& shape : draw_overlay(s.document, {}).shapes) {
    const auto* text = std::get_if<figure::Text>(&shape);
    CHECK((text == nullptr || text->text != "bad"));
  }
}

TEST_CASE("a small picture has no axes: legend and names have the room") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  const auto has_axes = [&](const Canvas& size) {
    s.document.resize(size);
    OverlayLook look;
    look.scale = 1.5;
    look.has_triad = true;
    return !draw_overlay(s.document, look).shapes.empty();
  };
  CHECK(has_axes({512, 470}));
  CHECK_FALSE(has_axes({320, 234}));
}

TEST_CASE("the axes stand at the lower right, and opposite to a colour bar over the scale bar") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  const auto place_of_x = [&] {
    const figure::Drawing drawing = draw_overlay(s.document, {.has_triad = true});
    for (const figure::Shape& shape : drawing.shapes) {
      const auto* text = std::get_if<figure::Text>(&shape);
      if (text != nullptr && text->text == "x") return text->at;
    }
    FAIL("no axes");
    return figure::Place{};
  };
  const double middle = s.document.canvas.width / 2.0;
  const figure::Place alone = place_of_x();
  CHECK(alone.x > middle);
  s.run("scale_bar");
  CHECK(place_of_x().y == alone.y);
  s.run("colour", {"quality"});
  s.run("colour_bar");
  CHECK(place_of_x().x < middle);
  CHECK(place_of_x().y < alone.y);
}

TEST_CASE("twice the scale makes words twice as large, at twice the distance from the border") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.document.view.title = "t";
  const auto one = std::get<figure::Text>(draw_overlay(s.document, {}).shapes[0]);
  s.document.resize({800, 600});
  const auto two = std::get<figure::Text>(draw_overlay(s.document, {.scale = 2}).shapes[0]);
  CHECK(two.size == 2 * one.size);
  CHECK(two.at.x == 2 * one.at.x);
  CHECK(two.at.y == doctest::Approx(2 * one.at.y));
}

TEST_CASE("numbers stand at the vertices that are seen, and at no hidden one") {
  TestSession s(test::kuhn_cube(2, 0, 1));  // 27 vertices: 19 on the three faces in front
  s.document.go_home();
  const auto seen = seen_vertices(s.document, 100);
  CHECK(seen.size() == 19);
  for (const VertexHandle v : seen) {
    const Point& p = s.document.mesh().point(v);
    CHECK((p.x() == 1 || p.y() == 0 || p.z() == 1));  // from the right, in front, above
  }
  CHECK(seen_vertices(s.document, 5).size() == 5);
  CHECK(draw_overlay(s.document, {}).shapes.empty());
  s.run("all_numbers");
  const auto words = words_of(draw_overlay(s.document, {.text_size = 6}));
  CHECK(words.size() == 19);
  for (const VertexHandle v : seen) CHECK(has(words, fmt::format("{}", v.index())));
  // Large ones find room for some only, and none covers another.
  const figure::Drawing large = draw_overlay(s.document, {.text_size = 40});
  std::vector<figure::Box> boxes;
  for (const figure::Shape& shape : large.shapes) {
    if (const auto* text = std::get_if<figure::Text>(&shape)) boxes.push_back(box_of(*text));
  }
  CHECK(boxes.size() > 2);
  CHECK(boxes.size() < 19);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK(!boxes[i].overlaps(boxes[j]));
  }
}

TEST_CASE("names of a shell find another side of their vertices where one covers the next") {
  TestSession s(test::shell_mesh({.degree = 5}));
  s.run("select_edge", {0, 1});
  s.document.view.camera.orthographic = true;
  s.run("from_top");  // along the edge: a and b are at the same pixel
  const figure::Drawing drawing = draw_overlay(s.document, {.text_size = 8});
  const auto words = words_of(drawing);
  for (const char* role : {"a ", "b ", "p1 ", "p2 ", "p3 ", "p4 ", "p5 "}) CHECK(has(words, role));
  std::vector<figure::Box> boxes;
  for (const figure::Shape& shape : drawing.shapes) {
    if (const auto* text = std::get_if<figure::Text>(&shape)) boxes.push_back(box_of(*text));
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(boxes[i].overlaps(boxes[j]));
  }
}

TEST_CASE("the shell of a selected edge has its names, and what is pointed at is drawn over it") {
  TestSession s(test::shell_mesh({.degree = 5}));
  s.run("select_edge", {0, 1});
  const auto words = words_of(draw_overlay(s.document, {.text_size = 4}));
  for (const char* role : {"a ", "b ", "p1 ", "p5 "}) CHECK(has(words, role));
  const std::size_t shapes = draw_overlay(s.document, {.text_size = 4}).shapes.size();
  s.document.point_at({{VertexHandle(0), VertexHandle(1)}});
  const figure::Drawing lit = draw_overlay(s.document, {.text_size = 4});
  REQUIRE(lit.shapes.size() == shapes + 3);  // a line and two circles
  const auto* line = std::get_if<figure::Stroke>(&lit.shapes[1]);
  REQUIRE(line != nullptr);
  CHECK(line->pen.colour == figure::kPointedColour);
}

TEST_CASE("the legend of a call is small in a small picture, and lies on no vertex of the call") {
  Document document;
  document.open(TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace");
  document.show_panels = true;
  OverlayLook look;
  look.text_size = 16;
  look.text_width = [](const std::string& text, double size) {
    return 0.55 * size * static_cast<double>(text.size());
  };
  std::size_t legends = 0, moved = 0;
  for (const Canvas size : {Canvas{1200, 900}, Canvas{500, 400}, Canvas{400, 320}}) {
    document.resize(size);
    for (std::uint64_t position = 1; position <= document.debugger()->end(); ++position) {
      document.debugger()->seek(position);
      document.show_trace();
      document.scene();
      const bool is_below = size.width == 400;  // the call lies where the legend is as a rule
      Camera& camera = document.view.camera;
      const Camera before = camera;
      if (is_below) {
        camera.target += 0.2 * camera.height_at_target() * (camera.up() + camera.right());
      }
      const auto& entries = document.legend();
      if (entries.empty()) continue;
      ++legends;
      const figure::Drawing drawing = draw_overlay(document, look);
      figure::Box box{1e9, -1e9, 1e9, -1e9};
      for (const figure::Shape& shape : drawing.shapes) {
        const auto* text = std::get_if<figure::Text>(&shape);
        if (text == nullptr || std::none_of(entries.begin(), entries.end(), [&](const auto& entry) {
              return entry.text == text->text;
            })) {
          continue;
        }
        const double width = look.text_width(text->text, text->size);
        box.left = std::min(box.left, text->at.x - 1.8 * text->size);
        box.right = std::max(box.right, text->at.x + width);
        box.top = std::min(box.top, text->at.y - text->size);
        box.bottom = std::max(box.bottom, text->at.y);
      }
      CAPTURE(position);
      CHECK(box.left >= 0);
      CHECK(box.top >= 0);
      CHECK(box.right <= size.width);
      CHECK(box.bottom <= size.height);
      CHECK(box.bottom - box.top <= 0.5 * size.height);
      moved += box.left > 0.3 * size.width || box.bottom < 0.6 * size.height ? 1 : 0;
      // On none where there is room, and never on more than at its usual place.
      std::size_t covered = 0, usual = 0;
      for (const NamedVertex& name : document.names()) {
        const auto at = document.view.camera.project(to_glm(document.mesh().point(name.vertex)),
                                                     document.canvas);
        if (!at) continue;
        const bool is_across = at->x > box.left && at->x < box.right;
        covered += is_across && at->y > box.top && at->y < box.bottom ? 1 : 0;
        usual +=
            at->x < box.right - box.left && at->y > size.height - (box.bottom - box.top) ? 1 : 0;
      }
      if (size.width >= 500) CHECK(covered == 0);
      CHECK(covered <= usual);
      camera = before;
    }
  }
  CHECK(legends > 20);
  CHECK(moved > 0);
}

TEST_CASE("no vertex of what is selected is without its number, however small the picture is") {
  TestSession s(test::kuhn_cube(4, 0.2, 1));
  const auto words_at = [&](double text) {
    const figure::Drawing drawing = draw_overlay(s.document, {.text_size = text});
    std::vector<figure::Box> boxes;
    for (const figure::Shape& shape : drawing.shapes) {
      if (const auto* word = std::get_if<figure::Text>(&shape)) boxes.push_back(box_of(*word));
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(boxes[i].overlaps(boxes[j]));
    }
    return words_of(drawing);
  };
  for (const std::uint32_t tet : {0U, 100U, 300U}) {
    s.run("select_tet", {tet});
    s.run("home");  // a tet of a few pixels
    for (const VertexHandle v : s.document.mesh().vertices(TetHandle(tet))) {
      CAPTURE(v.index());
      CHECK(has(words_at(12), fmt::format("{}", v.index())));
    }
  }
}

namespace {

std::vector<figure::Box> boxes_of_words(const figure::Drawing& drawing) {
  std::vector<figure::Box> boxes;
  for (const figure::Shape& shape : drawing.shapes) {
    if (const auto* text = std::get_if<figure::Text>(&shape)) boxes.push_back(box_of(*text));
  }
  return boxes;
}

}  // namespace

TEST_CASE("names of a shell of a few pixels stand apart, at the ends of lines, and none is lost") {
  TestSession s(test::shell_mesh({.degree = 14}));
  s.run("select_edge", {0, 1});
  s.document.view.camera.orthographic = true;
  s.run("from_top");
  const auto all_there = [](const figure::Drawing& drawing) {
    const auto words = words_of(drawing);
    for (int i = 1; i <= 14; ++i) {
      CAPTURE(i);
      CHECK(has(words, fmt::format("p{} ", i)));
    }
    CHECK((has(words, "a ") && has(words, "b ")));
  };
  s.document.resize({600, 450});
  s.document.view.camera.distance *= 12;  // the shell is smaller than a word
  const figure::Drawing drawing = draw_overlay(s.document, {.text_size = 12});
  all_there(drawing);
  const auto boxes = boxes_of_words(drawing);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(boxes[i].overlaps(boxes[j]));
    CHECK((boxes[i].left >= 0 && boxes[i].right <= 600));
    CHECK((boxes[i].top >= 0 && boxes[i].bottom <= 450));
  }
  // Where there is no room for so many, they lie on each other rather than nowhere.
  s.document.resize({160, 120});
  all_there(draw_overlay(s.document, {.text_size = 16}));
}

TEST_CASE("a name lies on no other vertex that has one, where there is room") {
  TestSession s(test::shell_mesh({.degree = 8}));
  s.document.resize({900, 700});
  s.run("select_edge", {0, 1});
  s.run("fit");
  for (const double zoom : {1.0, 2.5, 5.0}) {
    s.document.view.camera.distance *= zoom;
    const figure::Drawing drawing = draw_overlay(s.document, {.text_size = 14});
    const auto boxes = boxes_of_words(drawing);
    CHECK(boxes.size() == 2 * 10);
    for (const figure::Shape& shape : drawing.shapes) {
      const auto* dot = std::get_if<figure::Dot>(&shape);
      if (dot == nullptr) continue;
      for (const figure::Box& box : boxes) {
        const bool is_on = dot->middle.x > box.left && dot->middle.x < box.right &&
                           dot->middle.y > box.top && dot->middle.y < box.bottom;
        CHECK_FALSE(is_on);
      }
    }
  }
}

namespace {

/// Whether the axes' letters are clear of the legend at a call of a lesson.
void check_legend_beside_axes(const Canvas& size, bool has_bar, double scale) {
  Document document;
  document.open(TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace");
  document.show_panels = true;
  document.resize(size);
  document.debugger()->seek(8);
  document.show_trace();
  document.scene();
  document.view.colour_bar = has_bar;
  document.view.scene.colour = "quality";
  OverlayLook look;
  look.scale = scale;
  look.text_size *= scale;
  look.has_triad = true;
  const figure::Drawing drawing = draw_overlay(document, look);
  REQUIRE(!document.legend().empty());
  const auto place_of = [&](const std::string& word) {
    for (const figure::Shape& shape : drawing.shapes) {
      const auto* text = std::get_if<figure::Text>(&shape);
      if (text != nullptr && text->text == word) return box_of(*text);
    }
    FAIL("no " << word);
    return figure::Box{};
  };
  for (const char* axis : {"x", "y", "z"}) {
    for (const auto& entry : document.legend()) {
      figure::Box line = place_of(entry.text);
      line.left -= 30;  // with its colour
      CHECK_FALSE(line.overlaps(place_of(axis)));
    }
  }
}

}  // namespace

TEST_CASE("the legend keeps clear of the axes where a colour bar has taken their corner") {
  check_legend_beside_axes({700, 560}, true, 1);
}

TEST_CASE("names keep clear of the legend in a small picture of large text") {
  Document document;
  document.open(TETMEND_SOURCE_DIR "/assets/lessons/4-tables.trace");
  document.show_panels = true;
  document.resize({320, 234});
  document.debugger()->seek(2);
  document.show_trace();
  document.scene();
  OverlayLook look;
  look.scale = 1.5;
  look.text_size *= look.scale;
  std::vector<figure::Box> legend, names;
  for (const figure::Shape& shape : draw_overlay(document, look).shapes) {
    const auto* text = std::get_if<figure::Text>(&shape);
    if (text == nullptr) continue;
    const bool is_legend =
        std::any_of(document.legend().begin(), document.legend().end(),
                    [&](const LegendEntry& entry) { return entry.text == text->text; });
    (is_legend ? legend : names).push_back(box_of(*text));
  }
  REQUIRE(!legend.empty());
  REQUIRE(names.size() > 6);
  for (const figure::Box& line : legend) {
    for (const figure::Box& name : names) CHECK_FALSE(line.overlaps(name));
  }
}

TEST_CASE("the legend keeps clear of the axes in a small picture of large text") {
  check_legend_beside_axes({400, 370}, false, 1.5);
}
