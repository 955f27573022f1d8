// SPDX-License-Identifier: MIT
// Numbers for what a deck has none for.
#include "kernel/formats/new_numbers.h"

#include <array>

#include <doctest/doctest.h>

#include "kernel/error.h"

using namespace tetmend;
using formats::NewNumbers;

namespace {

constexpr std::array<std::int64_t, 2> kLimits = {100, INT64_MAX};

std::vector<std::int64_t> numbers(std::int64_t most, std::vector<NewNumbers::Range> taken, int n) {
  NewNumbers source(most, kLimits, [&] { return taken; });
  std::vector<std::int64_t> made;
  for (int i = 0; i < n; ++i) made.push_back(source.next());
  return made;
}

}  // namespace

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
  std::vector<NewNumbers::Range> found;
  formats::add_inp_numbers(
      "*NSET, NSET=all, generate\n7, 12, 1\n** 3, 4\n20, 30\n40\n"
      "*RIGID BODY, ELSET=E1, REF NODE=13\n-3, 2.5, 12,x7\r\nPart-1.15, 1, 6\n"
      "*ELSET,\n ELSET=e,\nGENERATE\n 101,105 ,2\n*BOUNDARY\n51, 53",
      found);
  CHECK(found == std::vector<NewNumbers::Range>{{7, 12},
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
  std::vector<NewNumbers::Range> found;
  formats::add_nastran_numbers(
      "SPOINT,5,THRU,9\n$ 77\nSPC1    12345678        1111111122222222\n        333     thru    "
      "340\n"
      "CBAR*                  1        99999999\n*                     10\n",
      found);
  CHECK(found == std::vector<NewNumbers::Range>{{5, 9},
                                                {12345678, 12345678},
                                                {11111111, 11111111},
                                                {22222222, 22222222},
                                                {333, 340},
                                                {1, 1},
                                                {99999999, 99999999},
                                                {10, 10}});
}
