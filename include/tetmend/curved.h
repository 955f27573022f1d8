// SPDX-License-Identifier: MIT
// Figures of curved tets: those of second order with a mid-side node beside the middle of its edge.
#pragma once

#include <cstddef>

#include <tetmend/language.h>

namespace tetmend {

/// Least by greatest Jacobian determinant of the map from a straight tet: 1 for a straight one, 0 or
/// less for one that is turned over, at least -1.
struct JacobianRatio {
  double at_nodes = 1;  ///< over its ten nodes, as Gmsh measures it
  double bound = 1;     ///< no more than over the whole tet: by Bezier coefficients
};

/// What the tets of a mesh of second order are like.
struct CurvedStatistics {
  std::size_t mid_nodes = 0;    ///< of all edges, curved or not
  std::size_t curved = 0;       ///< tets with a curved edge
  std::size_t turned_over = 0;  ///< of them: the Jacobian is not positive at one of the ten nodes
  JacobianRatio worst;          ///< each figure by itself
};

}  // namespace tetmend
