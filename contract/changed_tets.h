// SPDX-License-Identifier: MIT
// What differs between two states of a mesh, tet by tet.
#pragma once

#include <utility>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend::contract {

/// A tet by its vertices, sorted, and its quality: what did not change appears before and after.
using NamedTet = std::pair<TetVertices, Quality>;

/// The tets that are in one of two states alone, ascending.
struct ChangedTets {
  std::vector<NamedTet> before;
  std::vector<NamedTet> now;
};

/// Wherever they lie. Cost: linear in the mesh, n log n in the slots that differ.
ChangedTets changed_tets(const TetMesh& before, const TetMesh& now);

}  // namespace tetmend::contract
