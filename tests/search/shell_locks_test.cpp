// SPDX-License-Identifier: MIT
#include "search/shell_locks.h"

#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;

namespace {

using LockedEdge = std::array<VertexHandle, 2>;

/// The shell of 0 1 with the ring 2 .. 6.
ShellLocks locks(const std::vector<LockedEdge>& ancestors) {
  const std::vector<VertexHandle> ring = {VertexHandle(2), VertexHandle(3), VertexHandle(4),
                                          VertexHandle(5), VertexHandle(6)};
  return lock_ancestors(VertexHandle(0), VertexHandle(1), ring, ancestors);
}

LockedEdge edge(std::uint32_t x, std::uint32_t y) {
  return {VertexHandle(x), VertexHandle(y)};
}

}  // namespace

TEST_CASE("an ancestor that is a link edge locks its ring vertex") {
  CHECK(locks({edge(0, 2), edge(5, 1)}).vertices == 0b01001);
  CHECK(locks({edge(0, 2), edge(5, 1)}).edges == 0);
}

TEST_CASE("an ancestor that is a side of the ring locks that side, whichever way it is named") {
  CHECK(locks({edge(3, 4)}).edges == 0b00010);
  CHECK(locks({edge(4, 3)}).edges == 0b00010);
  CHECK(locks({edge(2, 6)}).edges == 0b10000);
  CHECK(locks({edge(3, 4)}).vertices == 0);
}

TEST_CASE("the edge itself, chords and edges elsewhere lock nothing") {
  CHECK_FALSE(
      locks({edge(0, 1), edge(1, 0), edge(2, 4), edge(3, 9), edge(1, 9), edge(8, 9)}).any());
  CHECK_FALSE(locks({}).any());
}
