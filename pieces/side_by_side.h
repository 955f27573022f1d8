// SPDX-License-Identifier: MIT
// Pieces of a mesh, several at a time.
#pragma once

#include <cstddef>
#include <functional>

namespace tetmend::pieces {

/// How many pieces are worked on at a time. What comes of a piece must not depend on that.
class SideBySide {
 public:
  /// @param most  at a time; 1: one after another, each on all threads
  explicit SideBySide(std::size_t most = 1) : most_(most) {}

  /// Made of a piece: to be put where those of others are put, too.
  using Use = std::function<void()>;
  /// Calls make(i) for each i below `count`, in this order but at a time, and what it returns on this
  /// thread, in any order. The threads of the caller's arena are dealt out to those at work; more than
  /// these are never at a time. What is made waits until it is used: no more than `most` do.
  /// @throws what make() threw for the least i, or what it returned; the rest is not begun then
  void each(std::size_t count, const std::function<Use(std::size_t)>& make) const;

 private:
  std::size_t most_;
};

}  // namespace tetmend::pieces
