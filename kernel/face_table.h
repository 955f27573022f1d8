// SPDX-License-Identifier: MIT
// Pairs the faces of a cavity: a hash table from three vertices to a number, emptied in constant
// time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "kernel/handles.h"

namespace tetmend {

/// Open addressing with stamps, as IndexSet.
class TETMEND_API FaceTable {
 public:
  struct Entry {
    std::array<std::uint32_t, 3> key{};  // sorted
    std::uint32_t stamp = 0;
    std::uint32_t value = 0;
    bool even = false;  // sense in which the face lists its sorted vertices
    bool paired = false;
  };

  FaceTable() : slots_(256) {}

  void clear() {
    size_ = 0;
    if (++stamp_ == 0) {
      slots_.assign(slots_.size(), Entry());
      stamp_ = 1;
    }
  }

  /// The entry of that face, new (stamp just set, value undefined) or old. The flag tells which.
  /// Valid until the next call.
  std::pair<Entry*, bool> find_or_insert(std::array<VertexHandle, 3> face, bool& even) {
    std::array<std::uint32_t, 3> key = {face[0].index(), face[1].index(), face[2].index()};
    even = true;
    const auto order = [&](std::size_t i, std::size_t j) {
      if (key[i] > key[j]) {
        std::swap(key[i], key[j]);
        even = !even;
      }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    if ((size_ + 1) * 2 > slots_.size()) grow();
    Entry& entry = probe(key);
    if (entry.stamp == stamp_) return {&entry, false};
    entry = {key, stamp_, 0, even, false};
    ++size_;
    return {&entry, true};
  }

 private:
  Entry& probe(const std::array<std::uint32_t, 3>& key) {
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t mixed = (key[0] * 0x9E3779B97F4A7C15ull) ^
                                (key[1] * 0xC2B2AE3D27D4EB4Full) ^ (key[2] * 0x165667B19E3779F9ull);
    std::size_t i = (mixed >> 32) & mask;
    while (slots_[i].stamp == stamp_ && slots_[i].key != key) i = (i + 1) & mask;
    return slots_[i];
  }
  void grow() {
    const std::vector<Entry> old = std::exchange(slots_, std::vector<Entry>(slots_.size() * 2));
    for (const Entry& entry : old) {
      if (entry.stamp == stamp_) probe(entry.key) = entry;
    }
  }

  std::vector<Entry> slots_;
  std::uint32_t stamp_ = 1;
  std::size_t size_ = 0;
};

}  // namespace tetmend
