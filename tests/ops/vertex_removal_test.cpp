// SPDX-License-Identifier: MIT
// Vertex removal: balls that are better without their vertex, and those that are not.
#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// octahedron() around a vertex 6.
MeshData octahedron_around(const Point& middle, double h, double x, double y) {
  MeshData data = octahedron(h, x, y);
  data.points.push_back(middle);
  data.tets.clear();
  for (const std::uint32_t end : {0u, 1u}) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t p = 2 + i;
      const std::uint32_t q = 2 + (i + 1) % 4;
      if (end == 0) {
        data.tets.push_back({{0, 6, p, q}, 7});
      } else {
        data.tets.push_back({{6, 1, p, q}, 7});
      }
    }
  }
  return data;
}

Verdict remove(LoneWorker& worker, std::uint32_t v, const ParameterSettings& settings = {}) {
  return worker.attempt("vertex_removal", Target::of(VertexHandle(v)), settings);
}

}  // namespace

TEST_CASE("a vertex near a face of its ball is removed, and the ball filled in the best way") {
  LoneWorker worker(octahedron_around({0.45, 0.45, 0.45}, 1.5, 1.4, 1.6));
  REQUIRE(remove(worker, 6) == Verdict::accepted);
  CHECK(worker.tets() == kAround24);
  CHECK(worker.mesh.is_deleted(VertexHandle(6)));
  for (const TetHandle t : live_tets(worker.mesh)) CHECK(worker.mesh.label(t) == 7);
}

TEST_CASE("a vertex in the middle of a good ball stays") {
  LoneWorker worker(octahedron_around({0, 0, 0}, 1, 1, 1));
  CHECK(remove(worker, 6) == Verdict::no_improvement);
}

TEST_CASE("fixed vertices stay: of the surface, required ones, ends of constrained edges") {
  const MeshData plain = octahedron_around({0.45, 0.45, 0.45}, 1.5, 1.4, 1.6);
  LoneWorker surface(plain);
  CHECK(remove(surface, 0) == Verdict::constrained);
  MeshData edges = plain;
  edges.edges.push_back({{0, 6}, 1});
  LoneWorker constrained(edges);
  CHECK(remove(constrained, 6) == Verdict::constrained);
}

TEST_CASE("a vertex with more than 32 neighbours is none to remove") {
  MeshData large = shell_mesh({.degree = 40});
  const auto middle = static_cast<std::uint32_t>(large.points.size());
  large.points.push_back({0, 0, 0});
  const auto old_tets = large.tets;
  large.tets.clear();
  for (const auto& tet : old_tets) {
    for (const std::uint32_t end : {0u, 1u}) {
      auto half = tet;
      std::replace(half.vertices.begin(), half.vertices.end(), end, middle);
      large.tets.push_back(half);
    }
  }
  LoneWorker worker(large);
  CHECK(remove(worker, middle) == Verdict::not_applicable);
}

TEST_CASE("a removal is deferred when the ball belongs to others as well") {
  LoneWorker worker(octahedron_around({0.45, 0.45, 0.45}, 1.5, 1.4, 1.6));
  worker.give_away({4});
  CHECK(remove(worker, 6) == Verdict::deferred);
}

TEST_CASE("a search without nodes left is a refusal of its own") {
  LoneWorker worker(octahedron_around({0.45, 0.45, 0.45}, 1.5, 1.4, 1.6));
  CHECK(remove(worker, 6, {{"max_nodes", 1}}) == Verdict::budget_spent);
}

TEST_CASE("nothing is removed where tets may overlap") {
  LoneWorker worker(tangled_ball(60, 1));
  REQUIRE(worker.workspace.mesh_may_overlap());
  for (const VertexHandle v : live_vertices(worker.mesh)) {
    CHECK(remove(worker, v.index()) == Verdict::not_applicable);
  }
}
