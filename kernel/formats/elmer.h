// SPDX-License-Identifier: MIT
// A mesh of Elmer: a folder with mesh.header, mesh.nodes, mesh.elements, mesh.boundary.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

struct ElmerType {
  int number;
  int vtk_type;
};

/// Nodes come in VTK's order in all of these.
inline constexpr std::array<ElmerType, 11> kElmerTypes = {{{202, vtk_edge},
                                                           {203, vtk_edge3},
                                                           {303, vtk_triangle},
                                                           {306, vtk_triangle6},
                                                           {404, vtk_quad},
                                                           {408, vtk_quad8},
                                                           {504, vtk_tet},
                                                           {510, vtk_tet10},
                                                           {605, vtk_pyramid},
                                                           {706, vtk_prism},
                                                           {808, vtk_hexahedron}}};

/// Which kinds of elements it has.
inline bool elmer_holds(int vtk_type) {
  for (const ElmerType& type : kElmerTypes) {
    if (type.vtk_type == vtk_type) return true;
  }
  return false;
}

/// Numbers of bodies and boundaries are labels; names in a file mesh.names beside it are groups.
/// @param header the file mesh.header in the folder
/// @throws Error
MeshData read_elmer(const std::filesystem::path& header, TetPlace* question = nullptr);

/// Writes all files of the folder, mesh.names if there are names or an older such file. Parents of
/// boundary elements are found from the volumes. No file appears before all are complete.
/// @throws Error
void write_elmer(const std::filesystem::path& header, const MeshView& mesh);

/// All files of a mesh that is named by one of them, that one first.
std::vector<std::filesystem::path> elmer_files(const std::filesystem::path& header);

}  // namespace tetmend::formats
