// SPDX-License-Identifier: MIT
// Stable counting sort in two steps, each of which writes to few places at a time.
//
//   blocks of neighbouring keys: count in chunks of items, then move each item to its block
//   within each block: count by key, then move each item to its key
#include "kernel/grouping.h"

#include <algorithm>

#include "kernel/chunks.h"

namespace tetmend {

namespace {

constexpr std::size_t kMostBlocks = 512;
constexpr std::size_t kItemsOfBlock = 4096;  // worth a task
constexpr std::size_t kItemsOfChunk = std::size_t{1} << 16;

/// The items by blocks of 2^shift keys; starts[b] is the first of block b.
std::vector<std::uint32_t> move_to_blocks(std::span<const std::uint32_t> key, unsigned shift,
                                          std::vector<std::uint32_t>& starts) {
  const std::size_t blocks = starts.size() - 1;
  auto places = map_chunks<std::vector<std::uint32_t>>(
      key.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> count(blocks, 0);
        for (std::size_t i = begin; i < end; ++i) ++count[key[i] >> shift];
        return count;
      },
      kItemsOfChunk);
  std::uint32_t next = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    starts[block] = next;
    for (auto& place : places) {
      const std::uint32_t count = place[block];
      place[block] = next;
      next += count;
    }
  }
  starts[blocks] = next;
  std::vector<std::uint32_t> items(key.size());
  for_chunks(
      key.size(),
      [&](std::size_t begin, std::size_t end) {
        auto& place = places[begin / kItemsOfChunk];
        for (std::size_t i = begin; i < end; ++i) {
          items[place[key[i] >> shift]++] = static_cast<std::uint32_t>(i);
        }
      },
      kItemsOfChunk);
  return items;
}

}  // namespace

Grouping group_by_key(std::span<const std::uint32_t> key, std::uint32_t keys) {
  Grouping result;
  result.order.resize(key.size());
  result.begin.assign(std::size_t{keys} + 1, 0);
  const std::size_t most = std::clamp<std::size_t>(key.size() / kItemsOfBlock, 1, kMostBlocks);
  unsigned shift = 0;
  while ((std::size_t{keys} >> shift) >= most) ++shift;
  std::vector<std::uint32_t> starts((std::size_t{keys} >> shift) + 2);
  const std::vector<std::uint32_t> items = move_to_blocks(key, shift, starts);
  const auto order_block = [&](std::size_t block, std::size_t) {
    const std::size_t first = block << shift;
    const std::size_t last = std::min<std::size_t>(keys, first + (std::size_t{1} << shift));
    std::vector<std::uint32_t> place(last - first + 1, 0);
    for (std::uint32_t i = starts[block]; i < starts[block + 1]; ++i)
      ++place[key[items[i]] - first];
    std::uint32_t next = starts[block];
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t count = place[k - first];
      result.begin[k] = place[k - first] = next;
      next += count;
    }
    for (std::uint32_t i = starts[block]; i < starts[block + 1]; ++i) {
      result.order[place[key[items[i]] - first]++] = items[i];
    }
  };
  for_chunks(starts.size() - 1, order_block, 1);
  result.begin[keys] = static_cast<std::uint32_t>(key.size());
  return result;
}

}  // namespace tetmend
