// SPDX-License-Identifier: MIT
// The elements of a Gmsh file as it lists them, and how they become a mesh with groups.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "kernel/formats/gmsh_elements.h"
#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/tet_place.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Elements of one type.
struct GmshRows {
  std::vector<std::int64_t> tags;
  std::vector<Label> labels;  ///< the first group
  std::vector<Label> parts;   ///< the entity
  std::vector<std::uint32_t> vertices;
  std::vector<const char*> places;  ///< in the file; none if nobody asks for a place

  std::size_t size() const { return tags.size(); }
  void shorten(std::size_t size, std::size_t width) {
    tags.resize(size);
    labels.resize(size);
    parts.resize(size);
    vertices.resize(size * width);
    if (!places.empty()) places.resize(size);
  }
  std::span<const std::uint32_t> vertices_of(std::size_t i, std::size_t width) const {
    return {vertices.data() + i * width, width};
  }
};

class GmshDraft {
 public:
  std::array<GmshRows, kGmshTypes> rows;  ///< by type
  std::vector<Group> named;               ///< without parts and members
  /// Groups of each entity, by dimension and number.
  std::map<std::pair<int, Label>, std::vector<Label>> groups_of;

  /// Of each entity of a partition the one that it is a piece of, by dimension and number. Of a higher
  /// dimension: it lies between partitions, and its elements are not of the mesh.
  std::map<std::pair<int, Label>, std::pair<int, Label>> parents;

  /// Puts elements that are listed once for each of their groups together, as version 2.2 has them,
  /// and fills `groups_of`. Elements of one entity in different groups get different parts.
  void merge_repeated();
  /// Elements in the order of their numbers.
  void sort();
  /// Moves elements and groups into `mesh`. `tags` are the numbers of its tets, triangles and
  /// edges in the file.
  void move_into(MeshData& mesh, std::array<GmshTags, 3>& tags);

 private:
  void add_groups(MeshData& mesh);
  void add_points(MeshData& mesh);
};

}  // namespace tetmend::formats
