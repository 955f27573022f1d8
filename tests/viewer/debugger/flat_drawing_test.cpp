// SPDX-License-Identifier: MIT
#include "viewer/debugger/flat_drawing.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

const ColourMap& map() {
  return find_colour_map("ember");
}

std::size_t dashed(const FlatDrawing& drawing) {
  return static_cast<std::size_t>(std::count_if(drawing.strokes.begin(), drawing.strokes.end(),
                                                [](const auto& s) { return s.dashed; }));
}

bool has_number(const FlatDrawing& drawing, Quality quality) {
  return std::any_of(drawing.labels.begin(), drawing.labels.end(),
                     [&](const auto& l) { return l.text == fmt::format("{:.3f}", quality); });
}

EventKind kind_of_event(const TraceFile& file, std::uint64_t number) {
  EventCursor cursor(file);
  cursor.move_to(number);
  return cursor.next().kind;
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
    const std::size_t m = study.picture->ring.size();
    const FlatDrawing before = draw_polygon(study, call.events.begin + 1, false, map());
    const FlatDrawing after = draw_polygon(study, call.events.end, false, map());
    CHECK(before.areas.size() == m);
    CHECK(before.caption.starts_with("before"));
    const auto& made = *study.covering;
    CHECK(after.areas.size() == made.triangles.size() + made.core.size());
    CHECK(after.caption.starts_with("made"));
    const auto at = [&](std::uint64_t position) {
      return draw_polygon(study, position, false, map()).caption;
    };
    CHECK(at(study.first_edit) == after.caption);
    CHECK(at(study.first_edit - 1) == before.caption);
    CHECK(kind_of_event(file, study.first_edit - 1) == EventKind::replace_cavity);
    for (const auto& t : made.triangles) CHECK(has_number(after, t.quality));
    for (const auto& side : made.core) CHECK(has_number(after, side.quality));
    for (const auto& side : study.picture->before.core) CHECK(has_number(before, side.quality));
    for (const FlatDrawing* drawing : {&before, &after}) {
      for (const auto& label : drawing->labels) CHECK(glm::length(label.at) <= 1);
      for (std::size_t i = 0; i < drawing->labels.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          CHECK(glm::distance(drawing->labels[i].at, drawing->labels[j].at) > 0.05);
        }
      }
    }
  }
  CHECK(seen == 20);
}

TEST_CASE("after a refusal without a candidate the best complete triangulation is dashed") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 5}))};
  CallStudy study;
  study.picture = picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
  const FlatDrawing drawing = draw_polygon(study, 9, true, map());
  CHECK(drawing.areas.size() == 3);
  std::size_t no_better = 0;
  for (const Chord& chord : chords_of(*study.picture)) {
    if (chord.best()[0] <= study.picture->floor) ++no_better;
  }
  CHECK(dashed(drawing) == 3 * 3 + no_better);
  for (const auto& t : study.picture->full.triangles) CHECK(has_number(drawing, t.quality));
  CHECK(drawing.caption.starts_with("best complete"));
}

TEST_CASE("bad tets are drawn red, the nearer ones last, and only sides that face the camera") {
  LocalTet good{TetHandle(0), {}, {}, 1.8F};
  good.corners = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  LocalTet bad = good;
  bad.quality = 0.1F;
  for (auto& p : bad.corners) p.z() += 2;
  Camera camera;
  camera.look_from("+z");  // the bad one is nearer
  const Ball ball{{0, 0, 1}, 3};
  const auto drawing = draw_tets(std::vector{bad, good}, camera, ball, map(), 1);
  REQUIRE(drawing.areas.size() < 8);  // not all sides
  REQUIRE(drawing.areas.size() >= 2);
  const Colour& last = drawing.areas.back().colour;
  CHECK(last.red > 2 * last.green);
  CHECK(drawing.areas.front().colour.red <= 2 * drawing.areas.front().colour.green);
}

TEST_CASE("the ball around a call holds its tets") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  const CallStudy study = study_call(file, replay, 0);
  const auto ball = ball_around(study);
  REQUIRE(ball);
  for (const LocalTet& tet : study.before) {
    for (const Point& p : tet.corners) {
      CHECK(glm::distance(glm::dvec3(p.x(), p.y(), p.z()), ball->centre) <=
            ball->radius * 1.000001);
    }
  }
  CHECK_FALSE(ball_around(CallStudy()));
}
