// SPDX-License-Identifier: MIT
// All tets at given edges, found without walks: also where a star does not hang together.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// The ends of an edge, ascending.
using EdgeEnds = std::array<VertexHandle, 2>;

inline EdgeEnds edge_ends(VertexHandle a, VertexHandle b) {
  return a < b ? EdgeEnds{a, b} : EdgeEnds{b, a};
}

/// Calls visit(n, edge) for every tet that has the n-th of the edges, on all threads: calls for one
/// edge may come from several. Precondition: the edges are sorted and distinct.
/// Cost: linear, and a binary search for each edge of a tet between ends of the edges.
template <class Visit>
void visit_tets_at(const TetMesh& mesh, std::span<const EdgeEnds> edges, const Visit& visit) {
  std::vector<char> is_end(mesh.vertex_slots(), 0);
  for (const EdgeEnds& ends : edges) {
    for (const VertexHandle v : ends) is_end[v.index()] = 1;
  }
  for_chunks(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(i));
      if (mesh.is_deleted(t)) continue;
      for (unsigned e = 0; e < 6; ++e) {
        const auto [a, b] = mesh.vertices(TetEdge(t, e));
        if (!is_end[a.index()] || !is_end[b.index()]) continue;
        const auto found = std::lower_bound(edges.begin(), edges.end(), edge_ends(a, b));
        if (found == edges.end() || *found != edge_ends(a, b)) continue;
        visit(static_cast<std::size_t>(found - edges.begin()), TetEdge(t, e));
      }
    }
  });
}

}  // namespace tetmend
