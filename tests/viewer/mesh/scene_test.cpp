// SPDX-License-Identifier: MIT
#include "viewer/mesh/scene.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

double area(const std::vector<SurfaceVertex>& triangles) {
  double sum = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const glm::dvec3 a(triangles[i].position);
    sum += glm::length(glm::cross(glm::dvec3(triangles[i + 1].position) - a,
                                  glm::dvec3(triangles[i + 2].position) - a)) /
           2;
  }
  return sum;
}

/// Of what a closed surface encloses.
double volume_under(const Scene& scene) {
  double sum = 0;
  for (std::size_t i = 0; i < scene.surface.size(); i += 3) {
    const glm::dvec3 a(scene.surface[i].position);
    const glm::dvec3 b(scene.surface[i + 1].position);
    sum += glm::dot(a, glm::cross(b, glm::dvec3(scene.surface[i + 2].position))) / 6;
  }
  return sum;
}

bool has_colour(const std::vector<SurfaceVertex>& triangles, const Colour& c) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const SurfaceVertex& v) {
    return v.colour.red == c.red && v.colour.green == c.green && v.colour.blue == c.blue;
  });
}

}  // namespace

TEST_CASE("of a whole mesh only the boundary is drawn") {
  TestSession s(test::kuhn_cube(4, 0, 1));
  const Scene& scene = s.document.scene();
  CHECK(scene.tets_shown == 6 * 64);
  CHECK(scene.surface.size() / 3 == 6 * 2 * 16);
  CHECK(scene.surface_tets.size() == scene.surface.size() / 3);
  CHECK(area(scene.surface) == doctest::Approx(6));
}

TEST_CASE("whole-tet cuts and exact cuts leave half a cube; the exact one is flat") {
  TestSession s(test::kuhn_cube(4, 0, 1));
  s.run("cut", {1});
  CHECK(s.document.scene().tets_shown == 6 * 32);
  CHECK(area(s.document.scene().surface) == doctest::Approx(4));
  // Between layers of cells: whole tets stick out, the exact cut goes through them.
  s.run("cut", {1, {{"position", 0.1}}});
  CHECK(area(s.document.scene().surface) > 4.5);
  s.run("cut", {1, {{"exact", true}}});
  const double depth = 0.5 + 0.1 * std::sqrt(0.75);
  CHECK(area(s.document.scene().surface) == doctest::Approx(2 + 4 * depth));
}

TEST_CASE("three exact cuts through the middle leave an eighth") {
  TestSession s(test::kuhn_cube(3, 0, 1));
  for (const int i : {1, 2, 3}) s.run("cut", {i, {{"exact", true}}});
  CHECK(area(s.document.scene().surface) == doctest::Approx(6 * 0.25));
}

TEST_CASE("a filter shows the tets of a range, or those outside of it") {
  TestSession s(test::delaunay_ball(200, 3));
  const std::size_t all = s.document.scene().tets_shown;
  s.run("colour", {"min_sine"});
  s.run("filter", {0, 0.4999999});
  const std::size_t inside = s.document.scene().tets_shown;
  s.document.view.scene.outside = true;
  CHECK(s.document.scene().tets_shown + inside == all);
  CHECK(inside == static_cast<std::size_t>(state_of(s.document)["bad"]));
}

TEST_CASE("peeling takes layers of tets away") {
  TestSession s(test::kuhn_cube(6, 0, 1));
  std::size_t last = s.document.scene().tets_shown;
  for (int layer = 1; layer <= 3; ++layer) {
    s.run("peel_more");
    CHECK(s.document.scene().tets_shown < last);
    last = s.document.scene().tets_shown;
  }
  s.run("show_all");
  CHECK(s.document.scene().tets_shown == 6 * 216);
}

TEST_CASE("a hidden region is not shown, and its neighbour gets a new face") {
  TestSession s(test::two_regions());
  s.run("view", {{{"hidden_regions", {2}}}});
  CHECK(s.document.scene().tets_shown == 24);
  CHECK(area(s.document.scene().surface) == doctest::Approx(2 + 4 * 0.5));
}

TEST_CASE("shrinking draws all four faces of each tet, smaller") {
  TestSession s(test::two_tets());
  const double whole = area(s.document.scene().surface);
  s.run("shrink", {0.5});
  CHECK(s.document.scene().surface.size() / 3 == 8);
  CHECK(area(s.document.scene().surface) < 0.5 * whole);
}

TEST_CASE("bad tets are red and seen through the rest, unless that is off or they are hidden") {
  TestSession s(test::middle_tet(0.05));
  const auto bad = static_cast<std::size_t>(state_of(s.document)["bad"]);
  REQUIRE(bad > 0);
  CHECK(s.document.scene().bad_shown == bad);
  CHECK(has_colour(s.document.scene().through, kBadColour));
  s.run("view", {{{"bad_below", -1}}});
  CHECK(s.document.scene().bad_shown == 0);
  s.run("view", {{{"bad_below", 1}}});
  s.run("bad");
  CHECK(s.document.scene().through.empty());
  CHECK_FALSE(has_colour(s.document.scene().surface, kBadColour));
}

TEST_CASE(
    "asked for, bad tets are seen where a cut or peeling hides them, not where a filter does") {
  for (const bool exact : {false, true}) {
    CAPTURE(exact);
    TestSession s(test::delaunay_ball(300, 3));
    s.run("bad_beyond_cuts");
    const auto bad = static_cast<std::size_t>(state_of(s.document)["bad"]);
    REQUIRE(s.document.scene().bad_shown == bad);
    const auto triangles = s.document.scene().through.size();
    const double whole = volume_under(s.document.scene());
    s.run("cut", {1, {{"exact", exact}, {"position", -0.5}}});
    CHECK(volume_under(s.document.scene()) < 0.5 * whole);
    CHECK(s.document.scene().bad_shown == bad);
    CHECK(s.document.scene().through.size() == triangles);
    s.run("show_all");
    s.run("peel", {1});
    CHECK(s.document.scene().bad_shown == bad);
    s.run("filter", {1, 2});
    CHECK(s.document.scene().bad_shown == 0);
  }
}

TEST_CASE("no red spoils the colours of a measure") {
  TestSession s(test::middle_tet(0.05));
  REQUIRE(s.document.scene().bad_shown > 0);
  s.run("colour", {"quality"});
  CHECK(s.document.scene().through.empty());
  s.run("colour", {"region"});
  CHECK(s.document.scene().bad_shown > 0);
}

TEST_CASE("bad tets beyond a cut are left out unless they are asked for") {
  TestSession s(test::delaunay_ball(200, 2));
  s.run("cut", {1, {{"exact", true}}});
  s.run("bad_beyond_cuts");
  const std::size_t all = s.document.scene().bad_shown;
  s.run("bad_beyond_cuts");
  const std::size_t left = s.document.scene().bad_shown;
  CHECK(left < all);
  CHECK(left > 0);
  s.run("cut", {1, {{"exact", false}}});
  CHECK(s.document.scene().bad_shown < all);
}

TEST_CASE("what exact cuts take away is not counted as shown") {
  TestSession s(test::kuhn_cube(4, 0, 1));
  CHECK(s.document.scene().tets_shown == 384);
  s.run("cut", {1, {{"exact", true}}});
  CHECK(s.document.scene().tets_shown == 192);
  s.run("cut", {2, {{"exact", true}}});
  s.run("cut", {3, {{"exact", true}}});
  CHECK(s.document.scene().tets_shown == 48);
  // A slanted plane cuts through tets: these are shown.
  s.run("show_all");
  s.run("cut", {1, {{"exact", true}, {"normal", {1, 0.3, 0.2}}, {"position", 0.1}}});
  const std::size_t shown = s.document.scene().tets_shown;
  CHECK(shown > 192);
  CHECK(shown < 384);
}

TEST_CASE("constraint faces inside the volume are drawn from both sides") {
  TestSession s(test::constrained_face());
  s.run("bad");
  s.run("constraints");
  CHECK(s.document.scene().through.size() == 2 * 3);
  CHECK(has_colour(s.document.scene().through, kConstraintColour));
}

TEST_CASE("ghosts are the boundary of what is hidden") {
  TestSession s(test::kuhn_cube(4, 0, 1));
  s.run("ghosts", {0.2});
  CHECK(s.document.scene().ghosts.empty());
  s.run("cut", {1});
  CHECK(area(s.document.scene().ghosts) == doctest::Approx(1 + 4 * 0.5));
}

TEST_CASE(
    "what a filter, a hidden region or isolation leaves has the mesh as an outline around it") {
  TestSession s(test::two_regions());
  REQUIRE(s.document.outline() == nullptr);  // nothing is hidden so
  s.run("cut", {1});
  CHECK(s.document.outline() == nullptr);  // a cut shows what it leaves
  s.run("show_all");
  const auto is_whole = [&] {
    const Scene* outline = s.document.outline();
    return outline != nullptr && std::abs(area(outline->surface) - 6) < 1e-9 &&
           outline->through.empty();
  };
  s.run("filter", {2, 3});  // no tet at all
  CHECK(s.document.scene().surface.empty());
  CHECK(is_whole());
  s.run("outline");
  CHECK(s.document.outline() == nullptr);
  s.run("outline");
  s.run("ghosts", {0.2});
  CHECK(s.document.outline() == nullptr);  // one of them is enough
  s.run("ghosts", {0});
  CHECK(is_whole());
  s.run("show_all");
  CHECK(s.document.outline() == nullptr);
  s.run("view", {{{"hidden_regions", {2}}}});
  CHECK(is_whole());
  s.run("show_all");
  s.run("worst");
  CHECK(s.document.scene().tets_shown == 1);
  CHECK(is_whole());
  s.run("deselect");
  CHECK(s.document.outline() == nullptr);
}

TEST_CASE("colours of a measure follow the map") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.run("colour", {"min_sine"});
  const Colour expected = find_colour_map("ember").at(0.7071 / 0.942809);
  CHECK(has_colour(s.document.scene().surface, expected));
}

TEST_CASE("only sides that are edges of the mesh are drawn as edges") {
  std::vector<SurfaceVertex> out;
  Polygon square;
  for (const glm::dvec3& p :
       {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 0)}) {
    square.add(p, true);
  }
  add_polygon(out, square, {0, 0, 1}, {}, glm::dvec3(0));
  REQUIRE(out.size() == 6);
  CHECK(out[0].edges == (1 | 4));  // not the diagonal, opposite corner 1
  CHECK(out[3].edges == (1 | 2));  // not the diagonal, opposite corner 2
}
