// SPDX-License-Identifier: MIT
// A user's mesh: arrays in, checked, and arrays out.
#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/mesh.h>

#include "face/mesh_access.h"
#include "kernel/formats/mesh_io.h"

namespace tetmend {

namespace {

template <class T>
void release(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

void check_labels(std::string_view entities, std::size_t count, std::string_view name,
                  std::size_t labels) {
  if (labels == 0 || labels == count) return;
  throw Error(fmt::format("{}: {} labels for {} {}", name, labels, count, entities));
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
                                   : fmt::format("no point {}, there are {}", v.back(), points);
    throw Error(fmt::format("{}[{}]: ({}): {}, counted from 0", name, i,
                            fmt::join(elements[i], ", "), reason));
  }
}

void check(const MeshArrays& arrays) {
  const std::size_t n = arrays.points.size();
  check_points(arrays.points);
  check_vertices("tets", arrays.tets, n);
  check_vertices("triangles", arrays.triangles, n);
  check_vertices("edges", arrays.edges, n);
  for (std::size_t i = 0; i < arrays.required_vertices.size(); ++i) {
    if (arrays.required_vertices[i] < n) continue;
    throw Error(fmt::format("required_vertices[{}]: no point {}, there are {}, counted from 0", i,
                            arrays.required_vertices[i], n));
  }
  check_labels("points", n, "point_labels", arrays.point_labels.size());
  check_labels("tets", arrays.tets.size(), "tet_labels", arrays.tet_labels.size());
  check_labels("triangles", arrays.triangles.size(), "triangle_labels",
               arrays.triangle_labels.size());
  check_labels("edges", arrays.edges.size(), "edge_labels", arrays.edge_labels.size());
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
  return data;
}

MeshArrays unpack(const MeshData& data) {
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

const MeshArrays& Mesh::arrays() const {
  const Content& here = content();
  std::call_once(here.unpacked, [&here] { here.arrays = unpack(here.data); });
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
