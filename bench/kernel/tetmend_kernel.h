// SPDX-License-Identifier: MIT
// The tasks of task.h by <tetmend/kernel.h>.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/kernel/task.h"
#include "face/kernel/transaction.h"

namespace tetmend::bench {

template <bool IsSorted>
class TetmendKernel {
 public:
  using List = std::span<const std::array<std::uint32_t, 2>>;

  explicit TetmendKernel(const Arrays& arrays)
      : mesh_(kernel::PointView(std::span(arrays.points)), arrays.tets) {
    if constexpr (IsSorted) slot_ = mesh_.sort_spatially().vertices;
  }

  double volume() const {
    double sum = 0;
    for (const TetHandle t : mesh_.tets()) {
      const auto p = mesh_.points(t);
      sum += volume6(p[0], p[1], p[2], p[3]);
    }
    return sum / 6;
  }
  std::size_t neighbours() const {
    std::size_t sum = 0;
    for (const TetHandle t : mesh_.tets()) {
      for (const TetHandle n : mesh_.neighbours(t)) sum += n < t ? 1 : 0;
    }
    return 2 * sum;
  }
  std::size_t stars() const {
    std::size_t sum = 0;
    for (const VertexHandle v : mesh_.vertices()) sum += mesh_.star(v).size();
    return sum;
  }
  std::size_t one_rings() const {
    std::size_t sum = 0;
    for (const VertexHandle v : mesh_.vertices()) sum += mesh_.one_ring(v).size();
    return sum;
  }
  std::size_t edges() { return edges_.emplace_back(mesh_.edges()).size(); }
  std::size_t rings() const {
    std::size_t sum = 0;
    for (const TetEdge e : edges_.back()) sum += mesh_.ring(e).tets.size();
    return sum;
  }
  void add_property() { mesh_.tet_property<double>("x"); }
  std::size_t flip(List list) { return flip(list, true); }
  std::size_t flip_and_undo(List list) { return flip(list, false); }
  std::size_t contract(List list) { return contract(list, true); }
  std::size_t contract_and_undo(List list) { return contract(list, false); }

 private:
  VertexHandle vertex(std::uint32_t number) const {
    return VertexHandle(slot_.empty() ? number : slot_[number]);
  }
  std::size_t flip(List list, bool keeps) {
    std::size_t made = 0;
    for (const auto& [a, b] : list) {
      const auto edge = mesh_.find_edge(vertex(a), vertex(b));
      kernel::Transaction edit(mesh_);
      if (!edge || edit.flip_3_2(*edge) != EditResult::made) continue;
      ++made;
      if (keeps) edit.keep();
    }
    return made;
  }
  std::size_t contract(List list, bool keeps) {
    std::size_t made = 0;
    for (const auto& [gone, stays] : list) {
      kernel::Transaction edit(mesh_);
      if (edit.contract(vertex(gone), vertex(stays)) != EditResult::made) continue;
      ++made;
      if (keeps) edit.keep();
    }
    return made;
  }

  kernel::TetMesh mesh_;
  std::vector<std::uint32_t> slot_;  // by number; empty: the same
  std::vector<kernel::Edges> edges_;
};

}  // namespace tetmend::bench
