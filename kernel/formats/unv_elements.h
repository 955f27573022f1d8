// SPDX-License-Identifier: MIT
// The kinds of elements of a universal file.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "kernel/formats/element_kinds.h"

namespace tetmend::formats {

/// Elements that are of one kind for us, whatever physics they are for.
struct UnvKind {
  int vtk_type;
  std::int64_t written;                  ///< descriptor of the writer
  std::span<const std::int64_t> others;  ///< further ones that are read
  /// Vertex i of VTK is vertex order[i] here: middle nodes stand between their ends.
  std::array<std::uint8_t, kMostVerticesOfElement> order;
};

// Plane stress, plane strain, plate, membrane, axisymmetric, thin shell.
inline constexpr std::array<std::int64_t, 5> kUnvTriangles = {41, 51, 61, 74, 81};
inline constexpr std::array<std::int64_t, 5> kUnvTriangles6 = {42, 52, 62, 72, 82};
inline constexpr std::array<std::int64_t, 5> kUnvQuads = {44, 54, 64, 71, 84};
inline constexpr std::array<std::int64_t, 5> kUnvQuads8 = {45, 55, 65, 75, 85};
inline constexpr std::array<std::int64_t, 2> kUnvEdges = {11, 22};  // rod, tapered beam
inline constexpr std::array<std::int64_t, 1> kUnvPrisms = {101};    // thick shells
inline constexpr std::array<std::int64_t, 1> kUnvPrisms15 = {102};
inline constexpr std::array<std::int64_t, 1> kUnvHexahedra = {104};
inline constexpr std::array<std::int64_t, 1> kUnvHexahedra20 = {105};
inline constexpr std::array<std::int64_t, 1> kUnvEdges3 = {23};

inline constexpr std::array<UnvKind, 13> kUnvKinds = {
    {{vtk_tet, 111, {}, {0, 1, 2, 3}},
     {vtk_tet10, 118, {}, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}},
     {vtk_prism, 112, kUnvPrisms, {0, 1, 2, 3, 4, 5}},
     {vtk_prism15, 113, kUnvPrisms15, {0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8}},
     {vtk_hexahedron, 115, kUnvHexahedra, {0, 1, 2, 3, 4, 5, 6, 7}},
     {vtk_hexahedron20, 116, kUnvHexahedra20, {0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                               5, 7, 13, 15, 17, 19, 8,  9,  10, 11}},
     {vtk_triangle, 91, kUnvTriangles, {0, 1, 2}},
     {vtk_triangle6, 92, kUnvTriangles6, {0, 2, 4, 1, 3, 5}},
     {vtk_quad, 94, kUnvQuads, {0, 1, 2, 3}},
     {vtk_quad8, 95, kUnvQuads8, {0, 2, 4, 6, 1, 3, 5, 7}},
     {vtk_edge, 21, kUnvEdges, {0, 1}},
     {vtk_edge3, 24, kUnvEdges3, {0, 2, 1}},
     {vtk_point, 161, {}, {0}}}};

/// Null if the descriptor is none of these.
inline const UnvKind* unv_kind(std::int64_t descriptor) {
  for (const UnvKind& kind : kUnvKinds) {
    if (kind.written == descriptor) return &kind;
    if (std::find(kind.others.begin(), kind.others.end(), descriptor) != kind.others.end())
      return &kind;
  }
  return nullptr;
}
inline const UnvKind* unv_kind_of(int vtk_type) {
  for (const UnvKind& kind : kUnvKinds) {
    if (kind.vtk_type == vtk_type) return &kind;
  }
  return nullptr;
}

/// Elements with a third line, on the sections of a beam.
inline bool is_unv_beam(std::int64_t descriptor) {
  constexpr std::array<std::int64_t, 5> kBeams = {11, 21, 22, 23, 24};
  return std::find(kBeams.begin(), kBeams.end(), descriptor) != kBeams.end();
}

}  // namespace tetmend::formats
