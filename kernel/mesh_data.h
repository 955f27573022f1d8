// SPDX-License-Identifier: MIT
// The contents of a mesh file as plain arrays: what readers fill, writers print and TetMesh is
// built from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace tetmend {

using Point = Eigen::Vector3d;
/// Reference label of a tet, a triangle or an edge, as the file gives it.
using Label = std::int32_t;

/// A tetrahedral mesh without adjacency. Vertex numbers count from 0 in the order of the file,
/// whatever the file counts from. Orientation is not promised: a reader keeps the order of the
/// file.
struct MeshData {
  struct Triangle {
    std::array<std::uint32_t, 3> vertices{};
    Label label = 0;
    friend bool operator==(const Triangle&, const Triangle&) = default;
  };
  struct Tet {
    std::array<std::uint32_t, 4> vertices{};
    Label label = 0;
    friend bool operator==(const Tet&, const Tet&) = default;
  };
  struct Edge {
    std::array<std::uint32_t, 2> vertices{};
    Label label = 0;
    friend bool operator==(const Edge&, const Edge&) = default;
  };

  std::vector<Point> points;
  std::vector<Label> point_labels;  ///< empty when all are 0, else one for each point
  std::vector<Tet> tets;
  std::vector<Triangle> triangles;  ///< boundary and interior triangles that the file names
  std::vector<Edge> edges;  ///< feature edges that the file names; constraints when interior
  std::vector<std::uint32_t> required_vertices;  ///< vertices that must not move or vanish
};

}  // namespace tetmend
