// SPDX-License-Identifier: MIT
// Where parts of a mesh touch without being joined.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend {

struct UnjoinedPoints {
  std::size_t coincident =
      0;  ///< vertices with the coordinates of another one: all but one of each
  /// Vertices on a face or an edge of the boundary that does not have them, to 1e-7 of its length.
  std::size_t hanging = 0;
};

/// Of the vertices on the boundary. Cost: n log n in their number.
UnjoinedPoints find_unjoined(const TetMesh& mesh);

/// Says so, in sentences.
std::vector<std::string> describe(const UnjoinedPoints& points, std::size_t of_all);

}  // namespace tetmend
