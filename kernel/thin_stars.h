// SPDX-License-Identifier: MIT
// Which stars need a walk before a change is known to keep the stable step.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "kernel/handles.h"
#include "kernel/solver_rulers.h"

namespace tetmend {

/// The vertices around which some tet, of now or once proposed, would alone allow less than a step. All
/// others keep the step as long as no such tet is added: mass and stiffness of a vertex are sums over
/// its tets. Vertices that came later count as thin. An entry too many costs time and changes no result, so
/// none is ever taken out. Any thread may ask and add.
class ThinStars {
 public:
  /// @param step2 squared, see stable_step()
  explicit ThinStars(const TetMesh& mesh, double step2);

  /// True for a corner whose tet would alone allow less than the step, or hardly more.
  static bool is_thin(const P1Diagonal& tet, std::size_t corner, double step2) {
    constexpr double kRounding = 1e-9;
    return !(tet.mass * (1 - kRounding) >= step2 * tet.stiffness[corner]);
  }

  void add(VertexHandle v) {
    if (v.index() < size_) marks_[v.index()].store(1, std::memory_order_relaxed);
  }
  bool contains(VertexHandle v) const {
    return v.index() >= size_ || marks_[v.index()].load(std::memory_order_relaxed) != 0;
  }

 private:
  std::size_t size_;
  std::unique_ptr<std::atomic<std::uint8_t>[]> marks_;
};

}  // namespace tetmend
