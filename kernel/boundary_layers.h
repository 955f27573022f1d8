// SPDX-License-Identifier: MIT
// Layers of prisms along walls, each prism cut into three tets: wanted though their tets are bad.
//
//      ___________ core          A column is the stack of prisms over one triangle of a wall. Its
//     /\    /\    /              lines lead from the corners of the triangle into the mesh. Heights
//    /__\__/__\__/  3 prisms     grow from prism to prism, up to a core of other tets.
//    |  |\ |  | /|
//    |__|_\|__|/_|  2                  a wall triangle a b c; its three tets in a row:
//    |_\|__|\_|__|  1                  a b c A, then b c A B, then c A B C. Each replaces one
//    ============== wall               corner of the front by the vertex above it.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// All boundary layers of a mesh.
struct BoundaryLayers {
  std::vector<TetHandle> tets;  ///< ascending
  std::size_t columns = 0;      ///< triangles of walls with prisms above
  std::size_t most_prisms = 0;  ///< of a column
};

/// Finds boundary layers by their structure. Walls are boundary and constrained faces. A column counts
/// if its first prism is flat, its lines are about normal to the wall and straight, and its heights
/// grow by a bounded factor. A layer is a patch of columns that agree on their lines, and what lies
/// above them is thicker: a lattice that is stretched throughout has no layer. Next to these
/// columns, tets count as far as their vertices follow the same lines.
///
/// The answer does not depend on the order of vertices and tets. Where no bad tet lies flat on a
/// wall, that is one scan. Cost: linear, but for sorting the lines.
BoundaryLayers find_boundary_layers(const TetMesh& mesh);

}  // namespace tetmend
