// SPDX-License-Identifier: MIT
// A small set of indices that is emptied in constant time: visit marks without an array as large as
// the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetmend {

/// Open addressing; an entry counts only if it carries the current stamp. Allocates only when it
/// grows beyond its largest size so far.
class IndexSet {
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
    std::uint64_t& slot = probe(index);
    if (slot == entry(index)) return false;
    slot = entry(index);
    if (++size_ * 2 > slots_.size()) grow();
    return true;
  }
  bool contains(std::uint32_t index) const {
    return const_cast<IndexSet*>(this)->probe(index) == entry(index);
  }
  std::size_t size() const { return size_; }

 private:
  std::uint64_t entry(std::uint32_t index) const {
    return (static_cast<std::uint64_t>(stamp_) << 32) | index;
  }
  /// The slot that holds the index, or the free slot where it belongs.
  std::uint64_t& probe(std::uint32_t index) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (index * 0x9E3779B97F4A7C15ull >> 40) & mask;
    while (slots_[i] >> 32 == stamp_ && slots_[i] != entry(index)) i = (i + 1) & mask;
    return slots_[i];
  }
  void grow() {
    const std::vector<std::uint64_t> old = slots_;
    slots_.assign(old.size() * 2, 0);
    for (const std::uint64_t slot : old) {
      if (slot >> 32 == stamp_) probe(static_cast<std::uint32_t>(slot)) = slot;
    }
  }

  std::vector<std::uint64_t> slots_;  // stamp << 32 | index
  std::uint32_t stamp_ = 1;
  std::size_t size_ = 0;
};

}  // namespace tetmend
