// SPDX-License-Identifier: MIT
// What MeshData::deck holds of an Abaqus deck: its lines, and where among them the mesh stands.
//
//   the first piece names the format and has numbers; each of the others is one of InpPiece
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// How a set of elements, a surface or a set of nodes is called in MeshData::groups.
struct InpGroupName {
  int dimension = 0;
  Label number = 0;
  friend auto operator<=>(const InpGroupName&, const InpGroupName&) = default;
};

/// One letter for each, which begins the piece.
enum class InpPieceKind : char {
  verbatim = 'V',
  nodes = 'N',
  elements = 'E',
  node_set = 'P',
  element_set = 'T',
  surface = 'S',
  face_load = 'F',
  remarks = 'R',  ///< the last, if there are any: not of the deck, but about it
};

/// Where numbers of a deck mean something, see InpScope: the numbers of the mesh less those before.
struct InpNumbering {
  std::int64_t node_offset = 0;
  std::int64_t element_offset = 0;
  std::int64_t most_node = 0;  ///< greatest numbers that the deck knew
  std::int64_t most_element = 0;
};

struct InpPiece {
  InpPieceKind kind = InpPieceKind::verbatim;
  /// Of `verbatim` all there is; of a face load what follows the face: ", 5.0"; else the keyword
  /// line, with its line break.
  std::string text;
  std::vector<InpGroupName> groups;  ///< what is listed; of elements and nodes: named by the line
  std::string more;                  ///< data lines or numbers that are no elements of the mesh
  std::string
      type;  ///< of elements: "C3D10M"; of a face load: "P"; of a set: kInpUnsorted or empty
  std::string suffix;         ///< of a face load, behind the number of the face: "NU"
  std::string instance;       ///< before the numbers of tets with faces: "Part-1-1."
  Label block = 0;            ///< of elements: which parts refer to
  std::size_t numbering = 0;  ///< that its numbers belong to
};

struct InpDeck {
  std::vector<InpNumbering> numberings = {{}};  ///< in the order of their offsets
  std::string folder;   ///< that the deck lay in, if it names other files; else empty
  std::string remarks;  ///< see deck_remarks(), each with a line break
  std::vector<std::pair<Label, Label>> block_of_part;  ///< {part, block}
  std::vector<InpPiece> pieces;
};

/// InpPiece::type of a set of nodes that is written as it was: `more` are its lines.
inline constexpr std::string_view kInpUnsorted = "UNSORTED";

inline constexpr std::string_view kInpDeckName = "Abaqus\n";

std::vector<std::string> pack_deck(const InpDeck& deck);
/// True if this is what pack_deck() made.
bool is_inp_deck(const std::vector<std::string>& deck);
/// Precondition: is_inp_deck().
InpDeck unpack_deck(const std::vector<std::string>& deck);

}  // namespace tetmend::formats
