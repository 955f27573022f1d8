// SPDX-License-Identifier: MIT
// Numbers for what a deck has none for.
#include "kernel/formats/new_numbers.h"

#include <array>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/formats/hdf5_file.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;
using formats::NewNumbers;

namespace {

constexpr std::array<std::int64_t, 2> kLimits = {100, INT64_MAX};

std::vector<std::int64_t> numbers(std::int64_t most, std::vector<NumberRange> taken, int n) {
  NewNumbers source(most, kLimits, [&] { return taken; });
  std::vector<std::int64_t> made;
  for (int i = 0; i < n; ++i) made.push_back(source.next());
  return made;
}

/// Two tets, the second with the greatest numbers.
MeshData numbered_mesh() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.point_numbers = {1, 2, 3, 4, 40};
  mesh.tets = {{{0, 1, 2, 3}, 1}, {{1, 2, 3, 4}, 1}};
  mesh.tet_numbers = {7, 70};
  return mesh;
}

}  // namespace

TEST_CASE("what is new in a file with numbers gets none that the file had, even if that is free") {
  const TempFolder folder;
  std::vector<std::string> endings = {".bdf", ".k", ".feb", ".unv", ".inp"};
  if (formats::has_hdf5()) endings.insert(endings.end(), {".exo", ".med"});
  for (const std::string& ending : endings) {
    CAPTURE(ending);
    write_mesh(folder / ("a" + ending), numbered_mesh());
    MeshData mesh = read_mesh(folder / ("a" + ending));
    REQUIRE(mesh.tet_numbers == numbered_mesh().tet_numbers);
    REQUIRE(mesh.point_numbers == numbered_mesh().point_numbers);
    // The second tet goes, and the point that it had alone; others come.
    mesh.points[4] = {1, 1, 2};
    mesh.point_numbers[4] = mesh.tet_numbers[1] = 0;
    write_mesh(folder / ("b" + ending), mesh);
    const MeshData again = read_mesh(folder / ("b" + ending));
    CHECK(again.tet_numbers == std::vector<std::int64_t>{7, 71});
    CHECK(again.point_numbers == std::vector<std::int64_t>{1, 2, 3, 4, 41});
  }
}

TEST_CASE("where no greater number is left, those that the file had are passed over") {
  const std::vector<std::int64_t> known = {100, 0, 5};
  const std::vector<NumberRange> of_file = {{2, 3}, {5, 6}, {98, 100}};
  NewNumbers next = formats::numbers_beside(known, of_file, kLimits, 0, [] {
    return std::vector<NumberRange>{{8, 9}};
  });
  std::vector<std::int64_t> given = {0, 5, 0, 0, 0};
  formats::complete(given, next);
  CHECK(given == std::vector<std::int64_t>{1, 5, 4, 7, 10});
}

TEST_CASE("all numbers of points and elements of a mesh are taken, as few ranges") {
  MeshData mesh = numbered_mesh();
  mesh.triangle_numbers = {9, 8, 0};
  mesh.other_elements.push_back({12, 8, {}, {}, {}, {71, 6, INT64_MAX}, {}});
  formats::note_taken_numbers(mesh);
  CHECK(mesh.taken_point_numbers == std::vector<NumberRange>{{1, 4}, {40, 40}});
  CHECK(mesh.taken_element_numbers ==
        std::vector<NumberRange>{{6, 9}, {70, 71}, {INT64_MAX, INT64_MAX}});
}

TEST_CASE("new numbers count on from the greatest, and come from between where that is the limit") {
  using List = std::vector<std::int64_t>;
  CHECK(numbers(0, {}, 3) == List{1, 2, 3});
  CHECK(numbers(97, {{1, 97}}, 3) == List{98, 99, 100});
  CHECK(numbers(99, {{1, 3}, {5, 5}, {99, 99}}, 4) == List{100, 4, 6, 7});
  CHECK(numbers(100, {{2, 5}, {4, 9}, {1, 1}, {3, 3}, {100, 100}}, 2) == List{10, 11});
  CHECK(numbers(101, {}, 2) == List{102, 103});  // above a limit: the next one counts
  CHECK(numbers(INT64_MAX, {{INT64_MAX, INT64_MAX}, {2, 2}}, 3) == List{1, 3, 4});
  CHECK(numbers(INT64_MAX - 1, {{1, INT64_MAX - 1}}, 1) == List{INT64_MAX});
  CHECK_THROWS_AS(numbers(INT64_MAX, {{1, INT64_MAX}}, 1), Error);
  CHECK_THROWS_AS(numbers(100, {{1, 50}, {52, 100}}, 2), Error);
}

TEST_CASE(
    "numbers of an Abaqus deck that is kept word for word are those of all words and ranges") {
  std::vector<NumberRange> found;
  formats::add_inp_numbers(
      "*NSET, NSET=all, generate\n7, 12, 1\n** 3, 4\n20, 30\n40\n"
      "*RIGID BODY, ELSET=E1, REF NODE=13\n-3, 2.5, 12,x7\r\nPart-1.15, 1, 6\n"
      "*ELSET,\n ELSET=e,\nGENERATE\n 101,105 ,2\n*BOUNDARY\n51, 53",
      found);
  CHECK(found == std::vector<NumberRange>{{7, 12},
                                          {20, 30},
                                          {40, 40},
                                          {13, 13},
                                          {12, 12},
                                          {15, 15},
                                          {1, 1},
                                          {6, 6},
                                          {101, 105},
                                          {51, 51},
                                          {53, 53}});
}

TEST_CASE("numbers of Nastran are those of fields, which may touch, and of their ranges") {
  std::vector<NumberRange> found;
  formats::add_nastran_numbers(
      "SPOINT,5,THRU,9\n$ 77\nSPC1    12345678        1111111122222222\n        333     thru    "
      "340\n"
      "CBAR*                  1        99999999\n*                     10\n",
      found);
  CHECK(found == std::vector<NumberRange>{{5, 9},
                                          {12345678, 12345678},
                                          {11111111, 11111111},
                                          {22222222, 22222222},
                                          {333, 340},
                                          {1, 1},
                                          {99999999, 99999999},
                                          {10, 10}});
}
