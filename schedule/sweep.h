// SPDX-License-Identifier: MIT
// One sweep over many targets, on all threads. One thread works off each block of the mesh. What
// crosses a border is tried again with shifted blocks, and one thread alone tries what is left
// then.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/grouping.h"
#include "schedule/run.h"

namespace tetmend {

/// What lies in one block.
struct BlockLoad {
  BlockId block = 0;
  std::size_t begin = 0, end = 0;  ///< of the items
};

/// Runs `work` for each load in the territory of its block, the largest first, on the threads of
/// the current arena. Free slots are dealt out by the size of the loads, `new_vertices` for each
/// item. Nothing depends on the number of threads. If `work` throws, or memory runs out, the mesh is
/// in order before the first exception goes on.
void run_blocks(Run& run, PassScope& scope, Partition& partition, std::span<const BlockLoad> loads,
                double new_vertices, const std::function<void(Worker&, const BlockLoad&)>& work);

/// Fewer items than this are not worth a division into blocks.
inline constexpr std::size_t kFewItems = 8;

namespace detail {

/// The items sorted into loads by block; those that lie in no single block go to `rest`.
template <class Item>
std::vector<BlockLoad> divide(const Partition& partition, std::vector<Item>& items,
                              std::vector<Item>& rest) {
  const auto blocks = static_cast<std::uint32_t>(partition.block_count());
  std::vector<std::uint32_t> home(items.size());
  for_chunks(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto vertices = items[i].corners();
      const BlockId block = partition.block(vertices[0]);
      const bool whole = std::all_of(vertices.begin(), vertices.end(),
                                     [&](VertexHandle v) { return partition.block(v) == block; });
      home[i] = whole ? block : blocks;
    }
  });
  const Grouping groups = group_by_key(home, blocks + 1);
  std::vector<BlockLoad> loads;
  for (std::uint32_t b = 0; b < blocks; ++b) {
    if (groups.begin[b] < groups.begin[b + 1]) {
      loads.push_back({static_cast<BlockId>(b), groups.begin[b], groups.begin[b + 1]});
    }
  }
  const std::size_t divided = groups.begin[blocks];
  std::vector<Item> sorted(divided);
  rest.resize(items.size() - divided);
  for_chunks(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      (i < divided ? sorted[i] : rest[i - divided]) = items[groups.order[i]];
    }
  });
  items.swap(sorted);
  return loads;
}

/// Appends the items at the front of each load, up to `kept` of its block.
template <class Item>
void append_kept(const std::vector<Item>& items, std::span<const BlockLoad> loads,
                 std::span<const std::size_t> kept, std::vector<Item>& out) {
  std::vector<std::size_t> place = {out.size()};
  for (const BlockLoad& load : loads) place.push_back(place.back() + kept[load.block] - load.begin);
  out.resize(place.back());
  tbb::parallel_for(std::size_t{0}, loads.size(), [&](std::size_t n) {
    std::copy_n(items.begin() + static_cast<std::ptrdiff_t>(loads[n].begin),
                place[n + 1] - place[n], out.begin() + static_cast<std::ptrdiff_t>(place[n]));
  });
}

/// Works off a sorted range. Items that are to be tried again stay at its front; returns their end.
template <class Item, class TryItem>
std::size_t work_off_range(PassScope& scope, Worker& worker, std::vector<Item>& items,
                           std::size_t begin, std::size_t end, const TryItem& try_item) {
  worker.forget_tried();
  std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
            items.begin() + static_cast<std::ptrdiff_t>(end));
  std::size_t kept = begin;
  for (std::size_t i = begin; i < end && !worker.is_spent() && scope.proceed(i - begin); ++i) {
    Item item = items[i];
    if (item.is_there(worker.mesh()) && !try_item(worker, item)) items[kept++] = item;
  }
  return kept;
}

}  // namespace detail

/// Tries every item once where its neighbourhood is in one worker's hands: at most a few times.
/// An Item has `corners()`, the vertices whose territory it needs; `is_there(mesh)`; and `<`, a
/// total order in which items are tried. `try_item(worker, item)` is false if the attempt was
/// deferred; it may change the item to remember what is left to do.
template <class Item, class TryItem>
void work_off(Run& run, PassScope& scope, std::vector<Item> items, double new_vertices,
              const TryItem& try_item) {
  scope.expect(items.size());
  std::vector<Item> rest;
  for (unsigned shift = 0; shift < run.partition_count(); ++shift) {
    if (items.size() < kFewItems || run.cancelled()) break;
    Partition& partition = run.partition(scope, shift);
    std::vector<BlockLoad> loads;
    {
      const PassScope::Scan timed(scope);
      loads = detail::divide(partition, items, rest);
    }
    std::vector<std::size_t> kept(partition.block_count(), 0);
    run_blocks(run, scope, partition, loads, new_vertices,
               [&](Worker& worker, const BlockLoad& load) {
                 kept[load.block] =
                     detail::work_off_range(scope, worker, items, load.begin, load.end, try_item);
               });
    {
      const PassScope::Scan timed(scope);
      detail::append_kept(items, loads, kept, rest);
    }
    std::swap(items, rest);
    scope.note_deferred(items.size());
  }
  run.worker().set_most_attempts(run.attempts_left());
  detail::work_off_range(scope, run.worker(), items, 0, items.size(), try_item);
  if (run.worker().is_spent()) run.note_left_off();
  scope.take_verdicts(run.worker());
  run.note_added_vertices(run.worker());
}

/// Calls take(begin, end, out) for the chunks of 0..size; what it appends to `out` comes back in
/// the order of the chunks.
template <class Item, class Take>
std::vector<Item> collect(PassScope& scope, std::size_t size, const Take& take) {
  const PassScope::Scan timed(scope);
  auto parts = map_chunks<std::vector<Item>>(size, [&](std::size_t begin, std::size_t end) {
    std::vector<Item> part;
    take(begin, end, part);
    return part;
  });
  std::vector<std::size_t> place = {0};
  for (const auto& part : parts) place.push_back(place.back() + part.size());
  std::vector<Item> all(place.back());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t n) {
    std::copy(parts[n].begin(), parts[n].end(),
              all.begin() + static_cast<std::ptrdiff_t>(place[n]));
    std::vector<Item>().swap(parts[n]);
  });
  return all;
}

}  // namespace tetmend
