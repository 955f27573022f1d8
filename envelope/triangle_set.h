// SPDX-License-Identifier: MIT
// Triangles by the places of their corners: is one of them among those?
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// Triangles with a sense; which corner is the first does not matter.
class TriangleSet {
 public:
  using Corners = std::array<Point, 3>;

  TriangleSet() = default;
  /// Cost: sorting.
  explicit TriangleSet(std::vector<Corners> triangles);

  bool contains(const Corners& triangle) const;
  /// In lexicographic order.
  std::span<const Corners> list() const { return triangles_; }

 private:
  std::vector<Corners> triangles_;
};

}  // namespace tetmend
