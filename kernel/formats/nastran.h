// SPDX-License-Identifier: MIT
// Nastran's bulk data, `.bdf` and `.nas`: the mesh of a deck, with all else word for word.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh.
inline constexpr std::string_view kNastran = "Nastran";

/// The pieces of its MeshData::deck.
enum NastranPiece : std::size_t {
  nastran_front,     ///< what stands up to BEGIN BULK
  nastran_cards,     ///< of the bulk, that are not ours
  nastran_end,       ///< from ENDDATA on
  nastran_points,    ///< GRID cards that say more than MeshData can hold
  nastran_elements,  ///< likewise, those of elements
  nastran_remarks,   ///< the last, if there are any: see deck_remarks(), each with a line break
  nastran_pieces = nastran_remarks
};

struct NastranCard {
  std::string_view name;
  int vtk_type;
};

/// Middle nodes come in VTK's order in all of these but CHEXA and CPENTA, where the ones between
/// bottom and top come before those of the top.
inline constexpr std::array<NastranCard, 13> kNastranCards = {{{"CTETRA", vtk_tet},
                                                               {"CTETRA", vtk_tet10},
                                                               {"CHEXA", vtk_hexahedron},
                                                               {"CHEXA", vtk_hexahedron20},
                                                               {"CPENTA", vtk_prism},
                                                               {"CPENTA", vtk_prism15},
                                                               {"CPYRAM", vtk_pyramid},
                                                               {"CPYRAM", vtk_pyramid13},
                                                               {"CTRIA3", vtk_triangle},
                                                               {"CTRIA6", vtk_triangle6},
                                                               {"CQUAD4", vtk_quad},
                                                               {"CQUAD8", vtk_quad8},
                                                               {"CPYRA", vtk_pyramid}}};

/// Vertex i of VTK is vertex order[i] of Nastran.
inline constexpr std::array<std::uint8_t, 20> kNastranHexahedron20 = {
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
inline constexpr std::array<std::uint8_t, 15> kNastranPrism15 = {0, 1,  2,  3,  4, 5,  6, 7,
                                                                 8, 12, 13, 14, 9, 10, 11};
inline const std::uint8_t* nastran_order(int vtk_type) {
  if (vtk_type == vtk_hexahedron20) return kNastranHexahedron20.data();
  return vtk_type == vtk_prism15 ? kNastranPrism15.data() : nullptr;
}

/// Which kinds of elements it has.
inline bool nastran_holds(int vtk_type) {
  for (const NastranCard& card : kNastranCards) {
    if (card.vtk_type == vtk_type) return true;
  }
  return false;
}

/// Fields are small, large or free. Property numbers are labels. Points that cards which are kept
/// word for word name, or that have permanent constraints, become required vertices. @throws Error
MeshData read_nastran(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Writes free fields, large ones for points: a coordinate has all its digits, of which solvers
/// read the first 16 characters. @throws Error
void write_nastran(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
