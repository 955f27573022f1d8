// SPDX-License-Identifier: MIT
// Loops over index ranges in chunks of a fixed size, on as many threads as the caller's TBB arena
// has.
//
// Where chunks begin depends on sizes only, and results are put together in the order of the
// chunks. So the number of threads cannot show in any result, not even in sums of rounded numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

#include "kernel/first_failure.h"

namespace tetmend {

/// Large enough that starting a task costs little, small enough to keep many cores busy.
inline constexpr std::size_t kChunkSize = std::size_t{1} << 14;

inline std::size_t chunk_count(std::size_t size, std::size_t chunk_size = kChunkSize) {
  return (size + chunk_size - 1) / chunk_size;
}

/// body(begin, end) for each chunk of 0..size, in any order and possibly at once. An exception comes
/// out when all that have begun have ended; no other begins then.
template <class Body>
void for_chunks(std::size_t size, const Body& body, std::size_t chunk_size = kChunkSize) {
  const std::size_t chunks = chunk_count(size, chunk_size);
  const auto run = [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_size;
    body(begin, std::min(size, begin + chunk_size));
  };
  if (chunks == 1) return run(0);
  FirstFailure failure;
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    if (!failure.failed()) failure.guard([&] { run(chunk); });
  });
  failure.rethrow();
}

/// What body(begin, end) gives for each chunk, in the order of the chunks.
template <class Result, class Body>
std::vector<Result> map_chunks(std::size_t size, const Body& body,
                               std::size_t chunk_size = kChunkSize) {
  std::vector<Result> results(chunk_count(size, chunk_size));
  for_chunks(
      size,
      [&](std::size_t begin, std::size_t end) { results[begin / chunk_size] = body(begin, end); },
      chunk_size);
  return results;
}

/// The sum of what body(begin, end) counts in each chunk.
template <class Body>
std::size_t count_in_chunks(std::size_t size, const Body& body) {
  std::size_t sum = 0;
  for (const std::size_t count : map_chunks<std::size_t>(size, body)) sum += count;
  return sum;
}

}  // namespace tetmend
