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

TEST_CASE("numbers of a deck that is kept word for word are those of all its words and ranges") {
  std::vector<NewNumbers::Range> found;
  formats::add_numbers_of("SPOINT,5,THRU,9\n7 -3 2.5 12,x7\r\n1 thru 4 THRU 6", found);
  CHECK(found == std::vector<NewNumbers::Range>{{5, 9}, {7, 7}, {12, 12}, {1, 6}});
}
