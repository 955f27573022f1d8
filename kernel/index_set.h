// SPDX-License-Identifier: MIT
// A small set of indices that is emptied in constant time: visit marks without an array as large as
// the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <tetmend/api.h>

namespace tetmend {

/// Open addressing; an entry counts only if it carries the current stamp. Allocates only when it
/// grows beyond its largest size so far.
class TETMEND_API IndexSet {
 public:
  IndexSet() : slots_(256, 0) {}

  void clear() {
    size_ = 0;
    if (++stamp_ == 0) {
      slots_.assign(slots_.size(), 0);
      stamp_ = 1;
    }
  }
  /// True if the index was not yet in the set.
  bool insert(std::uint32_t index) {
    const std::uint64_t wanted = entry(index);
    std::size_t i = home(index);
    for (; slots_[i] != wanted; i = (i + 1) & mask_) {
      if (is_used(slots_[i])) continue;
      slots_[i] = wanted;
      if (++size_ * 2 > mask_) grow();
      return true;
    }
    return false;
  }
  bool contains(std::uint32_t index) const {
    const std::uint64_t wanted = entry(index);
    std::size_t i = home(index);
    while (slots_[i] != wanted && is_used(slots_[i])) i = (i + 1) & mask_;
    return slots_[i] == wanted;
  }
  std::size_t size() const { return size_; }

 private:
  std::uint64_t entry(std::uint32_t index) const {
    return (static_cast<std::uint64_t>(stamp_) << 32) | index;
  }
  bool is_used(std::uint64_t slot) const { return slot >> 32 == stamp_; }
  /// Where the search for an index begins.
  std::size_t home(std::uint32_t index) const {
    return (index * 0x9E3779B97F4A7C15ull >> 40) & mask_;
  }
  void grow() {
    const std::vector<std::uint64_t> old =
        std::exchange(slots_, std::vector<std::uint64_t>(slots_.size() * 2, 0));
    mask_ = slots_.size() - 1;
    size_ = 0;
    for (const std::uint64_t slot : old) {
      if (is_used(slot)) insert(static_cast<std::uint32_t>(slot));
    }
  }

  std::vector<std::uint64_t> slots_;  // stamp << 32 | index; at least every other is free
  std::size_t mask_ = slots_.size() - 1;
  std::uint32_t stamp_ = 1;
  std::size_t size_ = 0;
};

/// A set of pairs of indices, likewise.
class TETMEND_API PairSet {
 public:
  PairSet() : slots_(256) {}

  void clear() {
    size_ = 0;
    if (++stamp_ == 0) {
      slots_.assign(slots_.size(), Slot());
      stamp_ = 1;
    }
  }
  /// True if the pair was not yet in the set. (a, b) and (b, a) are the same.
  bool insert(std::uint32_t a, std::uint32_t b) {
    Slot& slot = probe(key(a, b));
    if (slot.stamp == stamp_) return false;
    slot = {key(a, b), stamp_};
    if (++size_ * 2 > slots_.size()) grow();
    return true;
  }
  bool contains(std::uint32_t a, std::uint32_t b) const {
    return const_cast<PairSet*>(this)->probe(key(a, b)).stamp == stamp_;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t stamp = 0;
  };

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return a < b ? static_cast<std::uint64_t>(a) << 32 | b
                 : static_cast<std::uint64_t>(b) << 32 | a;
  }
  /// The slot that holds the key, or the free slot where it belongs.
  Slot& probe(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = ((key ^ key >> 29) * 0x9E3779B97F4A7C15ull >> 32) & mask;
    while (slots_[i].stamp == stamp_ && slots_[i].key != key) i = (i + 1) & mask;
    return slots_[i];
  }
  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(slots_.size() * 2));
    for (const Slot& slot : old) {
      if (slot.stamp == stamp_) probe(slot.key) = slot;
    }
  }

  std::vector<Slot> slots_;
  std::uint32_t stamp_ = 1;
  std::size_t size_ = 0;
};

}  // namespace tetmend
