// SPDX-License-Identifier: MIT
// Groups of items by key against a sort by key and item.
#include "kernel/grouping.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include <doctest/doctest.h>

#include "tests/support/threads.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE(
    "items come by key, equal keys in ascending order, for every number of items and threads") {
  std::mt19937 random(7);
  for (const std::size_t items : {0, 1, 2, 4095, 4096, 65535, 65536, 65537, 200000}) {
    for (const std::uint32_t keys : {1u, 2u, 511u, 512u, 513u, 70000u}) {
      CAPTURE(items);
      CAPTURE(keys);
      std::vector<std::uint32_t> key(items);
      for (std::uint32_t& k : key) k = static_cast<std::uint32_t>(random()) % keys;
      std::vector<std::uint32_t> order(items);
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(key[a], a) < std::pair(key[b], b);
      });
      for (const int threads : {1, 4}) {
        const Grouping grouping = on_threads(threads, [&] { return group_by_key(key, keys); });
        CHECK(grouping.order == order);
        REQUIRE(grouping.begin.size() == keys + 1);
        std::size_t wrong = 0;
        for (std::uint32_t k = 0; k < keys; ++k) {
          for (const std::uint32_t item : grouping.group(k)) wrong += key[item] != k;
        }
        CHECK(wrong == 0);
        CHECK(grouping.begin.front() == 0);
        CHECK(grouping.begin.back() == items);
      }
    }
  }
}
