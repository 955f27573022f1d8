// SPDX-License-Identifier: MIT
// All tets at given edges, found without walks: also where a star is not connected.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// The ends of an edge, ascending.
using EdgeEnds = std::array<VertexHandle, 2>;

inline EdgeEnds edge_ends(VertexHandle a, VertexHandle b) {
  return a < b ? EdgeEnds{a, b} : EdgeEnds{b, a};
}

/// A tet at one of several edges.
struct TetAtEdge {
  std::uint32_t number;  ///< of the edge
  TetEdge edge;          ///< as the tet names it
};

/// Every tet at every one of the edges, in the order of the tets. Precondition: the edges are
/// sorted and distinct. Cost: linear.
std::vector<TetAtEdge> find_tets_at(const TetMesh& mesh, std::span<const EdgeEnds> edges);

}  // namespace tetmend
