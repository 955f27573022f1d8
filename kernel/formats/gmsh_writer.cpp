// SPDX-License-Identifier: MIT
// Writes Gmsh's files of versions 2.2 and 4.1.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/gmsh_plan.h"
#include "kernel/formats/gmsh_rows.h"
#include "kernel/formats/output_rows.h"

namespace tetmend::formats {
namespace {

/// Numbers 0, 1, ... in groups.
struct Grouped {
  Grouped(std::span<const std::uint32_t> group_of, std::size_t groups) : first(groups + 1) {
    for (const std::uint32_t group : group_of) ++first[group + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    order.resize(group_of.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[next[group_of[i]]++] = static_cast<std::uint32_t>(i);
    }
  }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(order).subspan(first[group], first[group + 1] - first[group]);
  }

  std::vector<std::size_t> first;
  std::vector<std::uint32_t> order;
};

double value_at(const DataArray& array, std::size_t i) {
  return std::visit([i](const auto& values) { return static_cast<double>(values[i]); },
                    array.values);
}

class GmshWriter : private GmshSections {
 public:
  GmshWriter(OutputFile& out, std::string name, const MeshView& mesh, GmshPlan& plan, bool is_4,
             bool binary, bool is_part = false)
      : GmshSections(out, name, is_4, binary),
        out_(out),
        name_(std::move(name)),
        mesh_(mesh),
        plan_(plan),
        is_4_(is_4),
        binary_(binary),
        is_part_(is_part) {}

  void write() {
    write_header();
    write_names(plan_.names);
    if (is_4_) {
      write_entities(plan_.entities);
      write_nodes_4();
      write_elements_4();
    } else {
      write_nodes_2();
      write_elements_2();
    }
    write_periodic();
    write_views();
  }

 private:
  const std::vector<std::int64_t>& given_numbers() const {
    static const std::vector<std::int64_t> kNone;
    return is_part_ ? mesh_.data()->point_numbers : kNone;
  }
  /// The number of a point in the file.
  std::int64_t node(std::size_t point) const {
    return is_part_ ? mesh_.data()->point_numbers[point] : static_cast<std::int64_t>(point) + 1;
  }

  void write_nodes_2() {
    begin("Nodes");
    out_.put(fmt::format("{}\n", mesh_.point_count()));
    put_rows(out_, mesh_.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
      GmshRow(buffer, binary_)
          .integer(static_cast<std::int64_t>(i) + 1)
          .point(mesh_.point(i))
          .end();
    });
    end_numbers("Nodes");
  }

  void write_nodes_4() {
    begin("Nodes");
    const Grouped points(plan_.entity_of_point, plan_.entity_count());
    std::size_t blocks = 0;
    for (std::size_t i = 0; i < plan_.entity_count(); ++i) blocks += points[i].empty() ? 0 : 1;
    const std::size_t count = mesh_.point_count();
    const auto& given = given_numbers();
    const std::int64_t least = given.empty() ? 1 : *std::min_element(given.begin(), given.end());
    const std::int64_t most = given.empty() ? static_cast<std::int64_t>(count)
                                            : *std::max_element(given.begin(), given.end());
    row().size(blocks).size(count).wide(count == 0 ? 0 : least).wide(most).end();
    std::size_t number = 0;
    for (const auto& of_dimension : plan_.entities) {
      for (const GeometricEntity& entity : of_dimension) write_node_block(entity, points[number++]);
    }
    end_numbers("Nodes");
  }

  void write_node_block(const GeometricEntity& entity, std::span<const std::uint32_t> points) {
    if (points.empty()) return;
    row().integer(entity.dimension).integer(entity.tag).integer(0).size(points.size()).end();
    put_rows(out_, points.size(), [&](std::size_t i, OutputBuffer& buffer) {
      GmshRow(buffer, binary_).wide(node(points[i])).end();
    });
    put_rows(out_, points.size(), [&](std::size_t i, OutputBuffer& buffer) {
      GmshRow(buffer, binary_).point(mesh_.point(points[i])).end();
    });
  }

  /// The numbers of the vertices in Gmsh's order.
  template <class Put>
  void put_vertices(int type, std::span<const std::uint32_t> vertices, const Put& put) const {
    const GmshType& kind = gmsh_type(type);
    if (!kind.has_own_order()) {
      for (const std::uint32_t v : vertices) put(node(v));
      return;
    }
    std::array<std::uint32_t, 27> listed{};
    for (std::size_t k = 0; k < vertices.size(); ++k) listed[kind.order[k]] = vertices[k];
    for (std::size_t k = 0; k < vertices.size(); ++k) put(node(listed[k]));
  }

  void write_elements_4() {
    begin("Elements");
    std::vector<Grouped> grouped;
    std::size_t blocks = 0;
    std::size_t count = 0;
    for (const GmshKind& kind : plan_.kinds) {
      const std::size_t groups = entities_of(kind).size();
      grouped.emplace_back(kind.entity_of, groups);
      for (std::size_t i = 0; i < groups; ++i) blocks += grouped.back()[i].empty() ? 0 : 1;
      count += kind.count;
    }
    const auto [least, most] = element_numbers(count);
    row().size(blocks).size(count).wide(least).wide(most).end();
    for (int dimension = 0; dimension < 4; ++dimension) {
      const auto& entities = plan_.entities[static_cast<std::size_t>(dimension)];
      for (std::size_t i = 0; i < entities.size(); ++i) {
        for (std::size_t k = 0; k < grouped.size(); ++k) {
          if (plan_.kinds[k].dimension() != dimension) continue;
          write_element_block(plan_.kinds[k], entities[i].tag, grouped[k][i]);
        }
      }
    }
    end_numbers("Elements");
  }

  /// The least and the greatest.
  std::pair<std::int64_t, std::int64_t> element_numbers(std::size_t count) const {
    if (count == 0) return {0, 0};
    if (!is_part_) return {1, static_cast<std::int64_t>(count)};
    std::int64_t least = INT64_MAX;
    std::int64_t most = 0;
    for (const GmshKind& kind : plan_.kinds) {
      if (kind.numbers.empty()) continue;
      const auto [low, high] = std::minmax_element(kind.numbers.begin(), kind.numbers.end());
      least = std::min(least, *low);
      most = std::max(most, *high);
    }
    return {least, most};
  }

  const std::vector<GeometricEntity>& entities_of(const GmshKind& kind) const {
    return plan_.entities[static_cast<std::size_t>(kind.dimension())];
  }

  void write_element_block(const GmshKind& kind, Label entity,
                           std::span<const std::uint32_t> elements) {
    if (elements.empty()) return;
    row().integer(kind.dimension()).integer(entity).integer(kind.type).size(elements.size()).end();
    const auto put = [&](std::size_t i, std::span<const std::uint32_t> vertices,
                         OutputBuffer& buffer) {
      GmshRow numbers(buffer, binary_);
      numbers.wide(kind.number(i));
      put_vertices(kind.type, vertices, [&](std::int64_t v) { numbers.wide(v); });
      numbers.end();
    };
    if (!kind.vertices) {
      return put_tets(out_, mesh_,
                      [&](std::size_t i, const MeshData::Tet& tet, OutputBuffer& buffer) {
                        put(i, tet.vertices, buffer);
                      });
    }
    put_rows(out_, elements.size(), [&](std::size_t i, OutputBuffer& buffer) {
      put(elements[i], kind.vertices(elements[i]), buffer);
    });
  }

  // An element is listed once for each of its groups, which gives it several numbers.
  void write_elements_2() {
    std::vector<std::vector<std::vector<Label>>> groups;
    std::size_t count = 0;
    for (GmshKind& kind : plan_.kinds) {
      auto& of_entity = groups.emplace_back();
      for (const GeometricEntity& entity : entities_of(kind)) {
        of_entity.push_back(plan_.groups_of(entity));
        if (of_entity.back().empty()) of_entity.back().push_back(0);
      }
      count += number_rows(kind, of_entity, static_cast<std::int64_t>(count) + 1);
    }
    if (count > INT32_MAX) {
      throw Error(
          fmt::format("{}: cannot be written: version 2.2 of the format holds at most {} "
                      "elements, the mesh has {}",
                      name_, INT32_MAX, count));
    }
    begin("Elements");
    out_.put(fmt::format("{}\n", count));
    for (std::size_t k = 0; k < plan_.kinds.size(); ++k) write_kind_2(plan_.kinds[k], groups[k]);
    end_numbers("Elements");
  }

  static std::size_t number_rows(GmshKind& kind, const std::vector<std::vector<Label>>& groups,
                                 std::int64_t first) {
    kind.first_number = first;
    const auto is_single = [](const std::vector<Label>& of_entity) {
      return of_entity.size() == 1;
    };
    if (std::all_of(groups.begin(), groups.end(), is_single)) return kind.count;
    std::int64_t number = first;
    for (const std::uint32_t entity : kind.entity_of) {
      kind.numbers.push_back(number);
      number += static_cast<std::int64_t>(groups[entity].size());
    }
    return static_cast<std::size_t>(number - first);
  }

  void write_kind_2(const GmshKind& kind, const std::vector<std::vector<Label>>& groups) {
    if (kind.count == 0) return;
    if (binary_) {
      std::size_t rows = 0;
      for (const std::uint32_t entity : kind.entity_of) rows += groups[entity].size();
      row().integer(kind.type).integer(static_cast<std::int64_t>(rows)).integer(2);
    }
    const auto& entities = entities_of(kind);
    const auto put = [&](std::size_t i, std::span<const std::uint32_t> vertices,
                         OutputBuffer& buffer) {
      const std::uint32_t entity = kind.entity_of[i];
      std::int64_t number = kind.number(i);
      for (const Label group : groups[entity]) {
        GmshRow numbers(buffer, binary_);
        numbers.integer(number++);
        if (!binary_) numbers.integer(kind.type).integer(2);
        numbers.integer(group).integer(entities[entity].tag);
        put_vertices(kind.type, vertices, [&](std::int64_t v) { numbers.integer(v); });
        numbers.end();
      }
    };
    if (kind.type == gmsh_tet && !kind.vertices) {
      return put_tets(out_, mesh_,
                      [&](std::size_t i, const MeshData::Tet& tet, OutputBuffer& buffer) {
                        put(i, tet.vertices, buffer);
                      });
    }
    put_rows(out_, kind.count,
             [&](std::size_t i, OutputBuffer& buffer) { put(i, kind.vertices(i), buffer); });
  }

  void write_periodic() {
    if (mesh_.data() == nullptr || mesh_.data()->periodic.empty()) return;
    const std::vector<PeriodicLink>& links = mesh_.data()->periodic;
    begin("Periodic");
    if (is_4_) {
      row().size(links.size()).end();
    } else {
      out_.put(fmt::format("{}\n", links.size()));
    }
    for (const PeriodicLink& link : links) is_4_ ? write_link_4(link) : write_link_2(link);
    is_4_ ? end_numbers("Periodic") : end("Periodic");
  }

  void write_link_4(const PeriodicLink& link) {
    row().integer(link.dimension).integer(link.tag).integer(link.master).end();
    auto affine = row();
    affine.size(link.affine.size());
    for (const double number : link.affine) affine.real(number);
    affine.end();
    row().size(link.points.size()).end();
    for (const auto& pair : link.points) {
      row().wide(std::int64_t{pair[0]} + 1).wide(std::int64_t{pair[1]} + 1).end();
    }
  }

  // Text in both codings.
  void write_link_2(const PeriodicLink& link) {
    out_.put(fmt::format("{} {} {}\n", link.dimension, link.tag, link.master));
    if (!link.affine.empty()) out_.put(fmt::format("Affine {}\n", fmt::join(link.affine, " ")));
    out_.put(fmt::format("{}\n", link.points.size()));
    for (const auto& pair : link.points) {
      out_.put(fmt::format("{} {}\n", std::int64_t{pair[0]} + 1, std::int64_t{pair[1]} + 1));
    }
  }

  void write_views() {
    if (mesh_.has_point_labels()) {
      write_view_head("NodeData", kGmshPointLabels, 1, mesh_.point_count());
      put_rows(out_, mesh_.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
        GmshRow(buffer, binary_).integer(node(i)).real(mesh_.point_label(i)).end();
      });
      end_numbers("NodeData");
    }
    if (mesh_.data() == nullptr) return;
    std::set<std::string_view> names;
    for (const DataArray& array : mesh_.data()->point_data) {
      if (!names.insert(array.name).second) continue;  // which lost_in() says
      write_view_head("NodeData", array.name, array.components, mesh_.point_count());
      write_values(array, mesh_.point_count(),
                   [](std::size_t i) { return static_cast<std::int64_t>(i) + 1; });
      end_numbers("NodeData");
    }
    write_element_views();
  }

  template <class Number>
  void write_values(const DataArray& array, std::size_t count, const Number& number) {
    put_rows(out_, count, [&](std::size_t i, OutputBuffer& buffer) {
      GmshRow numbers(buffer, binary_);
      numbers.integer(number(i));
      for (std::size_t k = 0; k < array.components; ++k) {
        numbers.real(value_at(array, i * array.components + k));
      }
      numbers.end();
    });
  }

  /// Arrays of one name on tets, triangles and edges are one view.
  void write_element_views() {
    struct OfKind {
      const GmshKind* kind;
      const DataArray* array;
    };
    std::vector<std::pair<std::string, std::size_t>> names;
    std::map<std::pair<std::string, std::size_t>, std::vector<OfKind>> views;
    for (const GmshKind& kind : plan_.kinds) {
      std::set<std::string_view> of_kind;
      for (const DataArray& array : data_of(kind)) {
        if (array.size() != array.components * kind.count) continue;
        if (!of_kind.insert(array.name).second) continue;  // likewise
        const std::pair key(array.name, array.components);
        if (!views.contains(key)) names.push_back(key);
        views[key].push_back({&kind, &array});
      }
    }
    for (const auto& name : names) {
      std::size_t count = 0;
      for (const OfKind& part : views[name]) count += part.kind->count;
      write_view_head("ElementData", name.first, name.second, count);
      for (const OfKind& part : views[name]) {
        write_values(*part.array, part.kind->count,
                     [&](std::size_t i) { return part.kind->number(i); });
      }
      end_numbers("ElementData");
    }
  }

  std::span<const DataArray> data_of(const GmshKind& kind) const {
    if (kind.type == gmsh_tet) return mesh_.data()->tet_data;
    if (kind.type == gmsh_triangle) return mesh_.data()->triangle_data;
    if (kind.type == gmsh_edge) return mesh_.data()->edge_data;
    return {};
  }

  OutputFile& out_;
  std::string name_;  // of the file, for messages
  const MeshView& mesh_;
  GmshPlan& plan_;
  bool is_4_;
  bool binary_;
  bool is_part_;  // with the numbers of the data
};

}  // namespace

void write_gmsh(const std::filesystem::path& file, const MeshView& mesh) {
  const std::string_view variant = mesh.variant();
  const bool is_2 = variant == "2.2 ASCII" || variant == "2.2 binary";
  const bool binary = variant != "2.2 ASCII" && variant != "4.1 ASCII";
  OutputFile out(file);
  GmshPlan plan(mesh);
  GmshWriter(out, file.string(), mesh, plan, !is_2, binary).write();
  out.commit(mesh.companions());
}

void write_gmsh_part(const std::filesystem::path& file, const MeshData& mesh) {
  const auto is_wide = [](std::int64_t number) { return number > INT32_MAX; };
  if (!mesh.point_labels.empty() &&
      std::any_of(mesh.point_numbers.begin(), mesh.point_numbers.end(), is_wide)) {
    throw Error(fmt::format(
        "{}: cannot be written: labels of points have numbers of at most 31 bits", file.string()));
  }
  const MeshView view(mesh);
  OutputFile out(file);
  GmshPlan plan(view);
  for (GmshKind& kind : plan.kinds) {
    kind.numbers = kind.type == gmsh_tet        ? mesh.tet_numbers
                   : kind.type == gmsh_triangle ? mesh.triangle_numbers
                                                : mesh.edge_numbers;
  }
  GmshWriter(out, file.string(), view, plan, true, true, true).write();
  out.commit();
}

}  // namespace tetmend::formats
