// SPDX-License-Identifier: MIT
// A part of a mesh that is cut out, worked on as a mesh of its own, and put back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"
#include "kernel/workspace.h"

namespace tetmend {

/// Tets of one region that hang together by faces without a constraint. None is frozen.
struct Neighbourhood {
  std::vector<TetHandle> tets;         ///< the first is that in the middle
  std::vector<VertexHandle> vertices;  ///< of them, each once
  std::vector<char> stays;             ///< by vertex: fixed, or on the border
};

/// Which neighbourhood, from 1 on, has a tet; 0: none.
using NeighbourhoodMarks = std::vector<std::uint32_t>;

/// What lies less than `rings` edges from the tet and is in no other neighbourhood; at most about
/// `most` tets. Marks them by `number`. Cost: linear in the tets around.
Neighbourhood find_neighbourhood(const TetMesh& mesh, Workspace& workspace, TetHandle middle,
                                 unsigned rings, std::size_t most, std::uint32_t number,
                                 NeighbourhoodMarks& marks);

/// A copy with numbers of its own. Constraints come along; the border is surface.
struct NeighbourhoodCopy {
  MeshData data;
  std::vector<std::uint32_t> vertex;  ///< by point of the data: the number in the neighbourhood
};

/// @param variant 0: in the order of the neighbourhood; others: each in an order of its own
NeighbourhoodCopy copy_neighbourhood(const TetMesh& mesh, const Neighbourhood& neighbourhood,
                                     const NeighbourhoodMarks& marks, std::uint32_t variant);

}  // namespace tetmend
