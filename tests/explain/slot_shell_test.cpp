// SPDX-License-Identifier: MIT
#include "explain/slot_shell.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernel/shell.h"
#include "kernel/workspace.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::explain;

TEST_CASE("every shell of a mesh is the one that the kernel finds, in the same sense of rotation") {
  const TetMesh mesh(test::delaunay_ball(60, 2));
  const SlotMesh slots(mesh);
  unsigned closed = 0;
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    for (unsigned e = 0; e < 6; ++e) {
      const TetEdge edge(TetHandle(t), e);
      const auto ends = mesh.vertices(edge);
      const SlotShell found = find_slot_shell(slots, ends[0], ends[1]);
      Shell truth;
      const bool is_closed = find_shell(mesh, edge, truth, Territory()) == ShellKind::closed;
      REQUIRE(found.closed == is_closed);
      if (!is_closed) continue;
      ++closed;
      REQUIRE(found.ring.size() == truth.degree);
      const bool swapped = truth.a != ends[0];
      std::vector<VertexHandle> ring(truth.ring.begin(), truth.ring.begin() + truth.degree);
      if (swapped) std::reverse(ring.begin(), ring.end());
      std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), found.ring[0]), ring.end());
      CHECK(found.ring == ring);
    }
  }
  CHECK(closed > 100);
}

TEST_CASE("an open shell is a row from one boundary face to the other") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 6, .open = true}))};
  const SlotShell shell = find_slot_shell(mesh, VertexHandle(0), VertexHandle(1));
  CHECK_FALSE(shell.closed);
  CHECK(shell.ring.size() == 6);
  CHECK(shell.tets.size() == 5);
}

TEST_CASE("an edge that is not there has no shell") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 6}))};
  const SlotShell shell = find_slot_shell(mesh, VertexHandle(2), VertexHandle(5));
  CHECK(shell.ring.empty());
  CHECK_FALSE(shell.closed);
}

TEST_CASE("the other vertices of a tet keep its orientation") {
  const TetVertices tet = {VertexHandle(4), VertexHandle(5), VertexHandle(6), VertexHandle(7)};
  const auto is_even = [&](std::array<VertexHandle, 4> order) {
    unsigned swaps = 0;
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = i + 1; j < 4; ++j) swaps += order[j] < order[i] ? 1 : 0;
    }
    return swaps % 2 == 0;
  };
  for (const VertexHandle a : tet) {
    const auto [p, q, r] = others(tet, a);
    CHECK(is_even({a, p, q, r}));
    for (const VertexHandle b : tet) {
      if (a == b) continue;
      const auto [x, y] = others(tet, a, b);
      CHECK(is_even({a, b, x, y}));
    }
  }
}

TEST_CASE("the circle around triangles follows their outer sides") {
  const auto v = [](std::uint32_t i) { return VertexHandle(i); };
  const std::vector<std::array<VertexHandle, 3>> fan = {
      {v(0), v(1), v(2)}, {v(0), v(2), v(3)}, {v(0), v(3), v(4)}};
  CHECK(circle_around(fan) == std::vector{v(0), v(1), v(2), v(3), v(4)});
  const std::vector<std::array<VertexHandle, 3>> apart = {{v(0), v(1), v(2)}, {v(3), v(4), v(5)}};
  CHECK(circle_around(apart).empty());
}
