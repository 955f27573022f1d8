// SPDX-License-Identifier: MIT
// Why tets are inverted or flat.
#pragma once

#include <cstddef>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// Tets that are not positive, each counted once, for the first reason that holds.
struct InvertedTets {
  std::size_t frozen = 0;  ///< it must stay as it is
  std::size_t fixed = 0;   ///< its vertices all stay in their places
  std::size_t sealed = 0;  ///< none of its vertices, alone, sees all of its link from anywhere
  std::size_t open = 0;    ///< one has a place, but other tets got worse there, or nobody tried

  std::size_t all() const { return frozen + fixed + sealed + open; }
};

/// By quality. Cost: one scan, and some 20 microseconds for each free vertex of what is found; linear in
/// the star of a large one.
InvertedTets count_inverted(const TetMesh& mesh);

}  // namespace tetmend
