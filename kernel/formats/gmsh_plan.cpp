// SPDX-License-Identifier: MIT
// What a Gmsh file needs to know of a mesh beforehand: entities, and what belongs to which.
#include "kernel/formats/gmsh_plan.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "kernel/formats/gmsh_entities.h"

namespace tetmend::formats {

/// The entities while they are collected.
class GmshPlan::Tables {
 public:
  explicit Tables(const MeshData* data)
      : of_{GmshEntities(data, 0), GmshEntities(data, 1), GmshEntities(data, 2),
            GmshEntities(data, 3)} {}

  GmshEntities& operator[](int dimension) { return of_[static_cast<std::size_t>(dimension)]; }

 private:
  std::array<GmshEntities, 4> of_;
};

namespace {

constexpr std::uint32_t kNoEntity = UINT32_MAX;
constexpr int kIndexBits = 30;

/// An entity before those of all dimensions are counted.
std::uint32_t code(int dimension, std::uint32_t index) {
  return static_cast<std::uint32_t>(dimension) << kIndexBits | index;
}

/// Finds entities for elements, one by one.
class Assignment {
 public:
  Assignment(const MeshView& mesh, GmshEntities& table, const GmshMembership& membership)
      : mesh_(mesh), table_(table), membership_(membership) {}

  /// An element of a kind without parts is of the entity for its label.
  std::uint32_t operator()(std::size_t i, const std::vector<Label>* parts, Label label,
                           std::span<const std::uint32_t> vertices) {
    const bool has_part = parts != nullptr && !parts->empty();
    const std::uint32_t set = membership_.set_of(i);
    const std::uint32_t entity = table_.find({has_part, has_part ? (*parts)[i] : label, label, set},
                                             membership_.groups(set));
    if (table_.is_new(entity)) {
      for (const std::uint32_t v : vertices) table_.extend(entity, mesh_.point(v));
    }
    return entity;
  }

 private:
  const MeshView& mesh_;
  GmshEntities& table_;
  const GmshMembership& membership_;
};

template <class Element>
GmshKind plan_kind(const MeshView& mesh, GmshEntities& table, int type,
                   std::span<const Element> elements, const std::vector<Label>* parts) {
  GmshKind kind;
  kind.type = type;
  kind.count = elements.size();
  kind.vertices = [elements](std::size_t i) {
    return std::span<const std::uint32_t>(elements[i].vertices);
  };
  const GmshMembership membership(mesh.data(), kind.dimension(), kind.count);
  Assignment assign(mesh, table, membership);
  kind.entity_of.resize(kind.count);
  for (std::size_t i = 0; i < kind.count; ++i) {
    kind.entity_of[i] = assign(i, parts, elements[i].label, elements[i].vertices);
  }
  return kind;
}

/// The tets of a TetMesh come in blocks; `own` gets a copy of them if they are of several entities.
GmshKind plan_tets(const MeshView& mesh, GmshEntities& table, std::vector<MeshData::Tet>& own) {
  GmshKind kind;
  kind.type = gmsh_tet;
  kind.count = mesh.tet_count();
  const GmshMembership membership(nullptr, 3, 0);
  Assignment assign(mesh, table, membership);
  kind.entity_of.resize(kind.count);
  std::size_t number = 0;
  std::vector<MeshData::Tet> memory;
  for (std::size_t block = 0; block < mesh.tet_blocks(); ++block) {
    for (const MeshData::Tet& tet : mesh.tets(block, memory)) {
      kind.entity_of[number++] = assign(0, nullptr, tet.label, tet.vertices);
    }
  }
  const auto& all = kind.entity_of;
  if (std::adjacent_find(all.begin(), all.end(), std::not_equal_to<>()) == all.end()) return kind;
  own.reserve(kind.count);
  for (std::size_t block = 0; block < mesh.tet_blocks(); ++block) {
    const auto tets = mesh.tets(block, memory);
    own.insert(own.end(), tets.begin(), tets.end());
  }
  kind.vertices = [&own](std::size_t i) { return std::span<const std::uint32_t>(own[i].vertices); };
  return kind;
}

}  // namespace

GmshPlan::GmshPlan(const MeshView& mesh) : data_(mesh.data()) {
  if (data_ != nullptr) {
    for (const Group& group : data_->groups) group_numbers_.insert({group.dimension, group.number});
  }
  Tables tables(data_);
  tables_ = &tables;
  add_points(mesh);
  kinds.push_back(plan_kind(mesh, tables[1], gmsh_edge, mesh.edges(),
                            data_ == nullptr ? nullptr : &data_->edge_parts));
  add_others(mesh, 1);
  kinds.push_back(plan_kind(mesh, tables[2], gmsh_triangle, mesh.triangles(),
                            data_ == nullptr ? nullptr : &data_->triangle_parts));
  add_others(mesh, 2);
  if (data_ == nullptr) {
    kinds.push_back(plan_tets(mesh, tables[3], own_tets_));
  } else {
    kinds.push_back(plan_kind(mesh, tables[3], gmsh_tet,
                              std::span<const MeshData::Tet>(data_->tets), &data_->tet_parts));
  }
  add_others(mesh, 3);
  classify_points(mesh);
  tables_ = nullptr;
  std::int64_t number = 1;
  for (GmshKind& kind : kinds) {
    kind.first_number = number;
    number += static_cast<std::int64_t>(kind.count);
  }
  add_names();
}

/// Points in groups, then those that are elements without one: so they are read again.
void GmshPlan::add_points(const MeshView& mesh) {
  if (data_ == nullptr) return;
  GmshEntities& table = (*tables_)[0];
  const GmshMembership membership(data_, 0, mesh.point_count());
  Label next = 0;
  const auto entity_of = [&](std::uint32_t v, Label part) {
    const std::uint32_t set = membership.set_of(v);
    const bool is_vertex = !data_->point_entities.empty() && data_->point_entities[v][0] == 0;
    if (is_vertex) part = data_->point_entities[v][1];
    if (!is_vertex && part <= 0) {
      const std::uint32_t alone = table.alone_at(mesh.point(v), membership.groups(set));
      if (alone != GmshEntities::kNone) return alone;
      part = --next;  // below 0 they are of no entity: each of these points gets one of its own
    }
    const std::uint32_t entity = table.find({true, part, 0, set}, membership.groups(set));
    if (table.is_new(entity)) table.extend(entity, mesh.point(v));
    return entity;
  };
  std::map<std::uint32_t, std::uint32_t> grouped;  // entities by point
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rest;
  const auto add = [&](std::uint32_t v, Label part) {
    const std::uint32_t entity = entity_of(v, part);
    if (table.has_groups(entity)) {
      grouped.emplace(v, entity);
    } else {
      rest.emplace_back(v, entity);
    }
  };
  for (std::uint32_t i = 0; i < mesh.point_count(); ++i) {
    if (membership.set_of(i) != 0) add(i, 0);
  }
  for (const OtherElements& others : data_->other_elements) {
    if (others.vtk_type != gmsh_type(gmsh_point).vtk_type) continue;
    for (std::size_t i = 0; i < others.vertices.size(); ++i) {
      if (membership.set_of(others.vertices[i]) != 0) continue;
      add(others.vertices[i], others.parts.empty() ? 0 : others.parts[i]);
    }
  }
  GmshKind kind;
  kind.type = gmsh_point;
  const auto take = [&](const auto& rows) {
    for (const auto& [v, entity] : rows) {
      point_elements_.push_back(v);
      kind.entity_of.push_back(entity);
    }
  };
  take(grouped);
  take(rest);
  kind.count = point_elements_.size();
  kind.vertices = [this](std::size_t i) {
    return std::span<const std::uint32_t>(&point_elements_[i], 1);
  };
  kinds.push_back(std::move(kind));
}

void GmshPlan::add_others(const MeshView& mesh, int dimension) {
  if (data_ == nullptr) return;
  for (const OtherElements& others : data_->other_elements) {
    const int type = gmsh_type_of_vtk(others.vtk_type, others.vertex_count);
    if (type == 0 || type == gmsh_point || gmsh_type(type).dimension != dimension) continue;
    GmshKind kind;
    kind.type = type;
    kind.count = others.labels.size();
    kind.vertices = [&others](std::size_t i) {
      return std::span<const std::uint32_t>(others.vertices)
          .subspan(i * others.vertex_count, others.vertex_count);
    };
    const GmshMembership membership(nullptr, dimension, 0);
    Assignment assign(mesh, (*tables_)[dimension], membership);
    for (std::size_t i = 0; i < kind.count; ++i) {
      kind.entity_of.push_back(assign(i, &others.parts, others.labels[i], kind.vertices(i)));
    }
    kinds.push_back(std::move(kind));
  }
}

void GmshPlan::classify_points(const MeshView& mesh) {
  entity_of_point.assign(mesh.point_count(), kNoEntity);
  if (data_ != nullptr && !data_->point_entities.empty()) take_named_entities(mesh);
  for (const GmshKind& kind : kinds) classify(mesh, kind);
  std::array<std::uint32_t, 4> offsets{};
  std::uint32_t sum = 0;
  for (int dimension = 0; dimension < 4; ++dimension) {
    GmshEntities& table = (*tables_)[dimension];
    // What is of nothing is in a volume.
    if (dimension == 3 && table.size() == 0 && mesh.point_count() > 0) classify_alone(mesh);
    const auto d = static_cast<std::size_t>(dimension);
    entities[d] = table.finish();
    offsets[d] = sum;
    sum += static_cast<std::uint32_t>(entities[d].size());
  }
  for (std::uint32_t& entity : entity_of_point) {
    if (entity == kNoEntity) entity = code(3, 0);
    entity = offsets[entity >> kIndexBits] + (entity & ((1U << kIndexBits) - 1));
  }
}

void GmshPlan::take_named_entities(const MeshView& mesh) {
  std::array<Label, 2> last = {-1, 0};
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < entity_of_point.size(); ++i) {
    const std::array<Label, 2>& entity = data_->point_entities[i];
    if (entity[0] < 0 || entity[0] > 3) continue;
    GmshEntities& table = (*tables_)[entity[0]];
    if (entity != last) found = table.of_number(entity[1]);
    last = entity;
    if (table.is_new(found)) table.extend(found, mesh.point(i));
    entity_of_point[i] = code(entity[0], found);
  }
}

/// Points without an entity are of that of an element; kinds come by dimension, the lowest first.
void GmshPlan::classify(const MeshView& mesh, const GmshKind& kind) {
  const auto take = [&](std::size_t i, std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t v : vertices) {
      if (entity_of_point[v] == kNoEntity) {
        entity_of_point[v] = code(kind.dimension(), kind.entity_of[i]);
      }
    }
  };
  if (kind.vertices) {
    for (std::size_t i = 0; i < kind.count; ++i) take(i, kind.vertices(i));
    return;
  }
  std::vector<MeshData::Tet> memory;
  for (std::size_t block = 0; block < mesh.tet_blocks(); ++block) {
    for (const MeshData::Tet& tet : mesh.tets(block, memory)) take(0, tet.vertices);
  }
}

/// A volume for points of a mesh that has none.
void GmshPlan::classify_alone(const MeshView& mesh) {
  const std::uint32_t volume = (*tables_)[3].of_number(1);
  for (std::size_t i = 0; i < mesh.point_count(); ++i) (*tables_)[3].extend(volume, mesh.point(i));
}

std::size_t GmshPlan::entity_count() const {
  std::size_t count = 0;
  for (const auto& of_dimension : entities) count += of_dimension.size();
  return count;
}

bool GmshPlan::has_group(int dimension, Label number) const {
  return group_numbers_.contains({dimension, number});
}

std::vector<Label> GmshPlan::groups_of(const GeometricEntity& entity) const {
  std::vector<Label> numbers;
  std::unordered_set<Label> known;
  for (const Label group : entity.groups) {
    const bool is_turned = group < 0 && group > INT32_MIN && !has_group(entity.dimension, group);
    const bool stands_for_other = is_turned && has_group(entity.dimension, -group);
    const Label number = stands_for_other ? -group : group;
    if (known.insert(number).second) numbers.push_back(number);
  }
  return numbers;
}

/// A negative number without a line of its own would be read as a group turned round.
void GmshPlan::add_names() {
  std::set<std::pair<int, Label>> named;
  const auto add = [&](int dimension, Label number, const std::string& name) {
    if ((!name.empty() || number < 0) && named.insert({dimension, number}).second) {
      names.push_back({dimension, number, name, {}, {}});
    }
  };
  if (data_ != nullptr) {
    for (const Group& group : data_->groups) add(group.dimension, group.number, group.name);
  }
  for (const auto& of_dimension : entities) {
    for (const GeometricEntity& entity : of_dimension) {
      for (const Label number : groups_of(entity)) add(entity.dimension, number, {});
    }
  }
}

}  // namespace tetmend::formats
