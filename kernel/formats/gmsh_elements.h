// SPDX-License-Identifier: MIT
// The types of elements in Gmsh's files, and what VTK calls them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tetmend::formats {

struct GmshType {
  std::string_view name;
  int dimension = -1;     ///< -1: a type that cannot be read
  std::size_t width = 0;  ///< vertices of one element
  int vtk_type = 0;
  /// Vertex i of VTK is vertex order[i] of Gmsh; all 0: the order is the same.
  std::array<std::uint8_t, 27> order{};

  bool has_own_order() const { return order[1] != 0; }
};

enum GmshElement : int {
  gmsh_edge = 1,
  gmsh_triangle = 2,
  gmsh_tet = 4,
  gmsh_second_order_tet = 11,
  gmsh_point = 15
};

inline constexpr int kGmshTypes = 20;

/// By the number of the type.
inline constexpr std::array<GmshType, kGmshTypes> kGmshTypeTable = {{
    {},
    {"edge", 1, 2, 3, {}},
    {"triangle", 2, 3, 5, {}},
    {"quadrilateral", 2, 4, 9, {}},
    {"tetrahedron", 3, 4, 10, {}},
    {"hexahedron", 3, 8, 12, {}},
    {"prism", 3, 6, 13, {}},
    {"pyramid", 3, 5, 14, {}},
    {"edge of 3 nodes", 1, 3, 21, {}},
    {"triangle of 6 nodes", 2, 6, 22, {}},
    {"quadrilateral of 9 nodes", 2, 9, 28, {}},
    {"tetrahedron of 10 nodes", 3, 10, 24, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {"hexahedron of 27 nodes", 3, 27, 29, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                           19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}},
    {"prism of 18 nodes",
     3,
     18,
     32,
     {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16}},
    // VTK has it as a Lagrange pyramid only.
    {"pyramid of 14 nodes", 3, 14, 74, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13}},
    {"point", 0, 1, 1, {}},
    {"quadrilateral of 8 nodes", 2, 8, 23, {}},
    {"hexahedron of 20 nodes", 3, 20, 25, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                           13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    {"prism of 15 nodes", 3, 15, 26, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
    {"pyramid of 13 nodes", 3, 13, 27, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
}};

inline const GmshType& gmsh_type(int number) {
  return kGmshTypeTable[static_cast<std::size_t>(number)];
}

/// The number of Gmsh's type for a cell type of VTK; 0 if there is none.
inline int gmsh_type_of_vtk(int vtk_type, std::size_t width) {
  for (int type = 1; type < kGmshTypes; ++type) {
    if (gmsh_type(type).vtk_type == vtk_type && gmsh_type(type).width == width) return type;
  }
  return 0;
}

/// Under this name a view of the nodes has the labels of points, as other tools write it.
inline constexpr std::string_view kGmshPointLabels = "medit:ref";

}  // namespace tetmend::formats
