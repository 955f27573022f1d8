// SPDX-License-Identifier: MIT
// The faces of a mesh that a file describes: is each the face of one tet a side?
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "kernel/handles.h"

namespace tetmend {

/// Open addressing. The hash has a part that no file can know, so that none makes the table slow.
class TetFaces {
 public:
  TetFaces() : salt_((std::uint64_t{std::random_device()()} << 32) | std::random_device()()) {}

  /// Room for so many faces.
  void reserve(std::size_t faces) {
    const std::size_t size = size_for(faces);
    if (size > entries_.size()) rehash(size);
  }
  /// False if the face has a tet on this side already.
  bool add(const TetVertices& tet, unsigned face) {
    const auto [key, side] = key_of(tet, face);
    Entry& entry = entry_of(key);
    const bool is_new = (entry.sides & side) == 0;
    entry.sides |= side;
    return is_new;
  }
  /// To take so many faces. What follows costs as much as these, and what one large cavity took is
  /// given back.
  void clear(std::size_t faces) {
    constexpr std::size_t kKept = 1024;
    const std::size_t size = size_for(faces);
    if (entries_.capacity() > std::max(kKept, size)) entries_ = {};
    entries_.assign(size, Entry());
    used_ = 0;
  }

 private:
  friend class EditedFaces;
  using Key = std::array<std::uint32_t, 3>;  // sorted
  static constexpr std::size_t kLeast = 16;
  static constexpr std::uint32_t kFree = 4;

  struct Entry {
    Key key{};
    std::uint32_t sides = kFree;  // bits: a tet that lists it evenly, one that does not
    bool is_there() const { return sides != 0 && sides != kFree; }
  };

  static std::size_t size_for(std::size_t faces) {
    std::size_t size = kLeast;
    while (2 * size < 3 * faces) size *= 2;
    return size;
  }
  static std::pair<Key, std::uint32_t> key_of(const TetVertices& tet, unsigned face) {
    const auto& local = kFaceVertices[face];
    Key key = {tet[local[0]].index(), tet[local[1]].index(), tet[local[2]].index()};
    std::uint32_t side = 1;
    const auto order = [&](std::size_t i, std::size_t j) {
      if (key[i] <= key[j]) return;
      std::swap(key[i], key[j]);
      side = 3 - side;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return {key, side};
  }
  std::size_t place_of(const Key& key) const {
    std::uint64_t mixed = salt_;
    for (const std::uint32_t v : key) {
      mixed = (mixed ^ v) * 0x9E3779B97F4A7C15u;
      mixed ^= mixed >> 32;
    }
    std::size_t i = mixed & (entries_.size() - 1);
    while (entries_[i].sides != kFree && !is_same(entries_[i].key, key))
      i = (i + 1) & (entries_.size() - 1);
    return i;
  }
  /// Three comparisons; that of arrays is a call of the C library.
  static bool is_same(const Key& a, const Key& b) {
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
  }
  /// Its entry, which may be new and then has no tet on any side.
  Entry& entry_of(const Key& key) {
    if (4 * (used_ + 1) > 3 * entries_.size()) make_room();
    Entry& entry = probe(key);
    if (entry.sides == kFree) {
      entry = {key, 0};
      ++used_;
    }
    return entry;
  }
  Entry& probe(const Key& key) { return entries_[place_of(key)]; }
  std::uint32_t sides_of(const Key& key) const { return entries_[place_of(key)].sides; }
  std::uint32_t bits_of(const Key& key) const { return sides_of(key) & 3u; }
  void make_room() {
    const auto live = static_cast<std::size_t>(
        std::count_if(entries_.begin(), entries_.end(), std::mem_fn(&Entry::is_there)));
    rehash(2 * live > entries_.size() ? 2 * entries_.size() : entries_.size());
  }
  /// Forgets the faces without a tet.
  void rehash(std::size_t size) {
    const std::vector<Entry> old = std::exchange(entries_, std::vector<Entry>(size));
    used_ = 0;
    for (const Entry& entry : old) {
      if (!entry.is_there()) continue;
      probe(entry.key) = entry;
      ++used_;
    }
  }

  std::uint64_t salt_;
  std::vector<Entry> entries_ = std::vector<Entry>(kLeast);
  std::size_t used_ = 0;
};

}  // namespace tetmend
