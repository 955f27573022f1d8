// SPDX-License-Identifier: MIT
// The mesh format of the finite element library MFEM, `.mfem` and often `.mesh`, in space.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/input_file.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh.
inline constexpr std::string_view kMfem = "MFEM";

/// Which kinds of elements it has; quadratic ones only where all volumes are tets.
inline bool mfem_holds(int vtk_type) {
  switch (vtk_type) {
    case vtk_quad:
    case vtk_hexahedron:
    case vtk_prism:
    case vtk_pyramid:
    case vtk_triangle6:
    case vtk_tet10:
      return true;
    default:
      return false;
  }
}

/// Names stand in quotes.
bool is_mfem_name(std::string_view name);

/// True if the file says that it is a mesh of MFEM.
bool looks_like_mfem(const InputFile& file);

/// Attributes are labels, sets of them groups. Nodes of first and of second order are read; those
/// only where all volumes are tets. @throws Error
MeshData read_mfem(const InputFile& file, TetPlace* question = nullptr);
MeshData read_mfem(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Writes version 1.0, or 1.3 if there are names. @throws Error
void write_mfem(const std::filesystem::path& file, const MeshView& mesh);

/// What it cannot hold of a mesh besides, one sentence each.
std::vector<std::string> not_in_mfem(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
