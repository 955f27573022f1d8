// SPDX-License-Identifier: MIT
// The same mesh in another order: what the last few tets come to is luck, so one run says little.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/mesh_data.h"
#include "tests/support/zoo.h"

namespace tetmend::test {

/// Vertices in another order, each tet from another vertex on.
inline MeshData renumbered(const MeshData& data, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> number(data.points.size());
  std::iota(number.begin(), number.end(), 0u);
  for (std::size_t i = number.size(); i > 1; --i) {
    std::swap(number[i - 1], number[random.index(i)]);
  }
  MeshData other = data;
  for (std::size_t v = 0; v < number.size(); ++v) other.points[number[v]] = data.points[v];
  for (MeshData::Triangle& triangle : other.triangles) {
    for (std::uint32_t& v : triangle.vertices) v = number[v];
  }
  for (MeshData::Tet& tet : other.tets) {
    for (std::uint32_t& v : tet.vertices) v = number[v];
    const auto turns = static_cast<std::ptrdiff_t>(random.index(4));
    std::rotate(tet.vertices.begin(), tet.vertices.begin() + turns, tet.vertices.end());
  }
  return other;
}

}  // namespace tetmend::test
