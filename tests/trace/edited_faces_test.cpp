// SPDX-License-Identifier: MIT
#include "trace/edited_faces.h"

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/tets.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using TetList = std::vector<TetVertices>;

EditedFaces faces_of_tets(const TetList& tets) {
  EditedFaces faces;
  for (const TetVertices& tet : tets) {
    for (unsigned f = 0; f < 4; ++f) CHECK(faces.add(tet, f));
  }
  return faces;
}

/// False where two of what comes lie on one side of a face.
bool list(EditedFaces& faces, const TetList& gone, const TetList& come) {
  bool is_right = true;
  faces.list_none(gone.size() + come.size());
  for (unsigned f = 0; f < 4; ++f) {
    for (const TetVertices& tet : gone) faces.list_gone(tet, f);
    for (const TetVertices& tet : come) is_right = faces.list_come(tet, f) && is_right;
  }
  return is_right;
}

bool edit(EditedFaces& faces, const TetList& gone, const TetList& come) {
  faces.begin_edit(gone.size() + come.size());
  return list(faces, gone, come) && faces.make();
}

bool keep_hull(const TetList& gone, const TetList& come) {
  EditedFaces faces;
  return list(faces, gone, come) && faces.keep_hull();
}

const TetList kTwo = {tet_of(0, 1, 2, 3), tet_of(0, 2, 1, 4)};
const TetList kThree = {tet_of(0, 1, 4, 3), tet_of(1, 2, 4, 3), tet_of(2, 0, 4, 3)};
const TetVertices kBeside = tet_of(0, 1, 3, 5);  // at a face of their hull

}  // namespace

TEST_CASE("a face takes one tet on each side") {
  EditedFaces faces = faces_of_tets(kTwo);
  CHECK_FALSE(faces.add(tet_of(0, 1, 2, 5), 3));
  CHECK_FALSE(edit(faces, {}, {tet_of(0, 1, 2, 5)}));
  CHECK_FALSE(list(faces, {}, {tet_of(6, 7, 8, 9), tet_of(6, 7, 8, 10)}));
}

TEST_CASE("two tets and the three around an edge have the same hull, others have not") {
  CHECK(keep_hull(kTwo, kThree));
  CHECK(keep_hull(kThree, kTwo));
  CHECK_FALSE(keep_hull(kTwo, {kThree[0], kThree[1]}));
  CHECK_FALSE(keep_hull({kThree[0], kThree[1]}, kTwo));
  CHECK_FALSE(keep_hull(kTwo, {}));
  CHECK(keep_hull({}, {}));
}

TEST_CASE("tets are exchanged for others, but not for one whose place is taken") {
  TetList all = kTwo;
  all.push_back(kBeside);
  EditedFaces faces = faces_of_tets(all);
  CHECK(edit(faces, kTwo, kThree));
  SUBCASE("by one beside the hull") {
    CHECK_FALSE(edit(faces, {}, {tet_of(0, 1, 3, 6)}));
  }
  SUBCASE("by a new one") {
    CHECK_FALSE(edit(faces, {}, {kThree[0]}));
  }
  SUBCASE("by one that stays") {
    CHECK_FALSE(edit(faces, {kThree[1]}, {tet_of(0, 3, 1, 7)}));
  }
  SUBCASE("once all is settled, too") {
    faces.settle();
    CHECK_FALSE(edit(faces, {}, {kThree[0]}));
  }
}

TEST_CASE("an edit is undone as long as it is not settled, and then exchanged back") {
  EditedFaces faces = faces_of_tets(kTwo);
  CHECK_FALSE(faces.undo());
  CHECK(edit(faces, kTwo, kThree));
  CHECK(faces.undo());
  CHECK_FALSE(faces.undo());
  CHECK(edit(faces, kTwo, kThree));
  faces.settle();
  CHECK_FALSE(faces.undo());
  CHECK(list(faces, kThree, kTwo));
  CHECK(faces.make());
  CHECK(edit(faces, kTwo, kThree));
}

TEST_CASE("faces come and go at the boundary alone") {
  TetList all = kTwo;
  all.push_back(kBeside);
  EditedFaces faces = faces_of_tets(all);
  const auto fits = [&](const TetList& gone, const TetList& come) {
    return list(faces, gone, come) && faces.keep_hull_inside();
  };
  CHECK(fits(kTwo, kThree));
  CHECK(fits({kTwo[1]}, {tet_of(0, 2, 1, 6)}));
  CHECK_FALSE(fits({kTwo[0]}, {tet_of(0, 1, 2, 6)}));
}

TEST_CASE("many edits, most of them undone, some of them large, leave what a plain set has") {
  constexpr std::uint32_t kPlaces = 20000;  // tets that share no face
  std::set<std::uint32_t> there;
  std::vector<std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>> edits;
  EditedFaces faces;
  std::mt19937 random(7);
  const auto tets_at = [](const std::vector<std::uint32_t>& places) {
    TetList tets;
    for (const std::uint32_t i : places)
      tets.push_back(tet_of(4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3));
    return tets;
  };
  const auto exchange = [&](const auto& gone, const auto& come) {
    for (const std::uint32_t i : gone) there.erase(i);
    there.insert(come.begin(), come.end());
  };
  for (int turn = 0; turn < 4000; ++turn) {
    if (!edits.empty() && random() % 5 < 2) {
      const auto [gone, come] = edits.back();
      edits.pop_back();
      if (!faces.undo()) {
        CHECK(list(faces, tets_at(come), tets_at(gone)));
        CHECK(faces.make());
      }
      exchange(come, gone);
      continue;
    }
    std::set<std::uint32_t> gone, come;
    const std::size_t size = random() % 100 == 0 ? 300 : random() % 20;
    for (std::size_t k = 0; k < size; ++k) {
      const auto place = static_cast<std::uint32_t>(random() % kPlaces);
      (there.count(place) != 0 ? gone : come).insert(place);
    }
    edits.push_back({{gone.begin(), gone.end()}, {come.begin(), come.end()}});
    CHECK(edit(faces, tets_at(edits.back().first), tets_at(edits.back().second)));
    exchange(edits.back().first, edits.back().second);
  }
  // A face that is there cannot be added, one that is not can.
  REQUIRE(there.size() > 1000);
  for (std::uint32_t i = 0; i < kPlaces; ++i) {
    CHECK(edit(faces, {}, tets_at({i})) == (there.count(i) == 0));
  }
}
