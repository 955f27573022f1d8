// SPDX-License-Identifier: MIT
// Gmsh's files `.msh` of versions 2.2 and 4.1, ASCII and binary.
#pragma once

#include <filesystem>
#include <string_view>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// Keeps nodes, elements of first and second order, physical groups with their names, entities,
/// periodic links and views of numbers. Points and elements are in the order of their numbers. The
/// label of an element is its first physical group, its part the elementary entity. Version 2.2
/// lists an element once for each of its groups: here it is one. Elements of one entity that are
/// in different groups get different parts. What is not kept is in `notes`. @throws Error
MeshData read_gmsh(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Writes the version and coding that `variant` of the data names, 4.1 binary if it names none.
/// Data without parts get one entity for each label, which is in the group of that number; 0 is no
/// group. Required vertices have no place in the format. @throws Error also for more elements than
/// 31 bits count in version 2.2
void write_gmsh(const std::filesystem::path& file, const MeshView& mesh);

/// A name that the format takes as it is.
inline bool is_gmsh_name(std::string_view name) {
  return name.find('\n') == std::string_view::npos;
}

/// read_gmsh() of a file that is one of several of a mesh: `point_numbers` are those of the file, which
/// the others have, too, and there may be no tets. @throws Error
MeshData read_gmsh_part(const std::filesystem::path& file);

/// write_gmsh() in version 4.1, binary, with the numbers that the data has of points, tets, triangles
/// and edges. @throws Error also for labels of points with numbers of more than 31 bits
void write_gmsh_part(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
