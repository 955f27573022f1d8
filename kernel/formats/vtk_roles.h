// SPDX-License-Identifier: MIT
// What files of VTK say of their arrays: which one is active as Scalars, Normals, GlobalIds...
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// MeshData::variant of a mesh of VTK, and the names of what can be written.
inline constexpr std::string_view kVtkAscii = "ASCII";
inline constexpr std::string_view kVtkBinary = "binary";

/// What VTK takes an array of points or cells for.
struct VtkRole {
  bool of_points = false;
  std::string role;   ///< as the XML format calls it: "GlobalIds"
  std::string array;  ///< its name
};

/// The roles that there are, as the XML format calls them.
std::span<const std::string_view> vtk_roles();
/// True for numbers by which other files may call points or cells: GlobalIds, PedigreeIds. VTK wants
/// them as its vtkIdType.
bool is_id_role(std::string_view role);

/// Kept as pieces of MeshData::deck, where `variant` is one of VTK's.
void keep_role(MeshData& mesh, const VtkRole& role);
/// Of a mesh that was read from another format: none.
std::vector<VtkRole> roles_of(const MeshData& mesh);
/// True where the deck has roles alone, which are nothing without their arrays.
bool has_only_roles(const MeshData& mesh);

}  // namespace tetmend::formats
