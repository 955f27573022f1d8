// SPDX-License-Identifier: MIT
// Handles and the numbering inside a tet.
#include "kernel/handles.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "kernel/geometry.h"

using namespace tetmend;

TEST_CASE("a default handle is invalid and a numbered one is not") {
  CHECK_FALSE(VertexHandle().is_valid());
  CHECK_FALSE(TetHandle().is_valid());
  CHECK(VertexHandle(0).is_valid());
  CHECK(TetHandle(7).index() == 7);
  CHECK(TetHandle(3) < TetHandle(4));
}

TEST_CASE("handles of different kinds and plain numbers do not mix") {
  static_assert(!std::is_convertible_v<TetHandle, VertexHandle>);
  static_assert(!std::is_convertible_v<std::uint32_t, TetHandle>);
  static_assert(!std::is_convertible_v<TetHandle, std::uint32_t>);
  static_assert(!std::is_invocable_v<std::equal_to<>, HalfFace, TetEdge>);
  static_assert(sizeof(VertexHandle) == 4 && sizeof(HalfFace) == 4 && sizeof(TetEdge) == 4);
}

TEST_CASE("half-faces and tet edges give back what they were made of") {
  for (const std::uint32_t t : {0u, 1u, 12345u, (1u << 29) - 1}) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(TetHandle(t), f);
      CHECK(face.tet() == TetHandle(t));
      CHECK(face.face() == f);
      CHECK_FALSE(face.is_outside());
      CHECK(HalfFace::from_code(face.code()) == face);
    }
    for (unsigned e = 0; e < 6; ++e) {
      const TetEdge edge(TetHandle(t), e);
      CHECK(edge.tet() == TetHandle(t));
      CHECK(edge.edge() == e);
      CHECK(TetEdge::from_code(edge.code()) == edge);
    }
  }
}

TEST_CASE("a half-face of the outside carries the number of its surface triangle") {
  for (const std::uint32_t k : {0u, 1u, 0x7FFFFFFEu}) {
    CHECK(HalfFace::outside(k).is_outside());
    CHECK(HalfFace::outside(k).surface_triangle() == k);
  }
  CHECK(HalfFace().is_outside());
}

TEST_CASE("the faces of a positive tet are counterclockwise as seen from outside") {
  const std::array<Point, 4> p = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  REQUIRE(volume6(p[0], p[1], p[2], p[3]) == 1);
  for (unsigned f = 0; f < 4; ++f) {
    const auto& [i, j, k] = kFaceVertices[f];
    CHECK(std::set<unsigned>{i, j, k, f}.size() == 4);
    // The opposite vertex lies behind the face.
    CHECK(volume6(p[f], p[i], p[j], p[k]) == 1);
  }
}

TEST_CASE("edge e and edge 5 - e join all four vertices, and kEdgeOf finds every edge") {
  for (unsigned e = 0; e < 6; ++e) {
    const auto& [i, j] = kEdgeVertices[e];
    const auto& [k, l] = kEdgeVertices[5 - e];
    CHECK(std::set<unsigned>{i, j, k, l}.size() == 4);
    CHECK(kEdgeOf[i][j] == e);
    CHECK(kEdgeOf[j][i] == e);
  }
}
