// SPDX-License-Identifier: MIT
// Meshes of DOLFINx, FEniCS and ParaView: an XDMF file that names tables of a file of HDF5 beside it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh: its deck is ours.
inline constexpr std::string_view kXdmf = "XDMF";

struct XdmfType {
  std::string_view name;  ///< in lower case
  std::int32_t number;    ///< in a mixture
  int vtk_type;
  std::string_view other;  ///< another name
};
/// Nodes stand in VTK's order.
inline constexpr std::array<XdmfType, 15> kXdmfTypes = {
    {{"polyvertex", 1, vtk_point, {}},
     {"polyline", 2, vtk_edge, "interval"},
     {"triangle", 4, vtk_triangle, {}},
     {"quadrilateral", 5, vtk_quad, {}},
     {"tetrahedron", 6, vtk_tet, {}},
     {"pyramid", 7, vtk_pyramid, {}},
     {"wedge", 8, vtk_prism, {}},
     {"hexahedron", 9, vtk_hexahedron, {}},
     {"edge_3", 34, vtk_edge3, {}},
     {"triangle_6", 36, vtk_triangle6, "tri_6"},
     {"quadrilateral_8", 37, vtk_quad8, "quad_8"},
     {"tetrahedron_10", 38, vtk_tet10, "tet_10"},
     {"pyramid_13", 39, vtk_pyramid13, {}},
     {"wedge_15", 40, vtk_prism15, {}},
     {"hexahedron_20", 48, vtk_hexahedron20, "hex_20"}}};

inline bool xdmf_holds(int vtk_type) {
  const ElementKind* kind = element_kind(vtk_type);
  return kind != nullptr && kind->dimension > 0;
}

/// Grids on the points of the first one with tets are its faces and edges, and tags of any of them. Of steps
/// the first is kept. @throws Error
MeshData read_xdmf(const std::filesystem::path& file, const ReadRequest& request);

/// As DOLFINx writes it: a grid of the mesh, and of the tags of cells, facets and edges. @throws Error
void write_xdmf(const std::filesystem::path& file, const MeshView& mesh);

/// What arrays XDMF has no place for.
std::vector<std::string> not_in_xdmf(const std::filesystem::path& file, const MeshData& mesh);

/// The file and the tables beside it.
std::vector<std::filesystem::path> xdmf_files(const std::filesystem::path& file);

}  // namespace tetmend::formats
