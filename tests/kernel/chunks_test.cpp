// SPDX-License-Identifier: MIT
// Loops in chunks: each index once, results in order.
#include "kernel/chunks.h"

#include <numeric>

#include <doctest/doctest.h>

#include "tests/support/threads.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("chunks cover each index once, also where sizes straddle their borders") {
  for (const std::size_t size : {0, 1, 9, 10, 11, 99, 100, 101}) {
    for (const int threads : {1, 4}) {
      CAPTURE(size);
      std::vector<int> met(size, 0);
      on_threads(threads, [&] {
        for_chunks(
            size,
            [&](std::size_t begin, std::size_t end) {
              for (std::size_t i = begin; i < end; ++i) ++met[i];
            },
            10);
      });
      CHECK(met == std::vector<int>(size, 1));
    }
  }
}

TEST_CASE("results of chunks are in the order of the chunks") {
  const auto begins = on_threads(4, [] {
    return map_chunks<std::size_t>(
        25, [](std::size_t begin, std::size_t end) { return 100 * begin + end; }, 10);
  });
  CHECK(begins == std::vector<std::size_t>{10, 1020, 2025});
}
