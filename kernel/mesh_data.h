// SPDX-License-Identifier: MIT
// The contents of a mesh file as plain arrays: what readers fill, writers print and TetMesh is
// built from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <tetmend/api.h>
#include <tetmend/data.h>

namespace tetmend {

using Point = Eigen::Vector3d;
/// Reference label of a tet, a triangle or an edge, as the file gives it.
using Label = std::int32_t;
/// Numbers that a file gives to points or elements: the first and the last.
using NumberRange = std::pair<std::int64_t, std::int64_t>;

/// A vertex, curve, surface or volume of the geometry that a mesh was made from.
struct TETMEND_API GeometricEntity {
  int dimension = 3;
  Label tag = 0;                ///< no other entity of this dimension has it
  std::array<double, 6> box{};  ///< x, y, z at least, then at most; of a vertex its place, twice
  std::vector<Label> groups;    ///< numbers of groups of this dimension
  std::vector<Label> boundary;  ///< tags of entities one dimension lower; negative: turned round
  friend bool operator==(const GeometricEntity&, const GeometricEntity&) = default;
};

/// Points of one entity, each the image of a point of another.
struct TETMEND_API PeriodicLink {
  int dimension = 2;
  Label tag = 0;
  Label master = 0;
  std::vector<double> affine;                        ///< 4 x 4 by rows, or empty
  std::vector<std::array<std::uint32_t, 2>> points;  ///< {image, original}
  friend bool operator==(const PeriodicLink&, const PeriodicLink&) = default;
};

/// Elements that are no tets, triangles or edges of first order. They stay as they are.
struct TETMEND_API OtherElements {
  int vtk_type = 0;                     ///< as VTK numbers cell types: 12 is a hexahedron
  std::size_t vertex_count = 0;         ///< of one
  std::vector<std::uint32_t> vertices;  ///< of the first, then of the second, in VTK's order
  std::vector<Label> labels;            ///< one for each
  std::vector<Label> parts;             ///< one for each, or none
  std::vector<std::int64_t> numbers;    ///< like MeshData::tet_numbers
  std::vector<DataArray> data;
  friend bool operator==(const OtherElements&, const OtherElements&) = default;
};

/// A tetrahedral mesh without adjacency. Vertex numbers count from 0 in the order of the file,
/// whatever the file counts from. Orientation is not promised: a reader keeps the order of the
/// file.
struct TETMEND_API MeshData {
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

  // What else a file may hold. Improving looks at none of it but tet_parts.

  /// One for each element, or none: like labels, but only to tell apart what groups and entities
  /// tell apart. A face between two parts stays.
  std::vector<Label> tet_parts, triangle_parts, edge_parts;
  std::vector<std::array<Label, 2>> point_entities;  ///< {dimension, tag} of each point, or none
  /// What the file calls each point or element, no number twice; 0: nothing yet. Empty: 1, 2, 3...
  std::vector<std::int64_t> point_numbers, tet_numbers, triangle_numbers, edge_numbers;
  /// All numbers that the file had for points, and for elements of any kind, in ascending order: also
  /// of those that are gone. Its other lines, and files beside it, may name them, so none is given anew.
  std::vector<NumberRange> taken_point_numbers, taken_element_numbers;
  std::vector<DataArray> point_data, tet_data, triangle_data, edge_data;
  std::vector<Group> groups;
  std::vector<GeometricEntity> entities;
  std::vector<PeriodicLink> periodic;
  std::vector<OtherElements> other_elements;
  /// {end, end, node} of each edge of an element of second order. The node is a point that no tet
  /// has for a vertex. An element all of whose edges have one is of second order.
  std::vector<std::array<std::uint32_t, 3>> mid_nodes;
  /// What a deck holds besides its mesh, word for word, in pieces: only its own format knows how.
  std::vector<std::string> deck;
  std::string variant;      ///< of the format that it was read from: "4.1 binary"
  std::string label_array;  ///< under which name the labels stood; empty: a format's own place

  std::vector<std::string> notes;  ///< what of the file is not here, one sentence each
};

}  // namespace tetmend
