// SPDX-License-Identifier: MIT
// Input files of FEBio, `.feb`: the mesh of a model, with all else word for word.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// MeshData::variant of such a mesh. The first piece of its deck are deck_remarks(); the others follow
/// the file, each with a letter of FebioPiece in front.
inline constexpr std::string_view kFebio = "FEBio";

enum FebioPiece : char {
  febio_text = 'T',       ///< word for word
  febio_nodes = 'N',      ///< the nodes of a block: the number of its group, 0 for the first block
  febio_elements = 'E',   ///< the tets of a block: its label
  febio_materials = 'M',  ///< tets of a block that names their materials: 0, then these labels
  febio_list = 'L',       ///< a set of elements with tets, as a list: the number of its group
  febio_tags = 'G',       ///< likewise, with an element of XML for each; then the name of that
  febio_node_list = 'l',  ///< the same for sets of nodes
  febio_node_tags = 'g',
  febio_surface = 'F',       ///< the facets of a surface: the number of its group
  febio_label_surface = 'f'  ///< likewise: their label
};

struct FebioType {
  std::string_view name;
  int vtk_type;
};

/// Nodes come in VTK's order. A type that comes again is read only.
inline constexpr std::array<FebioType, 13> kFebioTypes = {{{"tet4", vtk_tet},
                                                           {"tet10", vtk_tet10},
                                                           {"hex8", vtk_hexahedron},
                                                           {"hex20", vtk_hexahedron20},
                                                           {"penta6", vtk_prism},
                                                           {"penta15", vtk_prism15},
                                                           {"pyra5", vtk_pyramid},
                                                           {"pyra13", vtk_pyramid13},
                                                           {"tri3", vtk_triangle},
                                                           {"tri6", vtk_triangle6},
                                                           {"quad4", vtk_quad},
                                                           {"quad8", vtk_quad8},
                                                           {"ut4", vtk_tet}}};

/// Which kinds of elements it has.
inline bool febio_holds(int vtk_type) {
  for (const FebioType& type : kFebioTypes) {
    if (type.vtk_type == vtk_type) return true;
  }
  return false;
}

/// Labels of tets count the blocks of elements, or are their materials where a block has several, as
/// in version 1.2. Points that the rest of the model names become
/// required vertices; facets of surfaces are triangles, and stay in the model. @throws Error
MeshData read_febio(const std::filesystem::path& file, TetPlace* question = nullptr);

/// A mesh of another format becomes the mesh of a model of version 4.0. @throws Error
void write_febio(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend::formats
