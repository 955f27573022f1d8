// SPDX-License-Identifier: MIT
// Smoothing of one vertex in balls whose best place is known.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/star.h"
#include "ops/registry.h"
#include "ops/vertex_ball.h"
#include "tests/support/lone_worker.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Eight tets around vertex 0, which lies at `centre`, in an octahedron of radius 1.
MeshData filled_octahedron(const Point& centre) {
  MeshData data;
  data.points = {Point::Zero(), {1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                 {0, -1, 0},    {0, 0, 1}, {0, 0, -1}};
  for (const std::uint32_t i : {1u, 2u}) {
    for (const std::uint32_t j : {3u, 4u}) {
      for (const std::uint32_t k : {5u, 6u}) {
        const bool even = (i + j + k) % 2 == 1;
        data.tets.push_back({{0, i, even ? j : k, even ? k : j}});
      }
    }
  }
  data.points[0] = centre;
  return data;
}

struct SmoothingWorker : LoneWorker {
  using LoneWorker::LoneWorker;
  Verdict attempt(std::uint32_t v, const ParameterSettings& settings = {}) {
    return LoneWorker::attempt("smoothing", Target::of(VertexHandle(v)), settings);
  }
  const Point& centre() const { return mesh.point(VertexHandle(0)); }
};

}  // namespace

TEST_CASE("a vertex displaced in an octahedron goes back to the centre") {
  SmoothingWorker worker(filled_octahedron({0.2, 0.1, -0.3}));
  CHECK(worker.attempt(0) == Verdict::accepted);
  CHECK(worker.centre().norm() < 1e-12);
  CHECK(worker.worst() == doctest::Approx(2 * 0.8164966));
  CHECK(worker.attempt(0) == Verdict::no_improvement);
}

TEST_CASE("without the mean of the neighbours, the ascent alone makes the ball good") {
  SmoothingWorker worker(filled_octahedron({0.3, 0.2, -0.35}));
  REQUIRE(worker.worst() < 0.5f);
  CHECK(worker.attempt(0, {{"laplacian", 0}}) == Verdict::accepted);
  CHECK(worker.worst() >= 0.5f);
  CHECK(worker.attempt(0, {{"laplacian", 0}}) == Verdict::no_improvement);
}

TEST_CASE("without the ascent, the mean of the neighbours is taken only where it helps") {
  SmoothingWorker worker(filled_octahedron({0.2, 0.1, -0.3}));
  CHECK(worker.attempt(0, {{"optimise", 0}}) == Verdict::accepted);
  SmoothingWorker off(filled_octahedron({0.2, 0.1, -0.3}));
  CHECK(off.attempt(0, {{"optimise", 0}, {"laplacian", 0}}) == Verdict::no_improvement);
  SmoothingWorker best(filled_octahedron({0, 0, 0}));
  CHECK(best.attempt(0, {{"optimise", 0}}) == Verdict::no_improvement);
}

TEST_CASE("a vertex outside its ball comes back and its inverted tets turn over") {
  SmoothingWorker worker(filled_octahedron({0.6, 0.5, 0.4}));
  REQUIRE(count_not_positive(worker.mesh) > 0);
  CHECK(worker.attempt(0) == Verdict::accepted);
  CHECK(count_not_positive(worker.mesh) == 0);
  CHECK(worker.worst() > 0.5f);
  SmoothingWorker climbing(filled_octahedron({0.6, 0.5, 0.4}));
  CHECK(climbing.attempt(0, {{"laplacian", 0}}) == Verdict::accepted);
  CHECK(climbing.worst() > 0);
}

TEST_CASE("a flat tet in the ball becomes positive") {
  SmoothingWorker worker(filled_octahedron(Point(1, 1, 1) / 3));
  REQUIRE(worker.worst() < 1e-9f);
  CHECK(worker.attempt(0) == Verdict::accepted);
  CHECK(count_not_positive(worker.mesh) == 0);
}

TEST_CASE("vertices on the boundary, on a constraint or required by the file are refused") {
  SmoothingWorker worker(filled_octahedron({0.2, 0.1, -0.3}));
  for (std::uint32_t v = 1; v <= 6; ++v) CHECK(worker.attempt(v) == Verdict::constrained);
  MeshData face = filled_octahedron({0.2, 0.1, -0.3});
  face.triangles.push_back({{0, 1, 3}, 1});
  MeshData edge = filled_octahedron({0.2, 0.1, -0.3});
  edge.edges.push_back({{0, 1}, 1});
  MeshData required = filled_octahedron({0.2, 0.1, -0.3});
  required.required_vertices.push_back(0);
  for (const MeshData& data : {face, edge, required}) {
    CHECK(SmoothingWorker(data).attempt(0) == Verdict::constrained);
  }
}

TEST_CASE("a vertex of no tet is not applicable") {
  MeshData data = filled_octahedron({0.2, 0.1, -0.3});
  data.points.emplace_back(5, 5, 5);
  CHECK(SmoothingWorker(data).attempt(7) == Verdict::not_applicable);
}

TEST_CASE("smoothing moves one vertex and changes nothing else") {
  SmoothingWorker worker(delaunay_ball(100, 3));
  unsigned accepted = 0;
  for (const VertexHandle v : live_vertices(worker.mesh)) {
    const TetMesh before = worker.mesh;
    if (worker.attempt(v.index()) != Verdict::accepted) continue;
    ++accepted;
    CHECK(worker.mesh.point(v) != before.point(v));
    for (const VertexHandle w : live_vertices(worker.mesh)) {
      if (w != v) CHECK(worker.mesh.point(w) == before.point(w));
    }
    for (const TetHandle t : live_tets(worker.mesh)) {
      CHECK(worker.mesh.vertices(t) == before.vertices(t));
      if (worker.mesh.local_index(t, v) == 4) CHECK(worker.mesh.quality(t) == before.quality(t));
    }
  }
  CHECK(accepted > 10);
}

TEST_CASE("the ball of a vertex is loaded triangle by triangle, positive from inside") {
  SmoothingWorker worker(filled_octahedron({0.1, 0.1, 0.1}));
  BallOptimiser ball;
  const auto faces = link(worker.mesh, VertexHandle(0));
  load_ball(worker.mesh, faces, ball);
  REQUIRE(ball.size() == 8);
  CHECK(ball.worst(worker.centre()) == doctest::Approx(worker.worst()).epsilon(1e-6));
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(ball.quality(i) == doctest::Approx(worker.mesh.quality(faces[i].tet())).epsilon(1e-6));
  }
}
