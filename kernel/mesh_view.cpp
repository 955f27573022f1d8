// SPDX-License-Identifier: MIT
// A mesh as a file lists it, without a copy of it.
#include "kernel/mesh_view.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_sort.h>

#include "kernel/chunks.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

namespace {

/// Tets of a block: their text stays in the cache.
constexpr std::size_t kBlockSize = std::size_t{1} << 13;

}  // namespace

MeshView::MeshView(const MeshData& data)
    : data_(&data),
      point_count_(data.points.size()),
      points_(data.points),
      point_labels_(data.point_labels),
      triangles_(data.triangles),
      edges_(data.edges),
      required_vertices_(data.required_vertices) {
  const std::size_t n = data.tets.size();
  for (std::size_t first = 0; first < n; first += kBlockSize) first_tet_.push_back(first);
  first_tet_.push_back(n);
}

MeshView::MeshView(const TetMesh& mesh)
    : mesh_(&mesh), point_count_(mesh.vertex_count()), points_(mesh.points_), scale_(mesh.scale()) {
  order_vertices();
  number_tets();
  collect_named();
}

/// Vertices of the file keep their order; the rest follows by slot.
void MeshView::order_vertices() {
  const std::vector<std::uint32_t>& origin = mesh_->vertex_origin_;
  order_.reserve(point_count_);
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (!mesh_->is_deleted(VertexHandle(v))) order_.push_back(v);
  }
  const auto by_origin = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(origin[a], a) < std::pair(origin[b], b);
  };
  if (!std::is_sorted(order_.begin(), order_.end(), by_origin)) {
    tbb::parallel_sort(order_.begin(), order_.end(), by_origin);
  }
  number_.resize(points_.size());
  for_chunks(order_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) number_[order_[i]] = static_cast<std::uint32_t>(i);
  });
}

void MeshView::number_tets() {
  const auto counts = map_chunks<std::size_t>(
      mesh_->tet_slots(),
      [&](std::size_t begin, std::size_t end) {
        std::size_t live = 0;
        for (std::size_t t = begin; t < end; ++t) {
          live += !mesh_->is_deleted(TetHandle(static_cast<std::uint32_t>(t)));
        }
        return live;
      },
      kBlockSize);
  first_tet_.assign(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), first_tet_.begin() + 1);
}

void MeshView::collect_named() {
  const auto number = [&](VertexHandle v) { return number_[v.index()]; };
  // Of a surface that has changed since TetMesh::renew_surface(), what is gone is not shown.
  const auto is_there = [&](const auto& vertices) {
    return mesh_->surface_guard() == nullptr ||
           std::none_of(vertices.begin(), vertices.end(),
                        [&](VertexHandle v) { return mesh_->is_deleted(v); });
  };
  const std::vector<Label>& labels = mesh_->point_labels_;
  if (!labels.empty()) own_point_labels_.reserve(point_count_);
  for (std::uint32_t i = 0; i < point_count_; ++i) {
    const std::uint32_t v = order_[i];
    const std::uint32_t origin = mesh_->vertex_origin_[v];
    if (!labels.empty()) {
      own_point_labels_.push_back(origin == TetMesh::kNotFromFile ? 0 : labels[origin]);
    }
    if ((mesh_->vertex_flags_[v] & TetMesh::kVertexRequired) != 0) {
      own_required_vertices_.push_back(i);
    }
  }
  const auto named = std::count_if(mesh_->surface_.begin(), mesh_->surface_.end(),
                                   [](const SurfaceTriangle& t) { return t.named; });
  own_triangles_.reserve(static_cast<std::size_t>(named));
  for (const SurfaceTriangle& triangle : mesh_->surface_) {
    const auto& v = triangle.vertices;
    if (!triangle.named || !is_there(v)) continue;
    own_triangles_.push_back({{number(v[0]), number(v[1]), number(v[2])}, triangle.label});
  }
  own_edges_.reserve(mesh_->named_edges_.size());
  for (const TetMesh::NamedEdge& edge : mesh_->named_edges_) {
    if (!is_there(edge.vertices)) continue;
    own_edges_.push_back({{number(edge.vertices[0]), number(edge.vertices[1])}, edge.label});
  }
  point_labels_ = own_point_labels_;
  triangles_ = own_triangles_;
  edges_ = own_edges_;
  required_vertices_ = own_required_vertices_;
}

std::span<const MeshData::Tet> MeshView::tets(std::size_t block,
                                              std::vector<MeshData::Tet>& buffer) const {
  const std::size_t count = first_tet_[block + 1] - first_tet_[block];
  if (data_ != nullptr) return {data_->tets.data() + first_tet_[block], count};
  buffer.clear();
  buffer.reserve(count);
  const std::size_t end = std::min(mesh_->tet_slots(), (block + 1) * kBlockSize);
  for (std::size_t slot = block * kBlockSize; slot < end; ++slot) {
    const TetHandle t(static_cast<std::uint32_t>(slot));
    if (mesh_->is_deleted(t)) continue;
    const TetVertices& v = mesh_->vertices(t);
    buffer.push_back({{number_[v[0].index()], number_[v[1].index()], number_[v[2].index()],
                       number_[v[3].index()]},
                      mesh_->label(t)});
  }
  return buffer;
}

}  // namespace tetmend
