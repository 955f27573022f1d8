// SPDX-License-Identifier: MIT
// The elements of a MED file, type by type, and the fields of their values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/hdf5_file.h"
#include "kernel/formats/med.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Elements of one type.
struct MedBlock {
  const MedType* type = nullptr;
  std::string path;
  std::size_t count = 0;
  std::vector<std::int64_t> nodes;     // first nodes of all, then second ones...
  std::vector<std::int64_t> families;  // one for each, or none
  std::vector<std::int64_t> numbers;

  Label family(std::size_t i) const {
    return families.empty() ? 0 : static_cast<Label>(families[i]);
  }
  const ElementKind& kind() const { return *element_kind(type->vtk_type); }
};

/// What a mesh has of one kind of element beside the elements.
struct MedLists {
  std::vector<Label>& parts;
  std::vector<DataArray>& data;
};
inline MedLists med_lists_of(const ElementKind& kind, ElementSorter& sorter, MeshData& mesh) {
  switch (kind.vtk_type) {
    case vtk_tet:
      return {mesh.tet_parts, mesh.tet_data};
    case vtk_triangle:
      return {mesh.triangle_parts, mesh.triangle_data};
    case vtk_edge:
      return {mesh.edge_parts, mesh.edge_data};
    default:
      OtherElements& others = sorter.others(kind);
      return {others.parts, others.data};
  }
}

/// Adds an array for each field of the mesh `name`: the values of its first step. What is not kept is
/// told. Precondition: `sorter` has all elements of the blocks. @throws Error
void read_med_fields(const Hdf5Reader& file, const std::string& name,
                     std::span<const MedBlock> blocks, ElementSorter& sorter, MeshData& mesh);

}  // namespace tetmend::formats
