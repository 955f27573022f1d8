// SPDX-License-Identifier: MIT
// Leaves out of every list of a mesh what does not belong to some tets.
#include "face/kernel/extract.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "face/mesh_access.h"
#include "kernel/second_order.h"

namespace tetmend::kernel {

namespace {

using Marks = std::vector<bool>;

template <class T>
void keep_marked(std::vector<T>& values, const Marks& wanted, std::size_t width = 1) {
  if (values.empty()) return;
  std::size_t size = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (wanted[i / width]) values[size++] = std::move(values[i]);
  }
  values.resize(size);
}

void keep_marked(std::vector<DataArray>& arrays, const Marks& wanted) {
  for (DataArray& array : arrays) {
    std::visit([&](auto& values) { keep_marked(values, wanted, array.components); }, array.values);
  }
}

/// Sorted, each once.
template <class T>
void make_ordered(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Those of a list of triangles or edges that are one of the tets.
template <std::size_t N, class Element>
Marks mark_parts(const std::vector<Element>& elements, const std::vector<MeshData::Tet>& tets) {
  std::vector<std::array<std::uint32_t, N>> parts;
  if (!elements.empty()) {
    for (const MeshData::Tet& tet : tets) {
      const auto add = [&](const auto& locals) {
        for (const auto& local : locals) {
          std::array<std::uint32_t, N> part{};
          for (std::size_t i = 0; i < N; ++i) part[i] = tet.vertices[local[i]];
          std::sort(part.begin(), part.end());
          parts.push_back(part);
        }
      };
      if constexpr (N == 3) {
        add(kFaceVertices);
      } else {
        add(kEdgeVertices);
      }
    }
  }
  make_ordered(parts);
  Marks wanted;
  for (const Element& element : elements) {
    auto part = element.vertices;
    std::sort(part.begin(), part.end());
    wanted.push_back(std::binary_search(parts.begin(), parts.end(), part));
  }
  return wanted;
}

void renumber_members(std::vector<Group>& groups, int dimension, const Marks& wanted) {
  std::vector<std::uint32_t> number(wanted.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    number[i] = count;
    count += wanted[i] ? 1 : 0;
  }
  const auto renumber = [&](Group& group) {
    std::erase_if(group.members, [&](std::uint32_t i) { return !wanted[i]; });
    for (std::uint32_t& i : group.members) i = number[i];
    // A group without members would mean all elements of its label.
    return group.members.empty();
  };
  std::erase_if(groups, [&](Group& group) {
    return group.dimension == dimension && !group.members.empty() && renumber(group);
  });
}

/// What no part of a mesh can have; a note says so.
void leave_out(MeshData& data) {
  std::vector<std::string> left;
  std::size_t others = 0;
  for (const OtherElements& elements : data.other_elements) {
    others += elements.vertices.size() / elements.vertex_count;
  }
  if (others > 0) left.push_back(fmt::format("{} elements that are no tets", others));
  if (!data.periodic.empty()) left.emplace_back("which points are images of each other");
  if (!data.deck.empty()) left.emplace_back("what its deck holds besides the mesh");
  for (const std::string& what : left) {
    data.notes.push_back(fmt::format("of a part of the mesh: {} not kept", what));
  }
  data.other_elements.clear();
  data.periodic.clear();
  data.deck.clear();
}

/// The points of the tets, and the nodes of their edges.
void keep_points(MeshData& data) {
  Marks wanted(data.points.size(), false);
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const MeshData::Tet& tet : data.tets) {
    for (const std::uint32_t v : tet.vertices) wanted[v] = true;
    if (data.mid_nodes.empty()) continue;
    for (const auto& [i, j] : kEdgeVertices) {
      const auto [low, high] = std::minmax(tet.vertices[i], tet.vertices[j]);
      edges.push_back({low, high});
    }
  }
  make_ordered(edges);
  std::erase_if(data.mid_nodes, [&](const std::array<std::uint32_t, 3>& mid) {
    return !std::binary_search(edges.begin(), edges.end(),
                               std::array{std::min(mid[0], mid[1]), std::max(mid[0], mid[1])});
  });
  for (const auto& mid : data.mid_nodes) wanted[mid[2]] = true;
  std::erase_if(data.required_vertices, [&](std::uint32_t v) { return !wanted[v]; });
  std::erase_if(data.groups, [&](const Group& group) {
    const auto is_gone = [&](std::uint32_t v) { return !wanted[v]; };
    return group.dimension == 0 && !group.members.empty() &&
           std::all_of(group.members.begin(), group.members.end(), is_gone);
  });
  std::vector<std::uint32_t> number_of(wanted.size(), kNoMidNode);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i]) number_of[i] = count++;
  }
  renumber_points(data, number_of, count);
}

}  // namespace

Mesh extract(const TetMesh& mesh, std::span<const TetHandle> tets) {
  Marks is_wanted(mesh.tet_slots(), false);
  for (const TetHandle t : tets) {
    if (mesh.is_deleted(t)) throw Error(fmt::format("extract: tet {} is not there", t.index()));
    is_wanted[t.index()] = true;
  }
  Marks wanted;  // by number in the arrays
  for (const TetHandle t : mesh.tets()) wanted.push_back(is_wanted[t.index()]);
  Mesh whole = mesh.to_mesh();
  MeshData data = MeshAccess::take(whole);
  leave_out(data);
  keep_marked(data.tets, wanted);
  keep_marked(data.tet_parts, wanted);
  keep_marked(data.tet_numbers, wanted);
  keep_marked(data.tet_data, wanted);
  renumber_members(data.groups, 3, wanted);
  const Marks triangles = mark_parts<3>(data.triangles, data.tets);
  keep_marked(data.triangles, triangles);
  keep_marked(data.triangle_parts, triangles);
  keep_marked(data.triangle_numbers, triangles);
  keep_marked(data.triangle_data, triangles);
  renumber_members(data.groups, 2, triangles);
  const Marks edges = mark_parts<2>(data.edges, data.tets);
  keep_marked(data.edges, edges);
  keep_marked(data.edge_parts, edges);
  keep_marked(data.edge_numbers, edges);
  keep_marked(data.edge_data, edges);
  renumber_members(data.groups, 1, edges);
  keep_points(data);
  return MeshAccess::make(std::move(data));
}

}  // namespace tetmend::kernel
