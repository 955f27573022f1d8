// SPDX-License-Identifier: MIT
// Decks of Abaqus and CalculiX, `.inp`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of a deck.
inline constexpr std::string_view kInp = "Abaqus";

/// How sets are written: number by number, or as ranges where these are shorter. By themselves number
/// by number, but for those that are one range.
inline constexpr std::string_view kInpLists = "lists";
inline constexpr std::string_view kInpRanges = "ranges";

/// Sets become groups, and so do surfaces and loads on faces of tets, with the faces as triangles.
/// What is not the mesh is in `deck`, word for word. See read_mesh().
MeshData read_inp(const std::filesystem::path& file, TetPlace* question);

/// The deck and all that it includes; the deck alone where one of them cannot be read.
std::vector<std::filesystem::path> inp_files(const std::filesystem::path& deck);

/// With the deck that the mesh came from, else a deck of its own: sets, and a surface with its nodes
/// for each group of triangles.
void write_inp(const std::filesystem::path& file, const MeshView& mesh);

/// A name that decks take as it is.
bool is_inp_name(std::string_view name);

/// What a deck cannot hold of a mesh, one sentence each.
std::vector<std::string> not_in_inp(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
