// SPDX-License-Identifier: MIT
// Which events of a trace worked on a mesh that was undone afterwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tetmend {

/// Is told of edits and undos in their order. Nothing is undone across the border of a chunk.
class Trials {
 public:
  void begin_chunk() { open_.clear(); }
  void edit(std::uint64_t event) {
    open_.push_back(event);
    ++edits_;
  }
  /// Takes the last edit back that stands. Precondition: standing() > 0.
  void undo(std::uint64_t event);
  /// Edits of the chunk that stand.
  std::size_t standing() const { return open_.size(); }
  /// Of all chunks.
  std::size_t edits() const { return edits_; }
  std::size_t undos() const { return undos_; }

  /// The event changed a mesh, or looked at one, that an undo took back later. Cost: logarithmic.
  bool is_undone(std::uint64_t event) const;

 private:
  std::size_t edits_ = 0, undos_ = 0;
  std::vector<std::uint64_t> open_;
  /// From an edit to its undo; those inside others are left out.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> trials_;
};

}  // namespace tetmend
