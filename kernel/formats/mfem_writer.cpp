// SPDX-License-Identifier: MIT
// Writes meshes of MFEM.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/element_sets.h"
#include "kernel/formats/mfem.h"
#include "kernel/formats/mfem_numbering.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/unique_names.h"

namespace tetmend::formats {
namespace {

/// The labels of a group whose elements are all that have them; empty: it is no such group.
std::vector<std::vector<Label>> labels_of_groups(const MeshView& mesh, const ElementLists& lists) {
  std::array<std::map<Label, std::size_t>, 4> totals;
  for (const ElementList& list : lists.all()) {
    auto& of_dimension = totals[static_cast<std::size_t>(list.kind.dimension)];
    for (std::size_t i = 0; i < list.count; ++i) ++of_dimension[list.label(i)];
  }
  std::vector<std::vector<Label>> labels;
  for (const GroupMembers& members : members_of_groups(mesh, lists)) {
    const Group& group = mesh.data()->groups[labels.size()];
    labels.emplace_back();
    if (group.dimension < 2 || group.name.empty()) continue;
    std::map<Label, std::size_t> counts;
    for (const auto& [list, i] : members.elements) ++counts[lists.all()[list].label(i)];
    const auto& total = totals[static_cast<std::size_t>(group.dimension)];
    for (const auto& [label, count] : counts) {
      if (total.at(label) == count) labels.back().push_back(label);
    }
    if (labels.back().size() < counts.size()) labels.back().clear();
  }
  return labels;
}

/// True if all volumes are tets of second order.
bool is_of_second_order(const ElementLists& lists) {
  const auto volumes = lists.of_dimension(3);
  return volumes.size() == 1 && volumes[0]->kind.vtk_type == vtk_tet10;
}

class MfemWriter {
 public:
  MfemWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file), mesh_(mesh), lists_(mesh) {}

  void write() {
    number_vertices();
    const auto labels = labels_of_groups(mesh_, lists_);
    const bool has_names = std::any_of(labels.begin(), labels.end(),
                                       [](const auto& of_group) { return !of_group.empty(); });
    out_.put(has_names ? "MFEM mesh v1.3\n\ndimension\n3\n" : "MFEM mesh v1.0\n\ndimension\n3\n");
    write_elements("elements", 3);
    if (has_names) write_sets("attribute_sets", 3, labels);
    write_elements("boundary", 2);
    if (has_names) write_sets("bdr_attribute_sets", 2, labels);
    out_.put(fmt::format("\nvertices\n{}\n", vertices_.size()));
    if (is_of_second_order(lists_)) {
      write_nodes();
    } else {
      out_.put("3\n");
      put_points(vertices_);
    }
    if (has_names) out_.put("\nmfem_mesh_end\n");
    out_.commit(mesh_.companions());
  }

 private:
  /// Mid-side nodes are no vertices.
  void number_vertices() {
    std::vector<bool> is_middle(mesh_.point_count(), false);
    for (const ElementList& list : lists_.all()) {
      for (std::size_t i = 0; i < list.count && list.kind.corners < list.kind.width; ++i) {
        for (const std::uint32_t v : list.vertices(i).subspan(list.kind.corners))
          is_middle[v] = true;
      }
    }
    number_.resize(mesh_.point_count());
    for (std::uint32_t i = 0; i < number_.size(); ++i) {
      if (is_middle[i]) continue;
      number_[i] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(i);
    }
  }

  /// Attributes count from 1: other labels get the next numbers.
  std::map<Label, Label> attributes(int dimension) const {
    std::set<Label> labels;
    for (const ElementList* list : lists_.of_dimension(dimension)) {
      for (std::size_t i = 0; i < list->count; ++i) labels.insert(list->label(i));
    }
    std::map<Label, Label> made;
    Label next = 0;
    for (const Label label : labels) {
      if (label > 0) {
        made[label] = label;
        continue;
      }
      do {
        ++next;
      } while (labels.contains(next));
      made[label] = next;
    }
    return made;
  }

  void write_elements(std::string_view section, int dimension) {
    const std::map<Label, Label> attribute_of = attributes(dimension);
    std::size_t count = 0;
    for (const ElementList* list : lists_.of_dimension(dimension)) {
      count += geometry(*list) < kMfemTypes.size() ? list->count : 0;
    }
    out_.put(fmt::format("\n{}\n{}\n", section, count));
    for (const ElementList* list : lists_.of_dimension(dimension)) {
      const std::size_t type = geometry(*list);
      if (type == kMfemTypes.size()) continue;
      put_rows(out_, list->count, [&](std::size_t i, OutputBuffer& buffer) {
        buffer.put_integer(attribute_of.at(list->label(i)));
        buffer.put(' ');
        buffer.put_integer(static_cast<std::int64_t>(type));
        for (const std::uint32_t v : list->vertices(i).first(list->kind.corners)) {
          buffer.put(' ');
          buffer.put_integer(number_[v]);
        }
        buffer.put('\n');
      });
    }
  }

  /// By the corners; kMfemTypes.size() if MFEM has no such elements.
  static std::size_t geometry(const ElementList& list) {
    const auto* found = std::find_if(kMfemTypes.begin(), kMfemTypes.end(), [&](int type) {
      const ElementKind& kind = *element_kind(type);
      return kind.dimension == list.kind.dimension && kind.width == list.kind.corners;
    });
    return static_cast<std::size_t>(found - kMfemTypes.begin());
  }

  void write_sets(std::string_view section, int dimension,
                  const std::vector<std::vector<Label>>& labels) {
    const std::map<Label, Label> attribute_of = attributes(dimension);
    UniqueNames names;
    std::string lines;
    std::size_t count = 0;
    for (std::size_t g = 0; g < labels.size(); ++g) {
      const Group& group = mesh_.data()->groups[g];
      if (labels[g].empty() || group.dimension != dimension) continue;
      std::string name = group.name;
      for (char& c : name) {
        if (c == '"' || c == '#' || static_cast<unsigned char>(c) < ' ') c = '_';
      }
      lines += fmt::format("\"{}\" {}", names.make(name), labels[g].size());
      for (const Label label : labels[g]) lines += fmt::format(" {}", attribute_of.at(label));
      lines += '\n';
      ++count;
    }
    if (count > 0) out_.put(fmt::format("\n{}\n{}\n{}", section, count, lines));
  }

  void put_points(const std::vector<std::uint32_t>& points) {
    put_rows(out_, points.size(), [&](std::size_t i, OutputBuffer& buffer) {
      const Point point = mesh_.point(points[i]);
      for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) buffer.put(' ');
        buffer.put_real(point[axis]);
      }
      buffer.put('\n');
    });
  }

  void write_nodes() {
    std::vector<std::uint32_t> nodes = vertices_;
    MfemEdges edges;
    const ElementList& tets = *lists_.of_dimension(3)[0];
    for (std::size_t i = 0; i < tets.count; ++i) {
      const auto v = tets.vertices(i);
      for (const auto& [a, b] : kMfemEdgesOfTet) {
        const std::size_t known = edges.ends.size();
        if (edges.add(v[a], v[b]) < known) continue;
        for (std::size_t e = 0; e < kMidNodeEdges.size(); ++e) {
          const auto [c, d] = kMidNodeEdges[e];
          if (std::min(c, d) == a && std::max(c, d) == b) nodes.push_back(v[4 + e]);
        }
      }
    }
    out_.put(
        "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\nVDim: 3\nOrdering: 1\n\n");
    put_points(nodes);
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  std::vector<std::uint32_t> vertices_;  // points that are no mid-side nodes
  std::vector<std::uint32_t> number_;    // of each point, among these
};

}  // namespace

bool is_mfem_name(std::string_view name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](char c) {
    return c == '"' || c == '#' || static_cast<unsigned char>(c) < ' ';
  });
}

void write_mfem(const std::filesystem::path& file, const MeshView& mesh) {
  MfemWriter(file, mesh).write();
}

std::vector<std::string> not_in_mfem(const std::filesystem::path& file, const MeshData& mesh) {
  const std::string extension = file.extension().string();
  std::vector<std::string> notes;
  const MeshView view(mesh);
  const ElementLists lists(view);
  std::size_t lost = 0;
  const auto labels = labels_of_groups(view, lists);
  for (std::size_t g = 0; g < labels.size(); ++g) {
    lost += labels[g].empty() && !mesh.groups[g].name.empty() ? 1 : 0;
  }
  if (lost > 0) {
    notes.push_back(fmt::format(
        "{} groups, with their names, are not kept: {} has names of whole attributes alone", lost,
        extension));
  }
  if (!mesh.mid_nodes.empty() && lists.of_dimension(3).size() > 1) {
    notes.push_back(fmt::format("{} mid-side nodes are not kept: {} has them of tets alone",
                                mesh.mid_nodes.size(), extension));
  }
  return notes;
}

}  // namespace tetmend::formats
