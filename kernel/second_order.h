// SPDX-License-Identifier: MIT
// Tets, triangles and edges of second order: each edge has a node between its ends, which may lie
// beside the middle, so that the element is curved.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

inline constexpr std::uint32_t kNoMidNode = UINT32_MAX;

/// One number for an edge, whichever end comes first.
inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// Finds the mid-side node of an edge. A value; immutable.
class MidNodes {
 public:
  /// Of MeshData::mid_nodes. Cost: n log n; takes 16 bytes an edge.
  explicit MidNodes(std::span<const std::array<std::uint32_t, 3>> mid_nodes);

  bool is_empty() const { return edges_.empty(); }
  /// kNoMidNode where there is none. Cost: log n.
  std::uint32_t of(std::uint32_t a, std::uint32_t b) const;
  /// Of all edges of an element of first order, in VTK's order; empty if one has none.
  template <std::size_t N>
  std::vector<std::uint32_t> of(const std::array<std::uint32_t, N>& vertices) const;

 private:
  struct Edge {
    std::uint64_t ends;  // the smaller number in the upper half
    std::uint32_t node;
  };
  std::vector<Edge> edges_;  // ascending
};

/// Ends of the edges of a tet in VTK's order of their nodes; those of a triangle are the first 3,
/// that of an edge is the first.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kMidNodeEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

template <std::size_t N>
std::vector<std::uint32_t> MidNodes::of(const std::array<std::uint32_t, N>& vertices) const {
  constexpr std::size_t kEdges = N * (N - 1) / 2;
  std::vector<std::uint32_t> nodes;
  for (std::size_t e = 0; e < kEdges; ++e) {
    const std::uint32_t node = of(vertices[kMidNodeEdges[e][0]], vertices[kMidNodeEdges[e][1]]);
    if (node == kNoMidNode) return {};
    nodes.push_back(node);
  }
  return nodes;
}

/// Makes tets, triangles and edges, with mid_nodes, of the other elements that are such of second
/// order: what readers give becomes what MeshData promises. In a mesh with tets of both orders those
/// of second order stay other elements.
/// @throws Error, without the name of the file, for an edge with two nodes and a node of two edges or
/// one that is a vertex of a tet
void take_second_order(MeshData& mesh);

/// The other way round: what writers print. Elements that a group names one by one stay of first
/// order: they are marks. Without `has_marks` groups mean nothing;
/// without `has_edges` edges stay of first order. Cost: copies the mesh.
MeshData with_second_order(const MeshData& mesh, bool has_marks = true, bool has_edges = true);

/// The mesh without its mid-side nodes, for formats that have none. Cost: copies the mesh.
MeshData without_mid_nodes(const MeshData& mesh);

/// Keeps the points with a number below kNoMidNode in `number_of`, under this number, in every list.
void renumber_points(MeshData& mesh, std::span<const std::uint32_t> number_of, std::size_t count);

}  // namespace tetmend
