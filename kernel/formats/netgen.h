// SPDX-License-Identifier: MIT
// The native text format `.vol` of the mesh generator Netgen, for meshes in space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh: its deck is ours.
inline constexpr std::string_view kNetgen = "Netgen";

// What Netgen knows of a surface element besides its boundary condition, which is the label.
inline constexpr std::string_view kNetgenSurface = "netgen:surfnr";
inline constexpr std::string_view kNetgenInside = "netgen:domin";
inline constexpr std::string_view kNetgenOutside = "netgen:domout";
inline constexpr std::string_view kNetgenTriangleNumbers = "netgen:gi";  ///< one a vertex
inline constexpr std::string_view kNetgenParameters = "netgen:uv";       ///< two a vertex
/// The rows of edgesegmentsgi2 of an edge: kNetgenSegment numbers each, 0 for the first if there is
/// no such row.
inline constexpr std::string_view kNetgenSegments = "netgen:segments";
/// Surface, direction (1: as the edge has its ends, -1), then columns 5 to 12 of the file.
inline constexpr std::size_t kNetgenSegment = 10;
/// An edge has one row for each surface that meets there.
inline constexpr std::size_t kMostSegmentsOfEdge = 16;

/// Vertex i of VTK is vertex order[i] of Netgen. Its tets are turned round.
inline constexpr std::array<std::uint8_t, 10> kNetgenTet = {0, 1, 3, 2, 4, 8, 6, 5, 7, 9};
/// The same for tets that are turned round as VTK has them.
inline constexpr std::array<std::uint8_t, 10> kNetgenTurnedTet = {0, 1, 2, 3, 4, 7, 5, 6, 8, 9};
inline constexpr std::array<std::uint8_t, 6> kNetgenTriangle6 = {0, 1, 2, 5, 3, 4};

/// Which kinds of elements it has.
inline bool netgen_holds(int vtk_type) {
  switch (vtk_type) {
    case vtk_edge3:  // by its ends
    case vtk_triangle6:
    case vtk_quad:
    case vtk_tet10:
    case vtk_hexahedron:
    case vtk_prism:
    case vtk_pyramid:
      return true;
    default:
      return false;
  }
}

/// Materials, boundary conditions, edges and point elements are labels, and named groups where they
/// have names. The geometry behind the mesh stays word for word. @throws Error
MeshData read_netgen(const std::filesystem::path& file, TetPlace* question = nullptr);

/// Which surface and which domains a triangle belongs to is found from the tets, unless the mesh is
/// from such a file. @throws Error
void write_netgen(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
