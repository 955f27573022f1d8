// SPDX-License-Identifier: MIT
// The kinds of elements that formats of solvers share, by VTK's numbers of cell types.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tetmend::formats {

struct ElementKind {
  int vtk_type = 0;
  int dimension = 0;
  std::size_t width = 0;    ///< vertices of one
  std::size_t corners = 0;  ///< of these; they come first
  std::string_view name;
};

enum VtkCellType : int {
  vtk_point = 1,
  vtk_edge = 3,
  vtk_triangle = 5,
  vtk_quad = 9,
  vtk_tet = 10,
  vtk_hexahedron = 12,
  vtk_prism = 13,
  vtk_pyramid = 14,
  vtk_edge3 = 21,
  vtk_triangle6 = 22,
  vtk_quad8 = 23,
  vtk_tet10 = 24,
  vtk_hexahedron20 = 25,
  vtk_prism15 = 26,
  vtk_pyramid13 = 27
};

inline constexpr std::size_t kMostVerticesOfElement = 20;

inline constexpr std::array<ElementKind, 15> kElementKinds = {
    {{vtk_point, 0, 1, 1, "point"},
     {vtk_edge, 1, 2, 2, "edge"},
     {vtk_triangle, 2, 3, 3, "triangle"},
     {vtk_quad, 2, 4, 4, "quadrilateral"},
     {vtk_tet, 3, 4, 4, "tetrahedron"},
     {vtk_hexahedron, 3, 8, 8, "hexahedron"},
     {vtk_prism, 3, 6, 6, "prism"},
     {vtk_pyramid, 3, 5, 5, "pyramid"},
     {vtk_edge3, 1, 3, 2, "edge of 3 nodes"},
     {vtk_triangle6, 2, 6, 3, "triangle of 6 nodes"},
     {vtk_quad8, 2, 8, 4, "quadrilateral of 8 nodes"},
     {vtk_tet10, 3, 10, 4, "tetrahedron of 10 nodes"},
     {vtk_hexahedron20, 3, 20, 8, "hexahedron of 20 nodes"},
     {vtk_prism15, 3, 15, 6, "prism of 15 nodes"},
     {vtk_pyramid13, 3, 13, 5, "pyramid of 13 nodes"}}};

/// A face by its corners, as vertices of its element.
using FaceCorners = std::array<std::uint8_t, 4>;
inline constexpr std::uint8_t kNoCorner = 255;  ///< the last corner of a triangle

/// Null if the kind is none of these.
inline constexpr const ElementKind* element_kind(std::int64_t vtk_type) {
  for (const ElementKind& kind : kElementKinds) {
    if (kind.vtk_type == vtk_type) return &kind;
  }
  return nullptr;
}

}  // namespace tetmend::formats
