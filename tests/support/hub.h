// SPDX-License-Identifier: MIT
// A vertex of many tets.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "kernel/mesh_data.h"

namespace tetmend::test {

/// Vertex 0 inside a double cone with a ring of n vertices: a star of 2 n tets, and two shells of n
/// tets, around the edges to the tips 1 and 2. All other vertices lie on the boundary.
inline MeshData hub(std::uint32_t n) {
  MeshData data;
  data.points = {{0.1, 0.05, 0.02}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    data.points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t p = 3 + i;
    const std::uint32_t q = 3 + (i + 1) % n;
    data.tets.push_back({{0, 1, q, p}});
    data.tets.push_back({{0, 2, p, q}});
  }
  return data;
}

}  // namespace tetmend::test
