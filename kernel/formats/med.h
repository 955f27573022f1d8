// SPDX-License-Identifier: MIT
// Meshes of Salome and code_aster: MED files, of version 3 or 4, which are files of HDF5.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
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
inline constexpr std::string_view kMed = "MED";

struct MedType {
  std::string_view name;  ///< of its group in the file
  std::int32_t number;    ///< of MED's medgeometrytype
  int vtk_type;
  /// Vertex i of VTK is vertex order[i] of MED and the other way round; all 0: the order is the same.
  std::array<std::uint8_t, kMostVerticesOfElement> order{};
};

/// MED turns its volumes round.
inline constexpr std::array<MedType, 15> kMedTypes = {
    {{"PO1", 1, vtk_point, {}},
     {"SE2", 102, vtk_edge, {}},
     {"SE3", 103, vtk_edge3, {}},
     {"TR3", 203, vtk_triangle, {}},
     {"TR6", 206, vtk_triangle6, {}},
     {"QU4", 204, vtk_quad, {}},
     {"QU8", 208, vtk_quad8, {}},
     {"TE4", 304, vtk_tet, {0, 2, 1, 3}},
     {"T10", 310, vtk_tet10, {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
     {"PY5", 305, vtk_pyramid, {0, 3, 2, 1, 4}},
     {"P13", 313, vtk_pyramid13, {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10}},
     {"PE6", 306, vtk_prism, {0, 2, 1, 3, 5, 4}},
     {"P15", 315, vtk_prism15, {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13}},
     {"HE8", 308, vtk_hexahedron, {0, 3, 2, 1, 4, 7, 6, 5}},
     {"H20", 320, vtk_hexahedron20, {0, 3, 2,  1,  4,  7,  6,  5,  11, 10,
                                     9, 8, 15, 14, 13, 12, 16, 19, 18, 17}}}};

inline bool med_holds(int vtk_type) {
  return element_kind(vtk_type) != nullptr;
}

inline constexpr NameRules kMedGroupNames = {.most = 80};
inline constexpr NameRules kMedNames = {.most = 64, .slash = '!'};  ///< of meshes, families, fields

/// Of a group.
bool is_med_name(std::string_view name);

/// What a file says besides mesh, groups and fields: names, units, times. It travels as pieces of a deck.
using MedRemarks = std::map<std::string, std::string>;
MedRemarks med_remarks(const MeshData& mesh);
/// `about` is the name of a field, or empty.
std::string med_remark_key(std::string_view what, std::string_view about = {});
/// Unless the text is empty.
inline void add_med_remark(MeshData& mesh, std::string_view what, const std::string& text,
                           std::string_view about = {}) {
  if (!text.empty()) mesh.deck.push_back(med_remark_key(what, about) + '\0' + text);
}
/// How many of them a reader of another format would miss.
std::size_t med_remarks_to_miss(const MeshData& mesh);

/// A family is a part; its groups are groups. Of a field the first step is an array. @throws Error
MeshData read_med(const std::filesystem::path& file, TetPlace* question = nullptr);

/// What a family cannot name is in the group "Label_7". @throws Error
void write_med(const std::filesystem::path& file, const MeshView& mesh);

/// What names and types MED has no place for.
std::vector<std::string> not_in_med(const std::filesystem::path& file, const MeshData& mesh);

}  // namespace tetmend::formats
