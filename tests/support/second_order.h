// SPDX-License-Identifier: MIT
// Meshes of second order for tests.
#pragma once

#include <cmath>
#include <map>
#include <utility>

#include "kernel/mesh_data.h"
#include "kernel/second_order.h"

namespace tetmend::test {

/// A smooth map that bends a cube or a ball, by `strength` of its size.
inline Point bent(const Point& p, double strength) {
  return p + strength * Point(std::sin(3 * p.y()), std::sin(3 * p.z()), std::cos(2 * p.x()));
}

/// Every vertex moves with the map. Mid-side nodes of the surface lie where the map brings the
/// middles of their edges, those inside in the middle. Points are shuffled with the nodes: a node
/// follows the first vertex of its edge.
inline MeshData second_order(const MeshData& first, double strength) {
  std::map<std::array<std::uint32_t, 3>, int> faces;
  for (const MeshData::Tet& tet : first.tets) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) face[k] = tet.vertices[k < left_out ? k : k + 1];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;  // on the surface
  const auto ends = [](std::uint32_t a, std::uint32_t b) {
    return std::pair(std::min(a, b), std::max(a, b));
  };
  for (const MeshData::Tet& tet : first.tets) {
    for (const auto& [i, j] : kMidNodeEdges) edges[ends(tet.vertices[i], tet.vertices[j])] |= false;
  }
  for (const auto& [face, count] : faces) {
    for (std::size_t k = 0; k < 3 && count == 1; ++k)
      edges[ends(face[k], face[(k + 1) % 3])] = true;
  }
  MeshData mesh = first;
  mesh.points.clear();
  std::vector<std::uint32_t> number(first.points.size());
  auto edge = edges.begin();
  for (std::uint32_t v = 0; v < first.points.size(); ++v) {
    number[v] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(bent(first.points[v], strength));
    for (; edge != edges.end() && edge->first.first == v; ++edge) {
      const Point& a = first.points[v];
      const Point& b = first.points[edge->first.second];
      mesh.mid_nodes.push_back(
          {v, edge->first.second, static_cast<std::uint32_t>(mesh.points.size())});
      mesh.points.push_back(edge->second ? bent((a + b) / 2, strength)
                                         : (bent(a, strength) + bent(b, strength)) / 2);
    }
  }
  for (MeshData::Tet& tet : mesh.tets) {
    for (std::uint32_t& v : tet.vertices) v = number[v];
  }
  for (MeshData::Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle.vertices) v = number[v];
  }
  for (auto& mid : mesh.mid_nodes) mid = {number[mid[0]], number[mid[1]], mid[2]};
  return mesh;
}

}  // namespace tetmend::test
