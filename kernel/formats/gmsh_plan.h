// SPDX-License-Identifier: MIT
// What a Gmsh file needs to know of a mesh beforehand: entities, and what belongs to which.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kernel/formats/gmsh_elements.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// Elements of one type, in the order of the mesh.
struct GmshKind {
  int type = 0;
  std::size_t count = 0;
  std::vector<std::uint32_t> entity_of;  ///< in GmshPlan::entities of the dimension
  /// The vertices of an element in the order of the mesh. Missing for the tets of a TetMesh.
  std::function<std::span<const std::uint32_t>(std::size_t)> vertices;
  std::int64_t first_number = 1;      ///< in the file
  std::vector<std::int64_t> numbers;  ///< if they do not follow each other

  int dimension() const { return gmsh_type(type).dimension; }
  std::int64_t number(std::size_t i) const {
    return numbers.empty() ? first_number + static_cast<std::int64_t>(i) : numbers[i];
  }
};

class GmshPlan {
 public:
  /// Entities are those of the data. What belongs to none of them gets a new one: one for each
  /// part, label and set of groups. The mesh must outlive the plan.
  explicit GmshPlan(const MeshView& mesh);
  GmshPlan(const GmshPlan&) = delete;
  GmshPlan& operator=(const GmshPlan&) = delete;

  std::array<std::vector<GeometricEntity>, 4> entities;  ///< by dimension
  std::vector<GmshKind> kinds;                           ///< by dimension; tets are there always
  /// Of each point, counted through all dimensions: a point is of the entity of lowest dimension
  /// that it lies on.
  std::vector<std::uint32_t> entity_of_point;
  /// Groups that need a line in $PhysicalNames.
  std::vector<Group> names;

  std::size_t entity_count() const;
  /// Numbers of the groups of an entity, none negative that stands for a group turned round.
  std::vector<Label> groups_of(const GeometricEntity& entity) const;

 private:
  void add_points(const MeshView& mesh);
  void add_others(const MeshView& mesh, int dimension);
  void classify_points(const MeshView& mesh);
  void take_named_entities(const MeshView& mesh);
  void classify(const MeshView& mesh, const GmshKind& kind);
  void classify_alone(const MeshView& mesh);
  void add_names();
  bool has_group(int dimension, Label number) const;

  class Tables;
  const MeshData* data_;
  Tables* tables_ = nullptr;                       // while the plan is made
  std::set<std::pair<int, Label>> group_numbers_;  // of all groups of the mesh
  std::vector<std::uint32_t> point_elements_;
  std::vector<MeshData::Tet> own_tets_;
};

}  // namespace tetmend::formats
