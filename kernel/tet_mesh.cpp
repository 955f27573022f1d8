// SPDX-License-Identifier: MIT
// Whole-mesh operations of TetMesh: output, frozen tets, garbage collection, spatial order.
#include "kernel/tet_mesh.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "kernel/chunks.h"
#include "kernel/grouping.h"
#include "kernel/hilbert.h"
#include "kernel/make_room.h"
#include "kernel/mesh_view.h"
#include "kernel/quality_of_points.h"
#include "kernel/thin_stars.h"

namespace tetmend {

namespace {

void copy_points(const MeshView& view, MeshData& data) {
  data.points.resize(view.point_count());
  for_chunks(view.point_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) data.points[i] = view.point(i);
  });
}

void copy_tets(const MeshView& view, MeshData& data) {
  data.tets.resize(view.tet_count());
  const auto copy_block = [&](std::size_t block, std::size_t) {
    std::vector<MeshData::Tet> buffer;
    const auto tets = view.tets(block, buffer);
    std::copy(tets.begin(), tets.end(),
              data.tets.begin() + static_cast<std::ptrdiff_t>(view.first_tet(block)));
  };
  for_chunks(view.tet_blocks(), copy_block, 1);
}

void copy_named(const MeshView& view, MeshData& data) {
  for (std::size_t i = 0; view.has_point_labels() && i < view.point_count(); ++i) {
    data.point_labels.push_back(view.point_label(i));
  }
  data.triangles.assign(view.triangles().begin(), view.triangles().end());
  data.edges.assign(view.edges().begin(), view.edges().end());
  data.required_vertices.assign(view.required_vertices().begin(), view.required_vertices().end());
}

}  // namespace

MeshData TetMesh::to_data() const& {
  const MeshView view(*this);
  MeshData data;
  copy_points(view, data);
  copy_tets(view, data);
  copy_named(view, data);
  return data;
}

MeshData TetMesh::to_data() && {
  release(quality_, tet_flags_, vertex_tet_, vertex_dates_);
  MeshData data;
  {
    const MeshView view(*this);
    // The view has what it needs of these, and each of the others is needed once.
    release(surface_, vertex_origin_, vertex_flags_, point_labels_);
    copy_tets(view, data);
    release(cells_, label_);
    copy_points(view, data);
    release(points_);
    copy_named(view, data);
  }
  *this = {};
  return data;
}

std::size_t TetMesh::freeze(const std::function<bool(TetHandle)>& is_frozen) {
  for (VertexFlags& flags : vertex_flags_) flags &= static_cast<VertexFlags>(~kVertexFrozen);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    tet_flags_[i] &= static_cast<TetFlags>(~kTetFrozen);
    const TetHandle t(i);
    if (is_deleted(t) || !is_frozen(t)) continue;
    tet_flags_[i] |= kTetFrozen;
    for (const VertexHandle v : cells_[i].vertices) vertex_flags_[v.index()] |= kVertexFrozen;
    ++count;
  }
  return count;
}

Quality TetMesh::evaluate(const TetVertices& tv) const {
  return static_cast<Quality>(
      quality_of_points(standard_, point(tv[0]), point(tv[1]), point(tv[2]), point(tv[3])));
}

bool misses_goal(const TetMesh& mesh, TetHandle t) {
  return misses_goal_of(mesh, t);
}

void TetMesh::set_standard(const Standard& standard) {
  const bool same_qualities = standard.goal() == standard_.goal() &&
                              standard.terms() == standard_.terms() &&
                              standard.own() == standard_.own();
  standard_ = standard;
  bounds_ = bounds_.under(standard);
  if (same_qualities) return;
  for_chunks(cells_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TetVertices& tv = cells_[i].vertices;
      if (tv[0].is_valid()) quality_[i] = evaluate(tv);
    }
  });
}

void TetMesh::set_bounds(const Bounds& bounds) {
  const double step2 = bounds.least_step2();
  if (step2 != bounds_.least_step2()) {
    thin_stars_ = step2 > 0 ? std::make_shared<ThinStars>(*this, step2) : nullptr;
  }
  bounds_ = bounds.under(standard_);
}

TetMesh::KeptSlots TetMesh::collect_garbage() {
  KeptSlots kept;
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (!is_deleted(VertexHandle(v))) kept.vertices.push_back(v);
  }
  for (std::uint32_t t = 0; t < cells_.size(); ++t) {
    if (!is_deleted(TetHandle(t))) kept.tets.push_back(t);
  }
  reorder(kept.vertices, kept.tets);
  // A copy made while workers were in territories has not got their counts.
  vertex_count_ = kept.vertices.size();
  tet_count_ = kept.tets.size();
  return kept;
}

TetMesh::KeptSlots TetMesh::sort_spatially() {
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
  return {std::move(vertex_order), std::move(tet_order)};
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
  renew_surface();
  thin_stars_.reset();
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
  gather(vertex_dates_, vertex_order);
  gather(vertex_origin_, vertex_order);

  for (Cell& cell : cells_) {
    if (!cell.vertices[0].is_valid()) continue;
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
  if (SurfaceGuard* guard = surface_guard()) guard->renumber(new_vertex, points_.size());
}

namespace {

/// With little room to spare: the arrays are the memory of a run.
template <class... T>
void make_room(std::size_t size, std::vector<T>&... values) {
  const auto reserve = [size](auto& array) {
    if (size > array.capacity()) array.reserve(size + size / 16);
  };
  (reserve(values), ...);
}

}  // namespace

void TetMesh::grow_tets(std::size_t count) {
  const std::size_t size = cells_.size() + count;
  make_room(size, cells_, quality_, label_, tet_flags_);
  cells_.resize(size);
  quality_.resize(size, kDeletedQuality);
  label_.resize(size, Label{0});
  tet_flags_.resize(size, TetFlags{0});
}

void TetMesh::grow_vertices(std::size_t count) {
  const std::size_t size = points_.size() + count;
  make_room(size, points_, vertex_tet_, vertex_flags_, vertex_dates_, vertex_origin_);
  if (SurfaceGuard* guard = surface_guard()) guard->resize(size);
  points_.resize(size, Point::Zero());
  vertex_tet_.resize(size);
  vertex_flags_.resize(size, kVertexDeleted);
  vertex_dates_.resize(size);
  vertex_origin_.resize(size, kNotFromFile);
}

void TetMesh::drop_tet_slot() noexcept {
  cells_.pop_back();
  quality_.pop_back();
  label_.pop_back();
  tet_flags_.pop_back();
}

void TetMesh::drop_vertex_slot() noexcept {
  points_.pop_back();
  vertex_tet_.pop_back();
  vertex_flags_.pop_back();
  vertex_dates_.pop_back();
  vertex_origin_.pop_back();
  if (SurfaceGuard* guard = surface_guard()) guard->resize(points_.size());
}

namespace {

/// Element i at slots[i], the elements from slots.size() on between them.
std::vector<std::uint32_t> spread(std::span<const std::uint32_t> slots, std::size_t count) {
  std::vector<std::uint32_t> order(count);
  auto filler = static_cast<std::uint32_t>(slots.size());
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    order[i] = next < slots.size() && slots[next] == i ? next++ : filler++;
  }
  return order;
}

}  // namespace

void TetMesh::scatter(std::span<const std::uint32_t> vertex_slots,
                      std::span<const std::uint32_t> tet_slots) {
  assert(vertex_slots.size() == points_.size() && tet_slots.size() == cells_.size());
  if (!vertex_slots.empty()) grow_vertices(vertex_slots.back() + 1 - vertex_slots.size());
  if (!tet_slots.empty()) grow_tets(tet_slots.back() + 1 - tet_slots.size());
  reorder(spread(vertex_slots, points_.size()), spread(tet_slots, cells_.size()));
}

bool operator==(const TetMesh& a, const TetMesh& b) {
  return a.cells_ == b.cells_ && a.quality_ == b.quality_ && a.label_ == b.label_ &&
         a.tet_flags_ == b.tet_flags_ && a.scale_ == b.scale_ && a.points_ == b.points_ &&
         a.vertex_tet_ == b.vertex_tet_ && a.vertex_flags_ == b.vertex_flags_ &&
         a.vertex_dates_ == b.vertex_dates_ && a.tet_count_ == b.tet_count_ &&
         a.vertex_count_ == b.vertex_count_ && a.guard_ == b.guard_;
}

}  // namespace tetmend
