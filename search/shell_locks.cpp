// SPDX-License-Identifier: MIT
#include "search/shell_locks.h"

#include <algorithm>
#include <cstddef>

namespace tetmend {

ShellLocks lock_ancestors(VertexHandle a, VertexHandle b, std::span<const VertexHandle> ring,
                          std::span<const std::array<VertexHandle, 2>> ancestors) {
  ShellLocks locks;
  const std::size_t m = ring.size();
  const auto position = [&](VertexHandle v) {
    return static_cast<std::size_t>(std::find(ring.begin(), ring.end(), v) - ring.begin());
  };
  for (const auto& [x, y] : ancestors) {
    const bool x_end = x == a || x == b;
    const bool y_end = y == a || y == b;
    if (x_end && y_end) continue;
    if (x_end || y_end) {
      const std::size_t i = position(x_end ? y : x);
      if (i < m) locks.vertices |= 1u << i;
      continue;
    }
    const std::size_t i = position(x);
    const std::size_t j = position(y);
    if (i == m || j == m) continue;
    if ((i + 1) % m == j) locks.edges |= 1u << i;
    if ((j + 1) % m == i) locks.edges |= 1u << j;
  }
  return locks;
}

}  // namespace tetmend
