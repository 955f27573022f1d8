// SPDX-License-Identifier: MIT
// What a search in a recursion must leave alone, because its callers are at work there.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernel/handles.h"

namespace tetmend {

/// Ancestor edges in the form that a search takes, see CoveringProblem.
struct ShellLocks {
  std::uint32_t vertices = 0;
  std::uint32_t edges = 0;

  bool any() const { return (vertices | edges) != 0; }
};

/// Locks for the shell of ab with this ring, so that none of `ancestors`, the edges that the callers
/// are to remove, gets a new supporting face ([chen, 5.3 (2)]). Ancestors that do not touch the
/// shell lock nothing. Precondition: at most 32 vertices in the ring.
ShellLocks lock_ancestors(VertexHandle a, VertexHandle b, std::span<const VertexHandle> ring,
                          std::span<const std::array<VertexHandle, 2>> ancestors);

}  // namespace tetmend
