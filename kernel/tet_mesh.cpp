// SPDX-License-Identifier: MIT
// Whole-mesh operations of TetMesh: output, garbage collection, spatial order.
#include "kernel/tet_mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "kernel/chunks.h"
#include "kernel/grouping.h"
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
  std::vector<std::uint32_t> vertex_order;
  vertex_order.reserve(vertex_count_);
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (!is_deleted(VertexHandle(v))) vertex_order.push_back(v);
  }
  sort_along_curve(points_, vertex_order);
  std::vector<std::uint32_t> rank(points_.size());
  for (std::uint32_t i = 0; i < vertex_order.size(); ++i) rank[vertex_order[i]] = i;
  // Tets by their first vertex; the deleted ones last.
  const auto none = static_cast<std::uint32_t>(vertex_order.size());
  std::vector<std::uint32_t> first(cells_.size(), none);
  for_chunks(cells_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (is_deleted(TetHandle(static_cast<std::uint32_t>(t)))) continue;
      for (const VertexHandle v : cells_[t].vertices)
        first[t] = std::min(first[t], rank[v.index()]);
    }
  });
  std::vector<std::uint32_t> tet_order = group_by_key(first, none + 1).order;
  tet_order.resize(tet_count_);
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

bool operator==(const TetMesh& a, const TetMesh& b) {
  return a.cells_ == b.cells_ && a.quality_ == b.quality_ && a.label_ == b.label_ &&
         a.tet_flags_ == b.tet_flags_ && a.points_ == b.points_ && a.vertex_tet_ == b.vertex_tet_ &&
         a.vertex_flags_ == b.vertex_flags_ && a.vertex_date_ == b.vertex_date_ &&
         a.tet_count_ == b.tet_count_ && a.vertex_count_ == b.vertex_count_;
}

}  // namespace tetmend
