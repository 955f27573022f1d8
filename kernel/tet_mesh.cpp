// SPDX-License-Identifier: MIT
// Whole-mesh operations of TetMesh: output, garbage collection, spatial order.
#include "kernel/tet_mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "kernel/hilbert.h"

namespace tetmend {

MeshData TetMesh::to_data() const {
  // Vertices of the file keep their order; the rest follows by slot.
  std::vector<std::uint32_t> order;
  order.reserve(vertex_count_);
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (!is_deleted(VertexHandle(v))) order.push_back(v);
  }
  const auto by_origin = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(vertex_origin_[a], a) < std::pair(vertex_origin_[b], b);
  };
  if (!std::is_sorted(order.begin(), order.end(), by_origin)) {
    std::sort(order.begin(), order.end(), by_origin);
  }

  MeshData data;
  std::vector<std::uint32_t> number(points_.size());
  data.points.reserve(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const std::uint32_t v = order[i];
    number[v] = i;
    data.points.push_back(points_[v]);
    if (!point_labels_.empty()) {
      data.point_labels.push_back(
          vertex_origin_[v] == kNotFromFile ? 0 : point_labels_[vertex_origin_[v]]);
    }
    if ((vertex_flags_[v] & kVertexRequired) != 0) data.required_vertices.push_back(i);
  }
  data.tets.reserve(tet_count_);
  for (std::uint32_t t = 0; t < cells_.size(); ++t) {
    if (is_deleted(TetHandle(t))) continue;
    const TetVertices& v = cells_[t].vertices;
    data.tets.push_back(
        {{number[v[0].index()], number[v[1].index()], number[v[2].index()], number[v[3].index()]},
         label_[t]});
  }
  for (const SurfaceTriangle& triangle : surface_) {
    if (!triangle.named) continue;
    const auto& v = triangle.vertices;
    data.triangles.push_back(
        {{number[v[0].index()], number[v[1].index()], number[v[2].index()]}, triangle.label});
  }
  for (const NamedEdge& edge : named_edges_) {
    data.edges.push_back(
        {{number[edge.vertices[0].index()], number[edge.vertices[1].index()]}, edge.label});
  }
  return data;
}

void TetMesh::collect_garbage() {
  std::vector<std::uint32_t> kept_vertices;
  std::vector<std::uint32_t> kept_tets;
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (!is_deleted(VertexHandle(v))) kept_vertices.push_back(v);
  }
  for (std::uint32_t t = 0; t < cells_.size(); ++t) {
    if (!is_deleted(TetHandle(t))) kept_tets.push_back(t);
  }
  reorder(kept_vertices, kept_tets);
}

void TetMesh::sort_spatially() {
  const HilbertCurve curve(points_);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (!is_deleted(VertexHandle(v))) keyed.emplace_back(curve.key(points_[v]), v);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> vertex_order(keyed.size());
  std::vector<std::uint32_t> rank(points_.size());
  for (std::uint32_t i = 0; i < keyed.size(); ++i) {
    vertex_order[i] = keyed[i].second;
    rank[keyed[i].second] = i;
  }
  keyed.clear();
  for (std::uint32_t t = 0; t < cells_.size(); ++t) {
    if (is_deleted(TetHandle(t))) continue;
    std::uint32_t first = Handle<void>::kInvalid;
    for (const VertexHandle v : cells_[t].vertices) first = std::min(first, rank[v.index()]);
    keyed.emplace_back(first, t);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> tet_order(keyed.size());
  for (std::uint32_t i = 0; i < keyed.size(); ++i) tet_order[i] = keyed[i].second;
  reorder(vertex_order, tet_order);
}

namespace {

template <class T>
void gather(std::vector<T>& values, std::span<const std::uint32_t> order) {
  std::vector<T> next;
  next.reserve(order.size());
  for (const std::uint32_t i : order) next.push_back(values[i]);
  values = std::move(next);
}

}  // namespace

void TetMesh::reorder(std::span<const std::uint32_t> vertex_order,
                      std::span<const std::uint32_t> tet_order) {
  std::vector<VertexHandle> new_vertex(points_.size());
  std::vector<TetHandle> new_tet(cells_.size());
  for (std::uint32_t i = 0; i < vertex_order.size(); ++i)
    new_vertex[vertex_order[i]] = VertexHandle(i);
  for (std::uint32_t i = 0; i < tet_order.size(); ++i) new_tet[tet_order[i]] = TetHandle(i);

  gather(cells_, tet_order);
  gather(quality_, tet_order);
  gather(label_, tet_order);
  gather(tet_flags_, tet_order);
  gather(points_, vertex_order);
  gather(vertex_tet_, vertex_order);
  gather(vertex_flags_, vertex_order);
  gather(vertex_date_, vertex_order);
  gather(vertex_moved_, vertex_order);
  gather(vertex_origin_, vertex_order);
  tet_properties_.gather(tet_order);
  vertex_properties_.gather(vertex_order);

  for (Cell& cell : cells_) {
    for (VertexHandle& v : cell.vertices) v = new_vertex[v.index()];
    for (HalfFace& f : cell.neighbours) {
      if (!f.is_outside()) f = HalfFace(new_tet[f.tet().index()], f.face());
    }
  }
  for (TetHandle& t : vertex_tet_) {
    if (t.is_valid()) t = new_tet[t.index()];
  }
  for (SurfaceTriangle& triangle : surface_) {
    for (VertexHandle& v : triangle.vertices) v = new_vertex[v.index()];
  }
  for (NamedEdge& edge : named_edges_) {
    for (VertexHandle& v : edge.vertices) v = new_vertex[v.index()];
  }
}

namespace {

/// Like resize(), but with little room to spare: the arrays are the memory of a run.
template <class T>
void grow(std::vector<T>& values, std::size_t count, const T& value) {
  const std::size_t size = values.size() + count;
  if (size > values.capacity()) values.reserve(size + size / 16);
  values.resize(size, value);
}

}  // namespace

void TetMesh::grow_tets(std::size_t count) {
  grow(cells_, count, {});
  grow(quality_, count, Quality{0});
  grow(label_, count, Label{0});
  grow(tet_flags_, count, TetFlags{0});
  tet_properties_.resize(cells_.size());
}

void TetMesh::grow_vertices(std::size_t count) {
  grow(points_, count, Point(Point::Zero()));
  grow(vertex_tet_, count, {});
  grow(vertex_flags_, count, kVertexDeleted);
  grow(vertex_date_, count, Date{0});
  grow(vertex_moved_, count, Date{0});
  grow(vertex_origin_, count, kNotFromFile);
  vertex_properties_.resize(points_.size());
}

bool operator==(const TetMesh& a, const TetMesh& b) {
  return a.cells_ == b.cells_ && a.quality_ == b.quality_ && a.label_ == b.label_ &&
         a.tet_flags_ == b.tet_flags_ && a.points_ == b.points_ && a.vertex_tet_ == b.vertex_tet_ &&
         a.vertex_flags_ == b.vertex_flags_ && a.vertex_date_ == b.vertex_date_ &&
         a.vertex_moved_ == b.vertex_moved_ && a.tet_count_ == b.tet_count_ &&
         a.vertex_count_ == b.vertex_count_;
}

}  // namespace tetmend
