// SPDX-License-Identifier: MIT
// A user's mesh: arrays in, checked, and arrays out.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/mesh.h>

#include "face/mesh_access.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/second_order.h"

namespace tetmend {

namespace {

template <class T>
void release(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

/// "there are 12"
std::string there_are(std::size_t count) {
  return fmt::format("there {} {}", count == 1 ? "is" : "are", count);
}

/// One kind of entity, in the words of MeshArrays.
struct Kind {
  std::string_view plural;
  std::string_view singular;
  std::size_t count = 0;
  const std::vector<DataArray>& data;
};

void check_labels(const Kind& kind, std::string_view what, const std::vector<Label>& labels) {
  if (labels.empty() || labels.size() == kind.count) return;
  throw Error(fmt::format("{}_{}: {} {} for {} {}", kind.singular, what, labels.size(), what,
                          kind.count, kind.plural));
}

void check_data(const Kind& kind) {
  for (std::size_t i = 0; i < kind.data.size(); ++i) {
    const DataArray& array = kind.data[i];
    const auto fail = [&](const std::string& reason) {
      throw Error(fmt::format("{}_data[{}]: '{}' has {}", kind.singular, i, array.name, reason));
    };
    if (array.components == 0) fail("0 components");
    if (array.size() % array.components == 0 && array.size() / array.components == kind.count) {
      continue;
    }
    fail(fmt::format("{} numbers for {} {}, {} for each", array.size(), kind.count, kind.plural,
                     array.components));
  }
}

void check_members(const Group& group, std::size_t i, const Kind& kind) {
  std::vector<bool> is_in(kind.count, false);
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    const std::uint32_t member = group.members[k];
    const auto fail = [&](const std::string& reason) {
      throw Error(fmt::format("groups[{}].members[{}]: {}, counted from 0", i, k, reason));
    };
    if (member >= kind.count) {
      fail(fmt::format("no {} {}, {}", kind.singular, member, there_are(kind.count)));
    }
    if (is_in[member]) fail(fmt::format("{} {} twice", kind.singular, member));
    is_in[member] = true;
  }
}

/// @param kinds by dimension
void check_groups(const std::vector<Group>& groups, const std::array<Kind, 4>& kinds) {
  std::map<std::pair<int, Label>, std::size_t> known;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Group& group = groups[i];
    const auto fail = [&](const std::string& reason) {
      throw Error(fmt::format("groups[{}]: {}", i, reason));
    };
    if (group.dimension < 0 || group.dimension > 3) {
      fail(fmt::format("dimension {}, expected 0 to 3", group.dimension));
    }
    if (!group.parts.empty() && !group.members.empty()) fail("it has parts and members");
    if (group.number != 0) {
      const auto [at, is_new] = known.try_emplace({group.dimension, group.number}, i);
      if (!is_new) fail(fmt::format("number {} is that of groups[{}]", group.number, at->second));
    }
    check_members(group, i, kinds[static_cast<std::size_t>(group.dimension)]);
  }
}

void check_points(const std::vector<std::array<double, 3>>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
    throw Error(fmt::format("points[{}]: ({}) is not finite", i, fmt::join(p, ", ")));
  }
}

template <std::size_t N>
void check_vertices(std::string_view name,
                    const std::vector<std::array<std::uint32_t, N>>& elements, std::size_t points) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    auto v = elements[i];
    std::sort(v.begin(), v.end());
    const bool repeated = std::adjacent_find(v.begin(), v.end()) != v.end();
    if (v.back() < points && !repeated) continue;
    const std::string reason = v.back() < points
                                   ? "the same vertex twice"
                                   : fmt::format("no point {}, {}", v.back(), there_are(points));
    throw Error(fmt::format("{}[{}]: ({}): {}, counted from 0", name, i,
                            fmt::join(elements[i], ", "), reason));
  }
}

/// Each node is a point of its own.
void check_nodes_of_edges(const MeshArrays& arrays) {
  constexpr std::uint8_t kCorner = 1;
  constexpr std::uint8_t kMiddle = 2;
  std::vector<std::uint8_t> use(arrays.points.size(), 0);
  for (const auto& tet : arrays.tets) {
    for (const std::uint32_t v : tet) use[v] = kCorner;
  }
  for (const auto& [a, b, node] : arrays.mid_nodes) {
    if (use[node] == 0) {
      use[node] = kMiddle;
      continue;
    }
    throw Error(fmt::format(
        "mid_nodes: point {}, counted from 0, is the node of an edge and {}: expected nodes of "
        "their own",
        node, use[node] == kCorner ? "a vertex of a tet" : "that of another edge"));
  }
}

/// Each edge of a tet has one.
void check_all_tets_have_nodes(const MeshArrays& arrays) {
  const MidNodes mid_nodes(arrays.mid_nodes);
  for (std::size_t i = 0; i < arrays.tets.size(); ++i) {
    const auto& tet = arrays.tets[i];
    for (const auto& [a, b] : kMidNodeEdges) {
      if (mid_nodes.of(tet[a], tet[b]) != kNoMidNode) continue;
      throw Error(fmt::format("tets[{}]: its edge ({}, {}) has no mid-side node, counted from 0", i,
                              tet[a], tet[b]));
    }
  }
}

/// Leaves each edge once, its smaller end first.
/// Precondition: all numbers are those of points.
void tidy_mid_nodes(MeshArrays& arrays) {
  auto& all = arrays.mid_nodes;
  if (all.empty()) return;
  for (auto& [a, b, node] : all) {
    if (a > b) std::swap(a, b);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i][0] != all[i - 1][0] || all[i][1] != all[i - 1][1]) continue;
    throw Error(fmt::format(
        "mid_nodes: the edge ({}, {}) has two nodes, {} and {}: expected one, counted from 0",
        all[i][0], all[i][1], all[i - 1][2], all[i][2]));
  }
  check_nodes_of_edges(arrays);
  check_all_tets_have_nodes(arrays);
}

void check(const MeshArrays& arrays) {
  const std::size_t n = arrays.points.size();
  check_points(arrays.points);
  check_vertices("tets", arrays.tets, n);
  check_vertices("triangles", arrays.triangles, n);
  check_vertices("edges", arrays.edges, n);
  check_vertices("mid_nodes", arrays.mid_nodes, n);
  for (std::size_t i = 0; i < arrays.required_vertices.size(); ++i) {
    if (arrays.required_vertices[i] < n) continue;
    throw Error(fmt::format("required_vertices[{}]: no point {}, {}, counted from 0", i,
                            arrays.required_vertices[i], there_are(n)));
  }
  const std::array<Kind, 4> kinds = {
      {{"points", "point", n, arrays.point_data},
       {"edges", "edge", arrays.edges.size(), arrays.edge_data},
       {"triangles", "triangle", arrays.triangles.size(), arrays.triangle_data},
       {"tets", "tet", arrays.tets.size(), arrays.tet_data}}};
  const auto& [points, edges, triangles, tets] = kinds;
  check_labels(points, "labels", arrays.point_labels);
  check_labels(tets, "labels", arrays.tet_labels);
  check_labels(triangles, "labels", arrays.triangle_labels);
  check_labels(edges, "labels", arrays.edge_labels);
  check_labels(tets, "parts", arrays.tet_parts);
  check_labels(triangles, "parts", arrays.triangle_parts);
  check_labels(edges, "parts", arrays.edge_parts);
  for (const Kind& kind : kinds) check_data(kind);
  check_groups(arrays.groups, kinds);
}

/// Elements with their labels, or label 0. Releases both lists.
template <class Element, class Vertices>
void pack(std::vector<Vertices>& vertices, std::vector<Label>& labels,
          std::vector<Element>& elements) {
  elements.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    elements[i] = {vertices[i], labels.empty() ? 0 : labels[i]};
  }
  release(vertices);
  release(labels);
}

template <class Element, class Vertices>
void unpack(const std::vector<Element>& elements, std::vector<Vertices>& vertices,
            std::vector<Label>& labels) {
  vertices.resize(elements.size());
  labels.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    vertices[i] = elements[i].vertices;
    labels[i] = elements[i].label;
  }
}

MeshData pack(MeshArrays arrays) {
  check(arrays);
  tidy_mid_nodes(arrays);
  MeshData data;
  data.points.reserve(arrays.points.size());
  for (const auto& p : arrays.points) data.points.emplace_back(p[0], p[1], p[2]);
  release(arrays.points);
  const bool labelled = std::any_of(arrays.point_labels.begin(), arrays.point_labels.end(),
                                    [](Label label) { return label != 0; });
  if (labelled) data.point_labels = std::move(arrays.point_labels);
  pack(arrays.tets, arrays.tet_labels, data.tets);
  pack(arrays.triangles, arrays.triangle_labels, data.triangles);
  pack(arrays.edges, arrays.edge_labels, data.edges);
  data.required_vertices = std::move(arrays.required_vertices);
  data.point_data = std::move(arrays.point_data);
  data.tet_data = std::move(arrays.tet_data);
  data.triangle_data = std::move(arrays.triangle_data);
  data.edge_data = std::move(arrays.edge_data);
  data.tet_parts = std::move(arrays.tet_parts);
  data.triangle_parts = std::move(arrays.triangle_parts);
  data.edge_parts = std::move(arrays.edge_parts);
  data.groups = std::move(arrays.groups);
  data.mid_nodes = std::move(arrays.mid_nodes);
  return data;
}

MeshArrays unpack_elements(const MeshData& data) {
  MeshArrays arrays;
  arrays.points.reserve(data.points.size());
  for (const Point& p : data.points) arrays.points.push_back({p.x(), p.y(), p.z()});
  arrays.point_labels = data.point_labels;
  unpack(data.tets, arrays.tets, arrays.tet_labels);
  unpack(data.triangles, arrays.triangles, arrays.triangle_labels);
  unpack(data.edges, arrays.edges, arrays.edge_labels);
  arrays.required_vertices = data.required_vertices;
  return arrays;
}

void unpack_rest(const MeshData& data, MeshArrays& arrays) {
  arrays.point_data = data.point_data;
  arrays.tet_data = data.tet_data;
  arrays.triangle_data = data.triangle_data;
  arrays.edge_data = data.edge_data;
  arrays.tet_parts = data.tet_parts;
  arrays.triangle_parts = data.triangle_parts;
  arrays.edge_parts = data.edge_parts;
  arrays.groups = data.groups;
  arrays.mid_nodes = data.mid_nodes;
}

/// Numbers of the elements that a group means by parts or by its label.
template <class Element>
std::vector<std::uint32_t> named_by(const Group& group, const std::vector<Element>& elements,
                                    const std::vector<Label>& parts) {
  std::vector<std::int32_t> wanted = group.parts;
  std::sort(wanted.begin(), wanted.end());
  const auto is_in = [&](std::uint32_t i) {
    if (wanted.empty()) return elements[i].label == group.number;
    return !parts.empty() && std::binary_search(wanted.begin(), wanted.end(), parts[i]);
  };
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    if (is_in(i)) found.push_back(i);
  }
  return found;
}

std::vector<std::uint32_t> points_named_by(const Group& group, const MeshData& data) {
  std::vector<std::uint32_t> found;
  if (!group.parts.empty()) return found;
  for (std::uint32_t i = 0; i < data.point_labels.size(); ++i) {
    if (data.point_labels[i] == group.number) found.push_back(i);
  }
  return found;
}

}  // namespace

Mesh::Mesh() = default;
Mesh::~Mesh() = default;
Mesh::Mesh(Mesh&& other) noexcept = default;
Mesh& Mesh::operator=(Mesh&& other) noexcept = default;

Mesh::Mesh(MeshArrays arrays) : content_(std::make_unique<Content>(pack(std::move(arrays)))) {}

Mesh::Mesh(const Mesh& other)
    : content_(std::make_unique<Content>(other.content().data, other.content().file)) {}

Mesh& Mesh::operator=(const Mesh& other) {
  Mesh copy(other);
  *this = std::move(copy);
  return *this;
}

const Mesh::Content& Mesh::content() const {
  static const Content kEmpty;
  return content_ ? *content_ : kEmpty;
}

std::size_t Mesh::point_count() const {
  return content().data.points.size();
}
std::size_t Mesh::tet_count() const {
  return content().data.tets.size();
}
std::size_t Mesh::triangle_count() const {
  return content().data.triangles.size();
}
std::size_t Mesh::edge_count() const {
  return content().data.edges.size();
}
const std::vector<std::string>& Mesh::notes() const {
  return content().data.notes;
}
const std::filesystem::path& Mesh::file() const {
  return content().file;
}

const std::vector<DataArray>& Mesh::point_data() const {
  return content().data.point_data;
}
const std::vector<DataArray>& Mesh::tet_data() const {
  return content().data.tet_data;
}
const std::vector<DataArray>& Mesh::triangle_data() const {
  return content().data.triangle_data;
}
const std::vector<DataArray>& Mesh::edge_data() const {
  return content().data.edge_data;
}
const std::vector<Group>& Mesh::groups() const {
  return content().data.groups;
}

std::span<const std::array<std::uint32_t, 3>> Mesh::mid_nodes() const {
  return content().data.mid_nodes;
}

std::vector<std::uint32_t> Mesh::members(const Group& group) const {
  if (!group.members.empty()) return group.members;
  const MeshData& data = content().data;
  switch (group.dimension) {
    case 0:
      return points_named_by(group, data);
    case 1:
      return named_by(group, data.edges, data.edge_parts);
    case 2:
      return named_by(group, data.triangles, data.triangle_parts);
    case 3:
      return named_by(group, data.tets, data.tet_parts);
    default:
      return {};
  }
}

const MeshArrays& Mesh::elements() const {
  const Content& here = content();
  std::call_once(here.elements_unpacked, [&here] { here.arrays = unpack_elements(here.data); });
  return here.arrays;
}

std::span<const std::array<double, 3>> Mesh::points() const {
  return elements().points;
}
std::span<const std::array<std::uint32_t, 4>> Mesh::tets() const {
  return elements().tets;
}
std::span<const std::array<std::uint32_t, 3>> Mesh::triangles() const {
  return elements().triangles;
}
std::span<const std::array<std::uint32_t, 2>> Mesh::edges() const {
  return elements().edges;
}
std::span<const std::uint32_t> Mesh::required_vertices() const {
  return elements().required_vertices;
}
std::span<const std::int32_t> Mesh::point_labels() const {
  return elements().point_labels;
}
std::span<const std::int32_t> Mesh::tet_labels() const {
  return elements().tet_labels;
}
std::span<const std::int32_t> Mesh::triangle_labels() const {
  return elements().triangle_labels;
}
std::span<const std::int32_t> Mesh::edge_labels() const {
  return elements().edge_labels;
}

const MeshArrays& Mesh::arrays() const {
  const Content& here = content();
  elements();
  std::call_once(here.rest_unpacked, [&here] { unpack_rest(here.data, here.arrays); });
  return here.arrays;
}

MeshArrays Mesh::take_arrays() && {
  arrays();
  const std::unique_ptr<Content> taken = std::move(content_);
  return taken ? std::move(taken->arrays) : MeshArrays();
}

Mesh MeshAccess::make(MeshData data, std::filesystem::path file) {
  Mesh mesh;
  mesh.content_ = std::make_unique<Mesh::Content>(std::move(data), std::move(file));
  return mesh;
}

MeshData MeshAccess::take(Mesh& mesh) {
  const std::unique_ptr<Mesh::Content> taken = std::move(mesh.content_);
  return taken ? std::move(taken->data) : MeshData();
}

namespace face {

TetMesh build_located(const std::filesystem::path& file, MeshData& data, BuildDetails details) {
  details.first_number = file.empty() ? 0 : 1;
  try {
    return TetMesh::build(data, details);
  } catch (const BuildError& error) {
    if (file.empty()) throw Error(fmt::format("{}, counted from 0", error.what()));
    throw Error(fmt::format("{}: {}", locate_tet(file, error.tet()), error.what()));
  } catch (const Error& error) {
    if (file.empty()) throw;
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace face

}  // namespace tetmend
