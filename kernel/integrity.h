// SPDX-License-Identifier: MIT
// Is the mesh what it claims to be? Findings instead of a yes or no.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// One thing that is wrong. Handles are invalid where they do not apply.
struct Finding {
  enum class Kind : std::uint8_t {
    adjacency,    ///< neighbours do not point back or do not share the face
    orientation,  ///< neighbours list their common face in the same sense
    vertex_link,  ///< a vertex names a tet that does not contain it
    boundary,     ///< boundary faces and surface triangles disagree
    constraint,   ///< constraint marks and surface triangles disagree
    label,        ///< two labels meet without a constrained face
    quality,      ///< a cached quality is not what the points give
    count         ///< the number of live slots is wrong
  };
  Kind kind;
  TetHandle tet;
  VertexHandle vertex;
  std::string message;
};

/// All findings, empty for a sound mesh. Positive volume is not asked for: inverted input is allowed (see exact_orientation.h).
/// Cost: linear.
std::vector<Finding> check_integrity(const TetMesh& mesh);

}  // namespace tetmend
