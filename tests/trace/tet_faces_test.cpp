// SPDX-License-Identifier: MIT
#include "trace/tet_faces.h"

#include <doctest/doctest.h>

using namespace tetmend;

namespace {

TetVertices tet_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return {VertexHandle(a), VertexHandle(b), VertexHandle(c), VertexHandle(d)};
}

void add(TetFaces& faces, const TetVertices& tet) {
  for (unsigned f = 0; f < 4; ++f) CHECK(faces.add(tet, f));
}

}  // namespace

TEST_CASE("a face takes one tet on each side, and another when that is gone") {
  TetFaces faces;
  const TetVertices above = tet_of(0, 1, 2, 3);
  add(faces, above);
  add(faces, tet_of(0, 2, 1, 4));
  CHECK_FALSE(faces.add(tet_of(0, 1, 2, 5), 3));
  faces.remove(above, 3);
  CHECK(faces.add(tet_of(0, 1, 2, 5), 3));
}

TEST_CASE("two tets and the three around an edge have the same hull, others have not") {
  TetFaces two;
  add(two, tet_of(0, 1, 2, 3));
  add(two, tet_of(0, 2, 1, 4));
  TetFaces three;
  add(three, tet_of(0, 1, 4, 3));
  add(three, tet_of(1, 2, 4, 3));
  CHECK_FALSE(two.same_hull(three));
  CHECK_FALSE(three.same_hull(two));
  add(three, tet_of(2, 0, 4, 3));
  CHECK(two.same_hull(three));
  CHECK(three.same_hull(two));
  three.clear();
  CHECK_FALSE(two.same_hull(three));
  CHECK(three.same_hull(TetFaces()));
}

TEST_CASE("many faces come and go") {
  TetFaces faces;
  for (int round = 0; round < 5; ++round) {
    for (std::uint32_t i = 0; i < 5000; ++i) add(faces, tet_of(i, i + 1, i + 2, i + 3));
    for (std::uint32_t i = 0; i < 5000; ++i) {
      for (unsigned f = 0; f < 4; ++f) faces.remove(tet_of(i, i + 1, i + 2, i + 3), f);
    }
  }
  CHECK(faces.same_hull(TetFaces()));
}
