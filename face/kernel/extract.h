// SPDX-License-Identifier: MIT
// A part of a program's mesh as a mesh of its own.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include <tetmend/api.h>

#include "face/kernel/tet_mesh.h"

namespace tetmend::kernel {

/// These tets as a mesh: with their points in the order of to_mesh(), labels, data, groups and
/// mid-side nodes, and with the named triangles and edges of these tets. A note says what else was
/// there. @throws Error for a tet that is deleted or was never there
TETMEND_API Mesh extract(const TetMesh& mesh, std::span<const TetHandle> tets);

/// The tets for which is_wanted(TetHandle) is true.
template <std::predicate<TetHandle> IsWanted>
Mesh extract(const TetMesh& mesh, const IsWanted& is_wanted) {
  std::vector<TetHandle> wanted;
  for (const TetHandle t : mesh.tets()) {
    if (is_wanted(t)) wanted.push_back(t);
  }
  return extract(mesh, std::span<const TetHandle>(wanted));
}

}  // namespace tetmend::kernel
