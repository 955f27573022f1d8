// SPDX-License-Identifier: MIT
#include "viewer/debugger/tets_drawing.h"

#include <vector>

#include <doctest/doctest.h>

#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("bad tets are drawn red, the nearer ones last, and only sides that face the camera") {
  LocalTet good{TetHandle(0), {}, {}, 1.8F};
  good.corners = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  LocalTet bad = good;
  bad.quality = 0.1F;
  for (auto& p : bad.corners) p.z() += 2;
  Camera camera;
  camera.look_from("+z");  // the bad one is nearer
  const Ball ball{{0, 0, 1}, 3};
  const auto drawing =
      draw_tets(std::vector{bad, good}, camera, ball, {{50, 50}, 50}, find_colour_map("ember"), 1);
  const auto& shapes = drawing.drawing.shapes;
  REQUIRE(shapes.size() < 8);  // not all sides
  REQUIRE(shapes.size() >= 2);
  const Colour& last = std::get<figure::Area>(shapes.back()).fill;
  CHECK(last.red > 2 * last.green);
  const Colour& first = std::get<figure::Area>(shapes.front()).fill;
  CHECK(first.red <= 2 * first.green);
  for (const figure::Shape& shape : shapes) {
    for (const figure::Place& p : std::get<figure::Area>(shape).corners) {
      CHECK((p.x >= 0 && p.x <= 100 && p.y >= 0 && p.y <= 100));
    }
  }
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
