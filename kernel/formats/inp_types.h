// SPDX-License-Identifier: MIT
// The element types of Abaqus and CalculiX, and what VTK calls them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tetmend::formats {

struct InpType {
  enum class Kind {
    mesh,     ///< a cell type of VTK
    other,    ///< springs, masses and their like: a deck keeps their lines as they are
    refused,  ///< holds a volume that cannot be kept
  };
  Kind kind = Kind::other;
  int vtk_type = 0;
  std::size_t width = 0;  ///< nodes of one
  int dimension = 0;
};

/// What a name such as C3D10M stands for, in any case.
InpType inp_type(std::string_view name);

/// The usual name for a cell type of VTK; empty: there is none.
std::string_view inp_type_name(int vtk_type);

/// Node i of Abaqus is vertex i of VTK, but for edges of second order: their middle comes second.
inline std::size_t vtk_position(int vtk_type, std::size_t i) {
  constexpr int kSecondOrderEdge = 21;
  constexpr std::array<std::size_t, 3> kOrder = {0, 2, 1};
  return vtk_type == kSecondOrderEdge ? kOrder[i] : i;
}

inline constexpr int kVtkEdge = 3;
inline constexpr int kVtkTriangle = 5;
inline constexpr int kVtkTet = 10;
inline constexpr int kVtkTriangle6 = 22;
inline constexpr int kVtkTet10 = 24;

/// Corners of face S1 to S4 of a tet. Seen from outside they go clockwise.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kInpTetFaces = {
    {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

}  // namespace tetmend::formats
