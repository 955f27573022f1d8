// SPDX-License-Identifier: MIT
// Nastran's bulk data, `.bdf` and `.nas`: the mesh of a deck, with all else word for word.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/room.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh.
inline constexpr std::string_view kNastran = "Nastran";

/// Characters of a number that solvers read.
inline constexpr std::size_t kNastranRoom = 16;

/// The pieces of its MeshData::deck.
enum NastranPiece : std::size_t {
  nastran_front,     ///< what stands up to BEGIN BULK
  nastran_cards,     ///< of the bulk, that are not ours
  nastran_end,       ///< from ENDDATA on
  nastran_points,    ///< GRID cards that say more than MeshData can hold
  nastran_elements,  ///< likewise, those of elements
  nastran_folder,    ///< that the deck lay in, if it names other files; else empty
  nastran_zero,      ///< what elements of label 0 have as property: "0", or a blank field
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

/// The kind of element that an element with some mid-side nodes left out is kept as.
inline const ElementKind* nastran_first_order(const ElementKind& kind) {
  for (const ElementKind& each : kElementKinds) {
    if (each.dimension == kind.dimension && each.width == kind.corners) return &each;
  }
  return nullptr;
}

/// Fields are small, large or free. Property numbers are labels; 0 where the field is blank. Points
/// that cards which are kept word for word name, or that have permanent constraints, become required
/// vertices. Those of other coordinate systems are given in the basic one. Elements with some
/// mid-side nodes left out are other elements, of first order. @throws Error
MeshData read_nastran(const std::filesystem::path& file, TetPlace* question = nullptr);

/// The deck and all that it includes; the deck alone where one of them cannot be read.
std::vector<std::filesystem::path> nastran_files(const std::filesystem::path& deck);

/// Writes free fields, and for points fixed ones of 16 characters. Of a mesh that was no deck, a
/// coordinate has all its digits, if need be in free fields. Of one that was, what a run has moved or
/// made has as many digits as fit. @throws Error
void write_nastran(const std::filesystem::path& file, const MeshView& mesh);

/// Pieces of a deck that another format cannot hold: none where the deck is as the writer makes it.
std::size_t nastran_pieces_to_miss(const MeshData& mesh);

/// What a deck cannot hold of a mesh, one sentence each.
std::vector<std::string> not_in_nastran(const std::filesystem::path& file, const MeshData& mesh);

/// What a form costs, and who cannot read it. Cost: that of writing each coordinate.
FormNotes nastran_form(const MeshData& mesh, std::string_view form);

}  // namespace tetmend::formats
