// SPDX-License-Identifier: MIT
// All tets at given edges, in one pass over the mesh.
#include "kernel/edge_tets.h"

#include <algorithm>
#include <numeric>

#include "kernel/chunks.h"

namespace tetmend {

std::vector<TetAtEdge> find_tets_at(const TetMesh& mesh, std::span<const EdgeEnds> edges) {
  std::vector<char> is_end(mesh.vertex_slots(), 0);
  std::vector<std::uint32_t> first(mesh.vertex_slots() + 1, 0);  // of the edges, by lower end
  for (const auto& [low, high] : edges) {
    is_end[low.index()] = is_end[high.index()] = 1;
    ++first[low.index() + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  const auto append = [&](TetHandle t, unsigned e, std::vector<TetAtEdge>& out) {
    const auto corners = mesh.vertices(TetEdge(t, e));
    const EdgeEnds ends = edge_ends(corners[0], corners[1]);
    const auto end = edges.begin() + first[ends[0].index() + 1];
    const auto at = std::lower_bound(edges.begin() + first[ends[0].index()], end, ends);
    if (at == end || *at != ends) return;
    out.push_back({static_cast<std::uint32_t>(at - edges.begin()), TetEdge(t, e)});
  };
  const auto parts =
      map_chunks<std::vector<TetAtEdge>>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        std::vector<TetAtEdge> part;
        for (std::size_t i = begin; i < end; ++i) {
          const TetHandle t(static_cast<std::uint32_t>(i));
          if (mesh.is_deleted(t)) continue;
          const TetVertices& v = mesh.vertices(t);
          for (unsigned e = 0; e < 6; ++e) {
            const auto& [k, l] = kEdgeVertices[e];
            if (is_end[v[k].index()] && is_end[v[l].index()]) append(t, e, part);
          }
        }
        return part;
      });
  std::vector<TetAtEdge> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace tetmend
