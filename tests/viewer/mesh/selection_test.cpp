// SPDX-License-Identifier: MIT
#include "viewer/mesh/selection.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/error.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

std::string value_of(const std::vector<Row>& rows, const std::string& name) {
  for (const auto& row : rows) {
    if (row.name == name) return row.value;
  }
  return "(no row)";
}

}  // namespace

TEST_CASE("the ray through the middle of every visible triangle hits its tet") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  const Camera& camera = s.document.view.camera;
  const Scene& scene = s.document.scene();
  int seen = 0;
  for (std::size_t i = 0; i < scene.surface_tets.size(); ++i) {
    const auto* v = &scene.surface[3 * i];
    const glm::dvec3 middle =
        glm::dvec3(v[0].position + v[1].position + v[2].position) / 3.0 + scene.origin;
    const glm::dvec3 normal(v[0].normal[0], v[0].normal[1], v[0].normal[2]);
    if (glm::dot(normal, middle - camera.eye()) >= 0) continue;  // on the far side
    const auto pixel = camera.project(middle, s.document.canvas);
    REQUIRE(pixel);
    const auto hit = cast(scene, camera.ray(pixel->x, pixel->y, s.document.canvas));
    REQUIRE(hit);
    CHECK(hit->tet == scene.surface_tets[i]);
    ++seen;
  }
  CHECK(seen == 3 * 8);
}

TEST_CASE("a bad tet behind the surface is picked through it, and then what is in front") {
  TestSession s(test::kuhn_cube(4, 0.35, 1));
  const TetMesh& mesh = s.document.mesh();
  const Scene& scene = s.document.scene();
  const Camera& camera = s.document.view.camera;
  const auto pick = [&](const glm::dvec2& at) {
    s.document.pick(at.x, at.y);
    return s.document.selection();
  };
  s.run("pick_kind", {"tet"});
  unsigned seen = 0;
  for (const TetHandle t : scene.through_tets) {
    if (!t.is_valid()) continue;
    const auto c = corners(mesh, t);
    const auto at = camera.project((c[0] + c[1] + c[2] + c[3]) / 4.0, s.document.canvas);
    const Ray ray = camera.ray(at->x, at->y, s.document.canvas);
    const TetHandle front = cast(scene, ray)->tet;
    const TetHandle bad = cast_through(scene, ray)->tet;
    CHECK(mesh.quality(bad) < kBadThreshold);
    if (front == bad) continue;
    ++seen;
    s.document.tells_pick = false;
    CHECK(pick(*at) == viewer::Selection(bad));
    CHECK(s.document.tells_pick);
    CHECK(pick(*at) == viewer::Selection(front));
    CHECK(pick(*at) == viewer::Selection(bad));
    s.document.view.camera.orbit(10, 0);
    CHECK(pick(*at) != viewer::Selection(front));  // another view: from the beginning
    s.document.view.camera.orbit(-10, 0);
  }
  CHECK(seen > 3);
  s.run("bad");
  CHECK(s.document.scene().bad_shown == 0);
  const glm::dvec2 middle(200, 150);
  const TetHandle front = cast(s.document.scene(), camera.ray(200, 150, s.document.canvas))->tet;
  CHECK(pick(middle) == viewer::Selection(front));
  CHECK(pick(middle) == viewer::Selection(front));
}

TEST_CASE("a click beside the mesh selects nothing") {
  TestSession s(test::one_tet());
  CHECK(s.run("pick", {200, 150})["kind"] != "nothing");
  CHECK(s.run("pick", {1, 1})["kind"] == "nothing");
}

TEST_CASE("a click near a corner takes the vertex, near an edge the edge, else the tet") {
  TestSession s(test::one_tet());
  const TetMesh& mesh = s.document.mesh();
  const Camera& camera = s.document.view.camera;
  const Hit middle = {TetHandle(0), glm::dvec3(0)};
  const auto c = corners(mesh, TetHandle(0));
  const auto take = [&](const glm::dvec3& p, PickKind kind) {
    return refine(mesh, {TetHandle(0), p}, kind, camera, s.document.canvas);
  };
  CHECK(std::get<VertexHandle>(take(c[1], PickKind::nearest)) == mesh.vertices(TetHandle(0))[1]);
  const auto edge = std::get<TetEdge>(take((c[0] + c[1]) / 2.0, PickKind::nearest));
  CHECK(edge.edge() == 0);
  CHECK(std::holds_alternative<TetHandle>(take((c[0] + c[1] + c[2]) / 3.0, PickKind::nearest)));
  CHECK(std::holds_alternative<TetHandle>(take(c[1], PickKind::tet)));
  CHECK(std::holds_alternative<TetEdge>(take(middle.point, PickKind::edge)));
  CHECK(std::holds_alternative<VertexHandle>(take(middle.point, PickKind::vertex)));
}

TEST_CASE("an edge is described by its shell, in the words of the paper") {
  TestSession s(test::shell_mesh({.degree = 6}));
  s.run("select_edge", {0, 1});
  const std::vector<Row> rows = describe(s.document.mesh(), s.document.selection());
  CHECK(value_of(rows, "supporting edge") == "0 1");
  CHECK(value_of(rows, "shell") == "closed");
  CHECK(value_of(rows, "degree (tets)") == "6");
  CHECK(value_of(rows, "supporting faces") == "6");
  CHECK(value_of(rows, "link faces") == "12");
  CHECK(value_of(rows, "skirt polygon").size() == 11);  // six numbers of one digit
  const Highlight& shown = s.document.highlighted();
  CHECK(shown.faces.empty());  // red tets behind stay red
  CHECK(std::count_if(shown.lines.begin(), shown.lines.end(),
                      [](const Line& line) { return line.colour == kSkirtColour; }) == 6);
}

TEST_CASE("the shell of a boundary edge is open") {
  TestSession s(test::shell_mesh({.degree = 6, .open = true}));
  s.run("select_edge", {0, 1});
  const std::vector<Row> rows = describe(s.document.mesh(), s.document.selection());
  CHECK(value_of(rows, "shell").starts_with("open"));
  CHECK(value_of(rows, "degree (tets)") == "5");
}

TEST_CASE("a tet is described by its number, region, quality and six angles") {
  TestSession s(test::one_tet());
  s.run("select_tet", {0});
  const std::vector<Row> rows = describe(s.document.mesh(), s.document.selection());
  CHECK(value_of(rows, "tet") == "0");
  CHECK(value_of(rows, "quality") == "1.8856");  // of 1 where the goal is just met
  CHECK(value_of(rows, "min_sine") == "0.9428");
  CHECK(std::count_if(rows.begin(), rows.end(), [](const auto& row) {
          return row.name.starts_with("angle") && row.value == "70.53°";
        }) == 6);
}

TEST_CASE("of a bad tet it is told whether it misses the goal or is a needle") {
  constexpr double kHeight = 8;
  const double r = std::sqrt(1.0 / 3);
  MeshData data;
  data.points = {{r, 0, 0}, {-r / 2, 0.5, 0}, {-r / 2, -0.5, 0}, {0, 0, kHeight}};
  data.tets = {{{0, 1, 2, 3}, 1}};
  TestSession s(data);
  s.run("select_tet", {0});
  const auto quality = [&] {
    return value_of(describe(s.document.mesh(), s.document.selection()), "quality");
  };
  CHECK(quality().ends_with("  (a needle)"));
  CHECK(s.document.scene().bad_shown == 0);
  s.run("goal", {65});
  CHECK(s.document.scene().bad_shown == 1);
  CHECK(quality().ends_with("  (misses the goal)"));
}

TEST_CASE("a vertex is described by its ball") {
  TestSession s(test::shell_mesh({.degree = 5}));
  s.run("select_vertex", {0});
  const std::vector<Row> rows = describe(s.document.mesh(), s.document.selection());
  CHECK(value_of(rows, "ball (tets)") == "5");
  CHECK(value_of(rows, "one-ring") == "6 vertices");
}

TEST_CASE("what a description names leads to it: angles to edges, vertices, tets") {
  TestSession s(test::shell_mesh({.degree = 5}));
  const TetMesh& mesh = s.document.mesh();
  const auto links_of = [&](const viewer::Selection& selection, const std::string& name) {
    for (const Row& row : describe(mesh, selection)) {
      if (row.name == name) return row.links;
    }
    return std::vector<viewer::Selection>();
  };
  const TetVertices& v = mesh.vertices(TetHandle(0));
  CHECK(links_of(TetHandle(0), "vertices").size() == 4);
  CHECK(links_of(TetHandle(0), "neighbours").size() == 2);
  for (unsigned e = 0; e < 6; ++e) {
    const auto& ends = kEdgeVertices[e];
    const auto links =
        links_of(TetHandle(0), fmt::format("angle {}-{}", v[ends[0]].index(), v[ends[1]].index()));
    REQUIRE(links.size() == 1);
    CHECK(links[0] == viewer::Selection(TetEdge(TetHandle(0), e)));
  }
  s.run("select_edge", {0, 1});
  CHECK(links_of(s.document.selection(), "tets").size() == 5);
  CHECK(links_of(s.document.selection(), "skirt polygon").size() == 5);
  CHECK(links_of(VertexHandle(0), "edges to").size() == 6);
}

TEST_CASE("what is not in the mesh cannot be selected") {
  TestSession s(test::shell_mesh({.degree = 5}));
  CHECK_THROWS_WITH_AS(s.run("select_tet", {99}), doctest::Contains("from 0 to 4"), Error);
  CHECK_THROWS_WITH_AS(s.run("select_edge", {2, 4}), doctest::Contains("no edge 2 - 4"), Error);
  CHECK_THROWS_WITH_AS(s.run("select_edge", {2, 2}), doctest::Contains("no edge 2 - 2"), Error);
  CHECK_THROWS_AS(s.run("select_vertex", {1.5}), Error);
}
