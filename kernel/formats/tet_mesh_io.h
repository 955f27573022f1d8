// SPDX-License-Identifier: MIT
// From a file to a TetMesh: what is wrong with the topology is told with its place in the file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// How vertices and tets lie in memory: as the file lists them, or sorted along a curve through
/// space, which is faster to work on (TetMesh::sorted()).
enum class MeshOrder : std::uint8_t { of_file, spatial };

/// Reads a mesh in any format of read_mesh() and builds it.
/// @throws Error as read_mesh(), and when the topology is broken (see TetMesh). Then the message
/// begins with the line or byte of the tet.
/// Cost: linear; the file is read a second time when a tet has to be located.
TetMesh read_tet_mesh(const std::filesystem::path& file, MeshOrder order = MeshOrder::of_file,
                      BuildReport* report = nullptr,
                      InteriorConstraints interior = InteriorConstraints::kept);

/// The second half of read_tet_mesh(), for `data` that was read of `file` before.
TetMesh build_tet_mesh(const std::filesystem::path& file, MeshData data,
                       MeshOrder order = MeshOrder::of_file, BuildReport* report = nullptr,
                       InteriorConstraints interior = InteriorConstraints::kept);

}  // namespace tetmend
