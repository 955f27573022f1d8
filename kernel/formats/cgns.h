// SPDX-License-Identifier: MIT
// Meshes of CGNS, the notation of programs for flows: a tree of nodes in a file of HDF5.
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
#include "kernel/formats/unique_names.h"
#include "kernel/formats/vector_parts.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh: its deck is ours.
inline constexpr std::string_view kCgns = "CGNS";

struct CgnsType {
  std::int32_t number;  ///< of CGNS' ElementType_t
  int vtk_type;
};
inline constexpr std::array<CgnsType, 15> kCgnsTypes = {{{2, vtk_point},
                                                         {3, vtk_edge},
                                                         {4, vtk_edge3},
                                                         {5, vtk_triangle},
                                                         {6, vtk_triangle6},
                                                         {7, vtk_quad},
                                                         {8, vtk_quad8},
                                                         {10, vtk_tet},
                                                         {11, vtk_tet10},
                                                         {12, vtk_pyramid},
                                                         {21, vtk_pyramid13},
                                                         {14, vtk_prism},
                                                         {15, vtk_prism15},
                                                         {17, vtk_hexahedron},
                                                         {18, vtk_hexahedron20}}};
inline constexpr std::int32_t kCgnsMixed = 20;

/// How names of sections begin whose elements have the label 0.
inline constexpr std::string_view kCgnsUnlabelled = "Unlabelled";

/// The node of a solution or condition that says of what it is.
inline constexpr std::string_view kCgnsLocation = "GridLocation";

inline constexpr AxisEndings kCgnsAxes = {"X", "Y", "Z"};

inline bool cgns_holds(int vtk_type) {
  return element_kind(vtk_type) != nullptr;
}

/// Of nodes of the tree.
inline constexpr NameRules kCgnsNames = {.most = 32, .slash = '_'};
/// Those of the arrays of a solution, where a node says what they are values of.
UniqueNames cgns_array_names();
bool is_cgns_name(std::string_view name);

/// How many pieces of its deck a reader of another format would miss.
std::size_t cgns_pieces_to_miss(const MeshData& mesh);

/// One zone without structure. Sections are labels, boundary conditions groups, solutions arrays.
/// @throws Error
MeshData read_cgns(const std::filesystem::path& file, TetPlace* question = nullptr);

/// @throws Error
void write_cgns(const std::filesystem::path& file, const MeshView& mesh);

/// What names and arrays CGNS has no place for.
std::vector<std::string> not_in_cgns(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
