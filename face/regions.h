// SPDX-License-Identifier: MIT
// The part of a mesh that a run must leave as it is.
#pragma once

#include <cstddef>

#include <tetmend/improve.h>

#include "kernel/tet_mesh.h"

namespace tetmend::face {

/// @throws OptionError with the valid forms when a region of `protect` or `only` has none of them.
void check_regions(const Options& options);

/// @throws OptionError that names the region when no tet has one of its labels or lies in its box.
void find_regions(const MeshData& data, const Options& options);

/// What protect() did. A tet may be one of both kinds.
struct ProtectedPart {
  std::size_t tets = 0;            ///< in regions
  std::size_t bad_tets = 0;        ///< of them
  std::size_t layer_tets = 0;      ///< in boundary layers
  std::size_t layer_bad_tets = 0;  ///< of them
};

/// Freezes what the options protect: regions, and boundary layers unless they are to be improved.
ProtectedPart protect(TetMesh& mesh, const Options& options);

}  // namespace tetmend::face
