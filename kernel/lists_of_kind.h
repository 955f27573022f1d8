// SPDX-License-Identifier: MIT
// All that a MeshData has of one kind of element.
#pragma once

#include "kernel/mesh_data.h"

namespace tetmend {

template <class Elements, class Labels, class Numbers, class Data>
struct ListsOfKind {
  Elements& elements;
  Labels& parts;
  Numbers& numbers;
  Data& data;
};

template <class Elements, class Labels, class Numbers, class Data>
ListsOfKind(Elements&, Labels&, Numbers&, Data&) -> ListsOfKind<Elements, Labels, Numbers, Data>;

template <class Mesh>
auto tets_of(Mesh& mesh) {
  return ListsOfKind{mesh.tets, mesh.tet_parts, mesh.tet_numbers, mesh.tet_data};
}
template <class Mesh>
auto triangles_of(Mesh& mesh) {
  return ListsOfKind{mesh.triangles, mesh.triangle_parts, mesh.triangle_numbers,
                     mesh.triangle_data};
}
template <class Mesh>
auto edges_of(Mesh& mesh) {
  return ListsOfKind{mesh.edges, mesh.edge_parts, mesh.edge_numbers, mesh.edge_data};
}

}  // namespace tetmend
