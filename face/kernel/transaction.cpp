// SPDX-License-Identifier: MIT
// Local edits by name, each a replacement of tets with its checks.
#include "face/kernel/transaction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kernel/workspace.h"

namespace tetmend::kernel {

namespace {

/// Stands for the vertex of a split until there is one.
constexpr VertexHandle kNewVertex;

}  // namespace

Transaction::Transaction(TetMesh& mesh)
    : mesh_((mesh.check_idle("an edit"), mesh)),
      inner_(mesh.mesh_, *mesh.workspace_),
      depth_(++mesh.open_) {
  ++mesh.stamp_;
}

Transaction::~Transaction() {
  if (!kept_) inner_.undo();
  if (--mesh_.open_ == 0) mesh_.keeper_->forget();
}

void Transaction::check_usable() const {
  if (kept_) throw Error("an edit in a transaction that was kept: open another one");
  if (mesh_.open_ != depth_) throw Error("an edit while a transaction inside is open");
}

/// An edit that the properties cannot follow, or that touches a locked vertex, is undone again.
template <class Edit>
EditResult Transaction::make(const Edit& edit) {
  check_usable();
  PropertyKeeper& keeper = *mesh_.keeper_;
  keeper.start();
  tetmend::Transaction step(mesh_.mesh_, *mesh_.workspace_);
  result_ = edit(step);
  if (keeper.has_failed()) {
    step.undo();
    keeper.rethrow();
  }
  if (result_ != EditResult::made) return result_;
  if (keeper.take_touched_lock()) {
    step.undo();
    return result_ = EditResult::constrained;
  }
  step.keep();
  return result_;
}

Point Transaction::to_work(const Point& point, std::string_view what) const {
  if (!point.allFinite()) {
    throw Error(
        fmt::format("{}: ({}, {}, {}) is not finite", what, point.x(), point.y(), point.z()));
  }
  return mesh_.mesh_.scale().to_work(point);
}

EditResult Transaction::move(VertexHandle v, const Point& point) {
  check_usable();
  mesh_.is_known(v, "move");
  const Point place = to_work(point, "move");
  const Link link = mesh_.link(v);
  if (link.empty()) return refuse(EditResult::not_closed);
  return make([&](tetmend::Transaction& step) {
    return step.move_vertex(v, place, {link.data(), link.size()});
  });
}

EditResult Transaction::flip_3_2(TetEdge e) {
  const Ring ring = mesh_.ring(e);
  if (!ring.closed || ring.tets.size() != 3) return refuse(EditResult::not_closed);
  const auto& p = ring.vertices;
  return replace(ring.tets, {{ring.a, p[0], p[1], p[2]}, {p[0], p[1], p[2], ring.b}});
}

EditResult Transaction::flip_2_3(HalfFace f) {
  if (f.is_outside()) return refuse(EditResult::not_closed);
  mesh_.is_known(f.tet(), "flip_2_3");
  if (mesh_.is_deleted(f.tet()) || mesh_.is_boundary(f)) return refuse(EditResult::not_closed);
  const HalfFace twin = mesh_.twin(f);
  const VertexHandle a = mesh_.vertices(f.tet())[f.face()];
  const VertexHandle b = mesh_.vertices(twin.tet())[twin.face()];
  const auto [p, q, r] = mesh_.vertices(f);
  return replace(Few<TetHandle, 2>{f.tet(), twin.tet()},
                 {{a, b, p, q}, {a, b, q, r}, {a, b, r, p}});
}

EditResult Transaction::flip_4_4(TetEdge e, unsigned diagonal) {
  if (diagonal > 1) throw Error(fmt::format("flip_4_4: diagonal {}, expected 0 or 1", diagonal));
  const Ring ring = mesh_.ring(e);
  if (!ring.closed || ring.tets.size() != 4) return refuse(EditResult::not_closed);
  const VertexHandle p = ring.vertices[diagonal];
  const VertexHandle q = ring.vertices[diagonal + 1];
  const VertexHandle r = ring.vertices[(diagonal + 2) % 4];
  const VertexHandle s = ring.vertices[(diagonal + 3) % 4];
  return replace(ring.tets,
                 {{ring.a, p, q, r}, {p, q, r, ring.b}, {ring.a, p, r, s}, {p, r, s, ring.b}});
}

EditResult Transaction::contract(VertexHandle gone, VertexHandle stays) {
  check_usable();
  mesh_.is_known(gone, "contract");
  mesh_.is_known(stays, "contract");
  Few<TetHandle, 48> old;
  Few<TetVertices, 48> created;
  for (const HalfFace f : mesh_.link(gone)) {
    old.push_back(f.tet());
    TetVertices tet = mesh_.vertices(f.tet());
    if (std::find(tet.begin(), tet.end(), stays) != tet.end()) continue;
    tet[f.face()] = stays;
    created.push_back(tet);
  }
  if (created.size() == old.size() || created.empty()) return refuse(EditResult::not_closed);
  return replace(old, std::span<const TetVertices>(created));
}

VertexHandle Transaction::split(TetEdge e, const Point& point) {
  const Ring ring = mesh_.ring(e);
  Few<TetVertices, 32> created;
  for (std::size_t i = 0; ring.closed && i < ring.tets.size(); ++i) {
    const VertexHandle p = ring.vertices[i];
    const VertexHandle q = ring.vertices[i + 1 == ring.vertices.size() ? 0 : i + 1];
    created.push_back({ring.a, kNewVertex, p, q});
    created.push_back({kNewVertex, ring.b, p, q});
  }
  return split(ring.tets, created, point);
}

VertexHandle Transaction::split(HalfFace f, const Point& point) {
  if (f.is_outside()) return split(Few<TetHandle, 2>(), Few<TetVertices, 6>(), point);
  mesh_.is_known(f.tet(), "split");
  Few<TetHandle, 2> old;
  Few<TetVertices, 6> created;
  if (!mesh_.is_deleted(f.tet()) && !mesh_.is_boundary(f)) {
    for (const HalfFace side : {f, mesh_.twin(f)}) {
      old.push_back(side.tet());
      for (unsigned i = 0; i < 4; ++i) {
        if (i == side.face()) continue;
        TetVertices tet = mesh_.vertices(side.tet());
        tet[i] = kNewVertex;
        created.push_back(tet);
      }
    }
  }
  return split(old, created, point);
}

VertexHandle Transaction::split(TetHandle t, const Point& point) {
  mesh_.is_known(t, "split");
  Few<TetHandle, 2> old;
  Few<TetVertices, 6> created;
  if (!mesh_.is_deleted(t)) {
    old.push_back(t);
    for (unsigned i = 0; i < 4; ++i) {
      TetVertices tet = mesh_.vertices(t);
      tet[i] = kNewVertex;
      created.push_back(tet);
    }
  }
  return split(old, created, point);
}

/// Puts a new vertex in for kNewVertex; both go together.
VertexHandle Transaction::split(std::span<const TetHandle> old,
                                std::span<const TetVertices> created, const Point& point) {
  const Point place = to_work(point, "split");
  VertexHandle v;
  if (created.empty()) {
    check_usable();
    refuse(EditResult::not_closed);
    return v;
  }
  std::vector<TetVertices> tets(created.begin(), created.end());
  const EditResult result = make([&](tetmend::Transaction& step) {
    v = step.add_vertex(place);
    for (TetVertices& tet : tets) std::replace(tet.begin(), tet.end(), kNewVertex, v);
    return step.replace_cavity(old, tets);
  });
  return result == EditResult::made ? v : VertexHandle();
}

/// Live, and of a tet or added by a transaction.
bool Transaction::may_use(VertexHandle v) const {
  mesh_.is_known(v, "replace");
  if (mesh_.is_deleted(v)) return false;
  return mesh_.mesh_.tet_of(v).is_valid() ||
         mesh_.mesh_.origin(v) == tetmend::TetMesh::kNotFromFile;
}

EditResult Transaction::replace(std::span<const TetHandle> old,
                                std::span<const TetVertices> created) {
  check_usable();
  if (old.empty() || created.empty()) return refuse(EditResult::not_closed);
  for (const TetHandle t : old) {
    mesh_.is_known(t, "replace");
    if (mesh_.is_deleted(t)) return refuse(EditResult::not_closed);
  }
  for (const TetVertices& tet : created) {
    if (!std::all_of(tet.begin(), tet.end(), [this](VertexHandle v) { return may_use(v); })) {
      return refuse(EditResult::not_closed);
    }
  }
  return make([&](tetmend::Transaction& step) { return step.replace_cavity(old, created); });
}

VertexHandle Transaction::add_vertex(const Point& point) {
  const Point place = to_work(point, "add_vertex");
  added_.reserve(added_.size() + 1);
  VertexHandle v;
  make([&](tetmend::Transaction& step) {
    v = step.add_vertex(place);
    return EditResult::made;
  });
  added_.push_back(v);
  return v;
}

std::vector<TetHandle> Transaction::created() const {
  const auto made = inner_.created();
  return {made.begin(), made.end()};
}

std::vector<std::array<Point, 4>> Transaction::to_file(
    std::span<const std::array<Point, 4>> tets) const {
  std::vector<std::array<Point, 4>> out(tets.begin(), tets.end());
  const Scale& scale = mesh_.mesh_.scale();
  if (scale.is_one()) return out;
  for (auto& tet : out) {
    for (Point& p : tet) p = scale.to_file(p);
  }
  return out;
}

std::vector<std::array<Point, 4>> Transaction::before() const {
  return to_file(inner_.tets().before);
}

std::vector<std::array<Point, 4>> Transaction::after() const {
  return to_file(inner_.tets().now);
}

std::vector<TetHandle> Transaction::changed() const {
  std::vector<TetHandle> tets;
  inner_.list_changed(tets);
  return tets;
}

void Transaction::keep() {
  if (kept_) return;
  if (mesh_.open_ != depth_) throw Error("keep() while a transaction inside is open");
  for (const VertexHandle v : added_) {
    if (mesh_.is_deleted(v) || mesh_.mesh_.tet_of(v).is_valid()) continue;
    throw Error(fmt::format("keep(): vertex {} was added, and no tet has it", v.index()));
  }
  inner_.keep();
  kept_ = true;
}

void Transaction::undo() {
  check_usable();
  inner_.undo();
  added_.clear();
}

}  // namespace tetmend::kernel
