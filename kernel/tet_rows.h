// SPDX-License-Identifier: MIT
// The points of a mesh's tets in rows, for figures of a whole mesh that are computed four tets at a
// time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/tet_mesh.h"
#include "kernel/wide.h"

namespace tetmend {

/// Some points each of a number of things, such as the four of a tet: point p of thing i has its
/// coordinates in the rows 3 p to 3 p + 2 of group i / kWideLanes.
template <std::size_t Points>
class PointRows {
 public:
  static constexpr std::size_t kMost = 128;  ///< things; they stay in the first cache
  using Group = WideRows<3 * Points>;

  bool is_full() const { return size_ == kMost; }
  std::size_t size() const { return size_; }
  std::size_t groups() const { return (size_ + kWideLanes - 1) / kWideLanes; }
  const Group& group(std::size_t n) const { return groups_[n]; }
  void clear() { size_ = 0; }
  /// Precondition: not full.
  void add(const std::array<const Point*, Points>& points) {
    auto& of = groups_[size_ / kWideLanes].of;
    const std::size_t lane = size_ % kWideLanes;
    for (std::size_t p = 0; p < Points; ++p) {
      of[3 * p][lane] = points[p]->x();
      of[3 * p + 1][lane] = points[p]->y();
      of[3 * p + 2][lane] = points[p]->z();
    }
    ++size_;
  }
  /// Lanes that are left over repeat a thing, so that they hold numbers without harm.
  void pad() {
    for (std::size_t lane = size_; lane % kWideLanes != 0; ++lane) {
      for (auto& row : groups_[size_ / kWideLanes].of) row[lane % kWideLanes] = row[0];
    }
  }

 private:
  std::size_t size_ = 0;
  std::array<Group, kMost / kWideLanes> groups_;
};

/// In each lane the larger number; that of p if one is none.
TETMEND_WIDE_INLINE WideVector larger(const WideVector& p, const WideVector& q) {
  return p < q ? q : p;
}

/// Point p of the things of a group.
template <std::size_t Rows>
TETMEND_WIDE_INLINE WidePoint wide_point(const WideRows<Rows>& group, std::size_t p) {
  const WideVector* rows = group.vectors() + 3 * p;
  return {rows[0], rows[1], rows[2]};
}

/// True in the lanes of group n that are no repetitions.
template <std::size_t Points>
TETMEND_WIDE_INLINE auto lanes_in_use(const PointRows<Points>& rows, std::size_t n) {
  const WideVector lane = {0, 1, 2, 3};
  return lane < static_cast<double>(rows.size()) - static_cast<double>(kWideLanes * n);
}

/// Live tets and their points.
struct TetRows {
  PointRows<4> points;
  std::array<TetHandle, PointRows<4>::kMost> tets;
};

/// Calls use(TetRows) for the live tets among every step-th slot of a range, in their order.
template <class Use>
void visit_rows(const TetMesh& mesh, std::size_t begin, std::size_t end, std::size_t step,
                const Use& use) {
  TetRows rows;
  for (std::size_t slot = begin; slot < end; slot += step) {
    const TetHandle t(static_cast<std::uint32_t>(slot));
    if (mesh.is_deleted(t)) continue;
    const TetVertices& v = mesh.vertices(t);
    rows.tets[rows.points.size()] = t;
    rows.points.add({&mesh.point(v[0]), &mesh.point(v[1]), &mesh.point(v[2]), &mesh.point(v[3])});
    if (!rows.points.is_full()) continue;
    use(rows);
    rows.points.clear();
  }
  if (rows.points.size() == 0) return;
  rows.points.pad();
  use(rows);
}

}  // namespace tetmend
