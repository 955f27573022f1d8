// SPDX-License-Identifier: MIT
// I-DEAS's universal file, `.unv`, which Salome, Gmsh and test programs write: nodes, elements, groups.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh: its deck, datasets that name no nodes, is ours.
inline constexpr std::string_view kUnv = "UNV";
/// A piece of the deck that is no dataset: behind it the number of that of the groups, if it is not
/// kUnvGroups, for some programs read their own alone.
inline constexpr std::string_view kUnvGroupsPiece = "groups ";
inline constexpr std::string_view kUnvGroups = "2467";
/// How many datasets of its deck a reader of another format would miss.
std::size_t unv_pieces_to_miss(const MeshData& mesh);

/// Descriptor, property, material and colour of an element, where they are not what the writer says
/// by itself.
inline constexpr std::string_view kUnvElement = "unv:element";
/// Two systems of coordinates and the colour of a node, likewise.
inline constexpr std::string_view kUnvNode = "unv:node";

/// Which kinds of elements it has: all but pyramids.
inline bool unv_holds(int vtk_type) {
  return element_kind(vtk_type) != nullptr && vtk_type != vtk_pyramid && vtk_type != vtk_pyramid13;
}

/// A name of one line.
bool is_unv_name(std::string_view name);

/// The number of the property is the label; where all elements of a dimension have the same, it is
/// that of the first group with the element. Groups keep their names, points and elements their
/// numbers. @throws Error
MeshData read_unv(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Writes datasets 2411, 2412 and 2467, or 2435, 2452 or 2477 where groups came in it. Doubles have all digits. @throws Error
void write_unv(const std::filesystem::path& file, const MeshView& mesh);

/// What it cannot hold of a mesh, one sentence each.
std::vector<std::string> not_in_unv(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
