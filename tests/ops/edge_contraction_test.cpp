// SPDX-License-Identifier: MIT
// Edge contraction in balls in which one vertex is too many.
#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "ops/registry.h"
#include "tests/support/lone_worker.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct ContractionWorker : LoneWorker {
  using LoneWorker::LoneWorker;
  Verdict attempt(VertexHandle v) { return LoneWorker::attempt("edge_contraction", Target::of(v)); }
};

/// A regular tet with a vertex inside, close to a corner or in the middle of nowhere.
MeshData tet_split_at(const Point& inner) {
  MeshData data = one_tet();
  data.points.push_back(inner);
  const auto corners = data.tets[0].vertices;
  data.tets.clear();
  for (unsigned f = 0; f < 4; ++f) {
    auto tet = corners;
    tet[f] = 4;
    data.tets.push_back({tet});
  }
  return data;
}

/// The centre of a large octahedron is split in two: vertices 0 and 1, both inside.
MeshData double_centre(double gap) {
  MeshData data;
  data.points = {{0, 0, -gap}, {0, 0, gap}, {1, 0, 0}, {0, 1, 0},
                 {-1, 0, 0},   {0, -1, 0},  {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t p = 2 + i;
    const std::uint32_t q = 2 + (i + 1) % 4;
    data.tets.push_back({{0, 1, p, q}});
    data.tets.push_back({{1, 6, p, q}});
    data.tets.push_back({{7, 0, p, q}});
  }
  return data;
}

}  // namespace

TEST_CASE("a vertex inside a tet is merged into a corner on the boundary, which stays") {
  for (const Point& inner : {Point(0.6, 0.5, 0.5), Point(0, 0, 0), Point(-0.1, 0.2, 0.1)}) {
    ContractionWorker worker(tet_split_at(inner));
    const auto corners = live_vertices(worker.mesh);
    CHECK(worker.attempt(VertexHandle(4)) == Verdict::accepted);
    CHECK(worker.mesh.tet_count() == 1);
    CHECK(worker.mesh.vertex_count() == 4);
    CHECK(worker.mesh.is_deleted(VertexHandle(4)));
    CHECK(worker.worst() == doctest::Approx(2 * 0.942809));
    for (std::uint32_t v = 0; v < 4; ++v) {
      CHECK(worker.mesh.point(VertexHandle(v)) == one_tet().points[v]);
    }
  }
}

TEST_CASE("of two vertices inside, one is removed and the other moves to where the ball is best") {
  ContractionWorker worker(double_centre(0.08));
  REQUIRE(count_not_positive(worker.mesh) == 0);
  REQUIRE(worker.worst() < 0.5f);
  CHECK(worker.attempt(VertexHandle(0)) == Verdict::accepted);
  CHECK(worker.mesh.vertex_count() == 7);
  CHECK(worker.worst() > 0.5f);
  CHECK(count_not_positive(worker.mesh) == 0);
}

TEST_CASE("the centre of an icosahedron stays: every corner would make a worse ball") {
  MeshData data;
  data.points.push_back(Point::Zero());
  const double golden = (1 + std::sqrt(5.0)) / 2;
  for (const double one : {-1.0, 1.0}) {
    for (const double g : {-golden, golden}) {
      data.points.emplace_back(0, one, g);
      data.points.emplace_back(one, g, 0);
      data.points.emplace_back(g, 0, one);
    }
  }
  // Faces join corners at distance 2.
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    return (data.points[i] - data.points[j]).norm() < 2.1;
  };
  for (std::uint32_t i = 1; i <= 12; ++i) {
    for (std::uint32_t j = i + 1; j <= 12; ++j) {
      for (std::uint32_t k = j + 1; k <= 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const bool positive =
            volume6(data.points[0], data.points[i], data.points[j], data.points[k]) > 0;
        data.tets.push_back({{0, i, positive ? j : k, positive ? k : j}});
      }
    }
  }
  REQUIRE(data.tets.size() == 20);
  CHECK(ContractionWorker(data).attempt(VertexHandle(0)) == Verdict::no_improvement);
}

TEST_CASE("vertices on the boundary, on constraints or required by the file are refused") {
  ContractionWorker boundary(double_centre(0.08));
  for (std::uint32_t v = 2; v < 8; ++v) {
    CHECK(boundary.attempt(VertexHandle(v)) == Verdict::constrained);
  }
  MeshData required = double_centre(0.08);
  required.required_vertices = {0, 1};
  MeshData edge = double_centre(0.08);
  edge.edges.push_back({{0, 1}, 1});
  MeshData face = double_centre(0.08);
  face.triangles.push_back({{0, 1, 2}, 1});
  for (const MeshData& data : {required, edge, face}) {
    CHECK(ContractionWorker(data).attempt(VertexHandle(0)) == Verdict::constrained);
    CHECK(ContractionWorker(data).attempt(VertexHandle(1)) == Verdict::constrained);
  }
}

TEST_CASE("a kept vertex that the file requires does not move") {
  MeshData data = double_centre(0.08);
  data.required_vertices = {1};
  ContractionWorker worker(data);
  worker.attempt(VertexHandle(0));
  REQUIRE_FALSE(worker.mesh.is_deleted(VertexHandle(1)));
  CHECK(worker.mesh.point(VertexHandle(1)) == data.points[1]);
}

TEST_CASE("a vertex of no tet and a vertex that is gone are not applicable") {
  MeshData data = tet_split_at({0, 0, 0});
  data.points.emplace_back(9, 9, 9);
  ContractionWorker worker(data);
  CHECK(worker.attempt(VertexHandle(5)) == Verdict::not_applicable);
  REQUIRE(worker.attempt(VertexHandle(4)) == Verdict::accepted);
  CHECK(worker.attempt(VertexHandle(4)) == Verdict::not_applicable);
}
