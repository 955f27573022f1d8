// SPDX-License-Identifier: MIT
#include "trace/tet_faces.h"

#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;

namespace {

TetVertices tet_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return {VertexHandle(a), VertexHandle(b), VertexHandle(c), VertexHandle(d)};
}

void add(TetFaces& faces, const TetVertices& tet) {
  for (unsigned f = 0; f < 4; ++f) CHECK(faces.add(tet, f));
}

TetFaces faces_of(const std::vector<TetVertices>& tets) {
  TetFaces faces;
  for (const TetVertices& tet : tets) add(faces, tet);
  return faces;
}

}  // namespace

TEST_CASE("a face takes one tet on each side, and another when that is gone") {
  TetFaces faces;
  const TetVertices above = tet_of(0, 1, 2, 3);
  add(faces, above);
  add(faces, tet_of(0, 2, 1, 4));
  CHECK_FALSE(faces.add(tet_of(0, 1, 2, 5), 3));
  CHECK(faces.exchange(faces_of({above}), TetFaces()));
  CHECK(faces.add(tet_of(0, 1, 2, 5), 3));
}

TEST_CASE("tets are exchanged for others, but not for one whose place is taken") {
  const std::vector<TetVertices> two = {tet_of(0, 1, 2, 3), tet_of(0, 2, 1, 4)};
  const std::vector<TetVertices> three = {tet_of(0, 1, 4, 3), tet_of(1, 2, 4, 3),
                                          tet_of(2, 0, 4, 3)};
  const TetVertices beside = tet_of(0, 1, 3, 5);  // at a face of the hull
  TetFaces faces = faces_of(two);
  add(faces, beside);
  CHECK(faces.exchange(faces_of(two), faces_of(three)));
  TetFaces all = faces_of(three);
  add(all, beside);
  CHECK(faces.same_hull(all));
  for (const TetVertices& tet : three) CHECK_FALSE(faces.add(tet, 0));
  CHECK_FALSE(faces.exchange(TetFaces(), faces_of({tet_of(0, 1, 3, 6)})));  // that of beside
  CHECK_FALSE(faces.exchange(faces_of({three[1]}), faces_of({tet_of(0, 3, 1, 7)})));
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
      CHECK(faces.exchange(faces_of({tet_of(i, i + 1, i + 2, i + 3)}), TetFaces()));
    }
  }
  CHECK(faces.same_hull(TetFaces()));
}
