// SPDX-License-Identifier: MIT
// Meshes of Cubit, MOOSE and Sandia's programs: files of Exodus II, which are files of netCDF.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/formats/unique_names.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh: its deck is ours.
inline constexpr std::string_view kExodus = "Exodus";
/// Pieces of the deck: our number and that of the file, of each.
inline constexpr std::string_view kShellNumbers = "block", kElementSetNumbers = "element set";

struct ExodusType {
  std::string_view begin;  ///< of its name; what follows is a number of nodes, or nothing
  int vtk_type;
  std::string_view written;
};

/// Names of one type come together, that which is written first.
inline constexpr std::array<ExodusType, 31> kExodusTypes = {
    {{"TETRA", vtk_tet, "TETRA"},
     {"TET", vtk_tet, {}},
     {"TETRA", vtk_tet10, "TETRA10"},
     {"TET", vtk_tet10, {}},
     {"HEX", vtk_hexahedron, "HEX8"},
     {"HEX", vtk_hexahedron20, "HEX20"},
     {"WEDGE", vtk_prism, "WEDGE"},
     {"WEDGE", vtk_prism15, "WEDGE15"},
     {"PYRAMID", vtk_pyramid, "PYRAMID"},
     {"PYRAMID", vtk_pyramid13, "PYRAMID13"},
     {"TRI", vtk_triangle, "TRI3"},
     {"TRIANGLE", vtk_triangle, {}},
     {"TRISHELL", vtk_triangle, {}},
     {"SHELL", vtk_triangle, {}},
     {"TRI", vtk_triangle6, "TRI6"},
     {"TRIANGLE", vtk_triangle6, {}},
     {"TRISHELL", vtk_triangle6, {}},
     {"SHELL", vtk_triangle6, {}},
     {"SHELL", vtk_quad, "SHELL4"},
     {"QUAD", vtk_quad, {}},
     {"SHELL", vtk_quad8, "SHELL8"},
     {"QUAD", vtk_quad8, {}},
     {"BAR", vtk_edge, "BAR2"},
     {"BEAM", vtk_edge, {}},
     {"TRUSS", vtk_edge, {}},
     {"EDGE", vtk_edge, {}},
     {"ROD", vtk_edge, {}},
     {"BAR", vtk_edge3, "BEAM3"},
     {"BEAM", vtk_edge3, {}},
     {"TRUSS", vtk_edge3, {}},
     {"SPHERE", vtk_point, "SPHERE"}}};

/// Of a name and a number of nodes; null: it is none of ours.
const ElementKind* exodus_kind(std::string_view name, std::uint64_t width);
bool is_exodus_volume(std::string_view name);

/// The sides of a volume or shell, in Exodus' order. Empty: it has none.
std::span<const FaceCorners> exodus_sides(const ElementKind& kind);

inline bool exodus_holds(int vtk_type) {
  return element_kind(vtk_type) != nullptr;
}

/// Names of 32 bytes any program reads, longer ones those that ask how long they are.
inline constexpr std::size_t kShortExodusName = 32;
inline constexpr NameRules kExodusNames = {.most = 255};
bool is_exodus_name(std::string_view name);

/// How many pieces of its deck a reader of another format would miss.
std::size_t exodus_pieces_to_miss(const MeshData& mesh);
/// How many of its blocks and sets have other numbers in a mesh, for two of the file had one.
std::size_t exodus_numbers_to_miss(const MeshData& mesh);

/// Blocks are labels, side sets triangles with labels, sets and blocks with names groups. Of variables
/// the first step is an array. @throws Error
MeshData read_exodus(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Elements are sorted by block. @throws Error
void write_exodus(const std::filesystem::path& file, const MeshView& mesh);

/// What names, numbers and arrays Exodus has no place for.
std::vector<std::string> not_in_exodus(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
