// SPDX-License-Identifier: MIT
#include "explain/figures/ring_drawing.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

constexpr double kHalf = 100;

LinkedDrawing drawn(const CallStudy& study, std::uint64_t position, bool refused) {
  RingLook look;
  look.half = kHalf;
  return draw_polygon(polygon_at(study, position, refused), look);
}

template <class Shape>
std::vector<Shape> all(const LinkedDrawing& drawing) {
  std::vector<Shape> found;
  for (const figure::Shape& shape : drawing.drawing.shapes) {
    if (const auto* one = std::get_if<Shape>(&shape)) found.push_back(*one);
  }
  return found;
}

std::size_t dashed(const LinkedDrawing& drawing) {
  const auto strokes = all<figure::Stroke>(drawing);
  return static_cast<std::size_t>(
      std::count_if(strokes.begin(), strokes.end(), [](const auto& s) { return s.pen.dashed; }));
}

bool has_number(const LinkedDrawing& drawing, Quality quality) {
  const auto texts = all<figure::Text>(drawing);
  return std::any_of(texts.begin(), texts.end(),
                     [&](const auto& t) { return t.text == fmt::format("{:.3f}", quality); });
}

EventKind kind_of_event(const TraceFile& file, std::uint64_t number) {
  EventCursor cursor(file);
  cursor.move_to(number);
  return cursor.next().kind;
}

/// No two words lie on each other, and all lie in the square.
void check_words_in_square(const LinkedDrawing& drawing) {
  std::vector<figure::Box> boxes;
  for (const figure::Text& text : all<figure::Text>(drawing)) {
    const figure::Box box = figure::box_of(text);
    CHECK((box.left > -1.1 * kHalf && box.right < 1.1 * kHalf));
    CHECK((box.top > -1.1 * kHalf && box.bottom < 1.1 * kHalf));
    for (const figure::Box& other : boxes) CHECK(!box.overlaps(other));
    boxes.push_back(box);
  }
}

}  // namespace

TEST_CASE("the polygon has the old tets before the edit and the new covering after it") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  unsigned seen = 0;
  for (std::uint32_t k = 0; k < file.calls().size() && seen < 20; ++k) {
    const Call& call = file.calls()[k];
    if (!call.accepted() || call.algorithm != Algorithm::shell_transformation) continue;
    ++seen;
    const CallStudy study = study_call(file, replay, k);
    const LinkedDrawing before = drawn(study, call.events.begin + 1, false);
    const LinkedDrawing after = drawn(study, call.events.end, false);
    CHECK(before.meanings.size() == before.drawing.shapes.size());
    CHECK(all<figure::Area>(before).size() == study.picture->ring.size());
    const auto& made = *study.covering;
    CHECK(all<figure::Area>(after).size() == made.triangles.size() + made.core.size());
    const auto stage_at = [&](std::uint64_t position) {
      return polygon_at(study, position, false).stage;
    };
    CHECK(stage_at(study.first_edit) == PolygonStage::made);
    REQUIRE(study.found);
    CHECK(kind_of_event(file, *study.found - 1) == EventKind::candidate_found);
    CHECK(stage_at(*study.found - 1) == PolygonStage::before);
    CHECK(stage_at(study.first_edit - 1) == PolygonStage::found);
    const LinkedDrawing planned = drawn(study, *study.found, false);
    CHECK(dashed(planned) == 3 * made.triangles.size());
    CHECK(dashed(after) == 0);
    for (const auto& t : made.triangles) CHECK(has_number(planned, t.quality));
    CHECK(kind_of_event(file, study.first_edit - 1) == EventKind::replace_cavity);
    for (const auto& t : made.triangles) CHECK(has_number(after, t.quality));
    for (const auto& side : made.core) CHECK(has_number(after, side.quality));
    for (const auto& side : study.picture->before.core) CHECK(has_number(before, side.quality));
    check_words_in_square(before);
    check_words_in_square(after);
  }
  CHECK(seen == 20);
}

TEST_CASE("after a refusal without a candidate the best complete triangulation is dashed") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  CallStudy study;
  study.picture = picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
  const LinkedDrawing drawing = drawn(study, 9, true);
  CHECK(all<figure::Area>(drawing).size() == 3);
  std::size_t no_better = 0;
  for (const Chord& chord : chords_of(*study.picture)) {
    if (chord.best()[0] <= study.picture->floor) ++no_better;
  }
  CHECK(dashed(drawing) == 3 * 3 + no_better);
  for (const auto& t : study.picture->full.triangles) CHECK(has_number(drawing, t.quality));
}

TEST_CASE("each corner has its number, and below it its place in the ring") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  CallStudy study;
  study.picture = picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
  const auto& ring = study.picture->ring;
  const LinkedDrawing drawing = drawn(study, 0, false);
  check_words_in_square(drawing);
  std::vector<std::vector<figure::Text>> texts(ring.size());  // of each corner
  for (std::size_t n = 0; n < drawing.meanings.size(); ++n) {
    const auto* text = std::get_if<figure::Text>(&drawing.drawing.shapes[n]);
    if (text == nullptr || drawing.meanings[n].vertices.size() != 1) continue;
    const auto corner = std::find(ring.begin(), ring.end(), drawing.meanings[n].vertices[0]);
    REQUIRE(corner != ring.end());
    texts[static_cast<std::size_t>(corner - ring.begin())].push_back(*text);
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    REQUIRE(texts[i].size() == 3);
    CHECK(texts[i][0].text == fmt::format("{}", ring[i].index()));
    CHECK(texts[i][1].text == "p");
    CHECK(texts[i][2].text == fmt::format("{}", i + 1));
    CHECK(texts[i][1].at.y > texts[i][0].at.y);
  }
}

TEST_CASE("what lies under the mouse is told by its vertices: names, then lines, then areas") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  CallStudy study;
  study.picture = picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
  const ShellPicture& shell = *study.picture;
  const LinkedDrawing drawing = drawn(study, 0, false);
  const auto at = [&](double x, double y) {
    const Meaning* meaning = meaning_at(drawing, {x, y}, 8);
    return meaning == nullptr ? std::vector<VertexHandle>{} : meaning->vertices;
  };
  const Eigen::Vector2d first = 100 * shell.place(0);
  const Eigen::Vector2d second = 100 * shell.place(1);
  CHECK(at(0.89 * first.x(), -0.89 * first.y()) == std::vector{shell.ring[0]});
  const Eigen::Vector2d side = 0.76 * (first + second) / 2;
  CHECK(at(side.x(), -side.y()) == std::vector{shell.ring[0], shell.ring[1]});
  CHECK(at(0, 0) == std::vector{shell.a, shell.b});
  CHECK(at(99, 99).empty());
  // Beside the lines, where no chord passes: a slice stands for its tet.
  const Eigen::Vector2d slice = 0.9 * side;
  const auto tet = at(slice.x(), -slice.y());
  REQUIRE(tet.size() == 4);
  for (const VertexHandle v : {shell.a, shell.b, shell.ring[0], shell.ring[1]}) {
    CHECK(std::count(tet.begin(), tet.end(), v) == 1);
  }
}

TEST_CASE("the cell of the tables that was filled last is a chord with its triangle") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  CallStudy study;
  study.picture = picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
  RingLook look;
  look.half = kHalf;
  PolygonView view = polygon_at(study, 0, false);
  const std::size_t areas = all<figure::Area>(draw_polygon(view, look)).size();
  view.cell = cells_of(study.picture->tables).front();
  REQUIRE(study.picture->tables.k(view.cell->i, view.cell->j) < 5);
  const LinkedDrawing drawing = draw_polygon(view, look);
  CHECK(all<figure::Area>(drawing).size() == areas + 1);
  const auto strokes = all<figure::Stroke>(drawing);
  CHECK(std::count_if(strokes.begin(), strokes.end(), [](const figure::Stroke& stroke) {
          return stroke.pen.colour == figure::kCellColour;
        }) == 3);
}

TEST_CASE("names of many corners stand apart, on several circles with lines to them if need be") {
  for (const unsigned degree : {5U, 9U, 14U, 19U, 26U, 31U}) {
    CAPTURE(degree);
    const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = degree}))};
    CallStudy study;
    study.picture = picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
    REQUIRE(study.picture->ring.size() == degree);
    RingLook look;
    look.half = kHalf;
    look.name_size = 15;  // as the window has it
    look.number_size = 0.1;
    const LinkedDrawing drawing = draw_polygon(polygon_at(study, 0, false), look);
    std::vector<figure::Box> boxes;
    for (std::size_t n = 0; n < drawing.meanings.size(); ++n) {
      const auto* text = std::get_if<figure::Text>(&drawing.drawing.shapes[n]);
      if (text == nullptr || drawing.meanings[n].vertices.size() != 1) continue;
      boxes.push_back(figure::box_of(*text));
    }
    CHECK(boxes.size() == 3 * degree);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool is_same_name = i / 3 == j / 3;
        if (!is_same_name) CHECK_FALSE(boxes[i].overlaps(boxes[j]));
      }
      CHECK((boxes[i].left > -1.05 * kHalf && boxes[i].right < 1.05 * kHalf));
    }
  }
}
