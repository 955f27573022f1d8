// SPDX-License-Identifier: MIT
// The example of the moving body, from outside: the mesh survives, the body arrives, and tets turn
// over where nothing is repaired.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/exact_orientation.h"
#include "kernel/formats/mesh_io.h"
#include "tests/apps/program.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct Row {
  std::size_t step, parts;
  double theta_min, theta_max;
  std::size_t n_bad, inverted, tets, touched;
  double seconds;
};

std::vector<Row> rows_of(const std::string& text) {
  std::istringstream lines(text);
  std::string header;
  std::getline(lines, header);
  CHECK(header == "step parts theta_min theta_max  n_bad inverted    tets touched seconds");
  std::vector<Row> rows;
  Row row{};
  while (lines >> row.step >> row.parts >> row.theta_min >> row.theta_max >> row.n_bad >>
         row.inverted >> row.tets >> row.touched >> row.seconds) {
    rows.push_back(row);
  }
  return rows;
}

bool is_on_wall(const Point& p) {
  return p.x() == 0 || p.y() == 0 || p.z() == 0 || p.x() == 14 || p.y() == 8 || p.z() == 8;
}

/// The 26 vertices of a cube with edges of length 2, turned by 60 degrees about the y axis.
std::vector<Point> body_at_its_end() {
  std::vector<Point> body;
  const double c = std::cos(std::numbers::pi / 3);
  const double s = std::sin(std::numbers::pi / 3);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        body.emplace_back(11 + c * x + s * z, 4 + y, 4 - s * x + c * z);
      }
    }
  }
  return body;
}

/// The body is a hole of the right shape, and the tets fill the rest of the box.
void check_last_mesh(const TetMesh& mesh) {
  CHECK(count_orientations(mesh).positive == mesh.tet_count());
  CHECK(std::abs(total_volume(mesh) - (14 * 8 * 8 - 8)) < 1e-9);
  std::set<std::uint32_t> vertices;
  double area = 0;
  for (const SurfaceTriangle& triangle : mesh.surface_triangles()) {
    const auto& [a, b, c] = triangle.vertices;
    if (is_on_wall(mesh.point(a)) && is_on_wall(mesh.point(b)) && is_on_wall(mesh.point(c)))
      continue;
    for (const VertexHandle v : triangle.vertices) vertices.insert(v.index());
    area += (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a)).norm() / 2;
  }
  CHECK(std::abs(area - 24) < 1e-9);
  const std::vector<Point> body = body_at_its_end();
  CHECK(vertices.size() == body.size());
  for (const std::uint32_t v : vertices) {
    const Point& p = mesh.point(VertexHandle(v));
    CHECK(std::any_of(body.begin(), body.end(),
                      [&](const Point& expected) { return (p - expected).norm() < 1e-12; }));
  }
}

}  // namespace

TEST_CASE("the body crosses the mesh in 40 steps, and no tet turns over") {
  const TempFolder folder;
  const Outcome outcome = run_program({"-o", (folder / "last.mesh").string()});
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
  const std::vector<Row> rows = rows_of(outcome.out);
  REQUIRE(rows.size() == 40);
  for (const Row& row : rows) {
    CAPTURE(row.step);
    CHECK(row.inverted == 0);
    CHECK(row.theta_min > 12);
    CHECK(row.touched < row.tets / 2);
  }
  check_last_mesh(TetMesh(read_mesh(folder / "last.mesh")));
}

TEST_CASE("without improvement, tets turn over before the body has crossed the mesh") {
  const Outcome outcome = run_program({"--plain"});
  CHECK(outcome.status == 1);
  const std::vector<Row> rows = rows_of(outcome.out);
  REQUIRE(rows.size() == 40);
  CHECK(rows.front().inverted == 0);
  CHECK(std::any_of(rows.begin(), rows.end() - 1, [](const Row& row) { return row.inverted > 0; }));
  for (const Row& row : rows) CHECK(row.touched == 0);
}

TEST_CASE("steps that are too wide for the mesh are made in parts") {
  const TempFolder folder;
  const Outcome outcome = run_program({"--steps", "4", "-o", (folder / "last.mesh").string()});
  CHECK(outcome.status == 0);
  const std::vector<Row> rows = rows_of(outcome.out);
  REQUIRE(rows.size() == 4);
  for (const Row& row : rows) {
    CHECK(row.inverted == 0);
    CHECK(row.parts > 1);
  }
  check_last_mesh(TetMesh(read_mesh(folder / "last.mesh")));
}
