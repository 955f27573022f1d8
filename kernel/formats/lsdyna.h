// SPDX-License-Identifier: MIT
// Keyword files of LS-DYNA, `.k` and `.key`: the mesh of a deck, with all else word for word.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh.
inline constexpr std::string_view kLsDyna = "LS-DYNA";

/// The first pieces of its deck; the others follow the file, each with a letter of LsDynaPiece in front.
enum LsDynaHead : std::size_t {
  lsdyna_remarks,  ///< see deck_remarks()
  lsdyna_fields,   ///< how wide they are: "8 16"
  lsdyna_folder,   ///< that the deck lay in, if it names other files; else empty
  kLsDynaPieces
};

enum LsDynaPiece : char {
  lsdyna_text = 'T',      ///< word for word
  lsdyna_nodes = 'N',     ///< all nodes; behind it comments
  lsdyna_elements = 'E',  ///< all solids; likewise
  lsdyna_set = 'S',  ///< a set of solids: its number in `groups`, then its lines up to the members
  lsdyna_node_set = 'M',     ///< a set of nodes, likewise
  lsdyna_segment_set = 'F',  ///< a set of segments, likewise
  lsdyna_point = 'P'  ///< a node that says more than its place: its number, its line; at the end
};

/// Characters of a field.
struct LsDynaWidths {
  std::size_t integer = 8;  ///< of *NODE and *ELEMENT
  std::size_t real = 16;    ///< likewise
  std::size_t card = 10;    ///< of other keywords

  friend bool operator==(const LsDynaWidths&, const LsDynaWidths&) = default;
};
inline constexpr LsDynaWidths kLsDynaI10 = {10, 16, 10};
inline constexpr LsDynaWidths kLsDynaLong = {20, 20, 20};

/// Those of a keyword whose line says so at its end, by "+", "-" or "%"; else those of the deck.
LsDynaWidths lsdyna_widths(std::string_view line, const LsDynaWidths& of_deck);

/// Which kinds of elements it has.
inline bool lsdyna_holds(int vtk_type) {
  switch (vtk_type) {
    case vtk_quad:
    case vtk_hexahedron:
    case vtk_prism:
    case vtk_pyramid:
    case vtk_triangle6:
    case vtk_quad8:
    case vtk_tet10:
      return true;
    default:
      return false;
  }
}

inline constexpr std::size_t kLsDynaNodesOfSolid = 8;  ///< that is of first order

/// The nodes of a solid, by the vertices of VTK: of one that is no hexahedron some stand there
/// twice. Null: it has ten nodes, in VTK's order, or is no solid.
inline const std::uint8_t* lsdyna_order(int vtk_type) {
  using Order = std::array<std::uint8_t, kLsDynaNodesOfSolid>;
  static constexpr Order kTet = {0, 1, 2, 3, 3, 3, 3, 3};
  static constexpr Order kPyramid = {0, 1, 2, 3, 4, 4, 4, 4};
  static constexpr Order kPrism = {0, 2, 5, 3, 1, 1, 4, 4};
  static constexpr Order kHexahedron = {0, 1, 2, 3, 4, 5, 6, 7};
  switch (vtk_type) {
    case vtk_tet:
      return kTet.data();
    case vtk_pyramid:
      return kPyramid.data();
    case vtk_prism:
      return kPrism.data();
    case vtk_hexahedron:
      return kHexahedron.data();
    default:
      return nullptr;
  }
}

/// A title of one line that opens neither a keyword nor a comment.
bool is_lsdyna_name(std::string_view name);

/// Numbers of parts are labels. Points that lines which are kept word for word name become required
/// vertices. Shells and segments of sets are triangles; shells, and segments that say more, stay in the
/// deck. @throws Error
MeshData read_lsdyna(const std::filesystem::path& file, TetPlace* question = nullptr);

/// The deck and all that it includes; the deck alone where one of them cannot be read.
std::vector<std::filesystem::path> lsdyna_files(const std::filesystem::path& deck);

/// @throws Error
void write_lsdyna(const std::filesystem::path& file, const MeshView& mesh);

/// What it cannot hold of a mesh, one sentence each.
std::vector<std::string> not_in_lsdyna(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
