// SPDX-License-Identifier: MIT
// A surface without tets: it proposes edits to a guard and makes those that are allowed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "contract/zoo.h"
#include "envelope/envelope.h"
#include "tests/support/surface_distance.h"

namespace tetmend::test {

class SurfaceModel {
 public:
  using Face = std::array<VertexHandle, 3>;
  /// The same face, from its least vertex on.
  static Face rotated(Face f) {
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f;
  }

  SurfaceModel(const TetMesh& mesh, const EnvelopeOptions& options)
      : guard_(Envelope::of(mesh, options)), journal_(guard_->make_journal()) {
    const SurfaceFeatures features =
        find_features(mesh, {options.angle, options.is_flat(), options.kept});
    for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
      points_.push_back(mesh.point(VertexHandle(i)));
    }
    for (const auto& face : features.faces) faces_.insert(rotated(face.vertices));
    reference_ = triangles();
  }

  /// Of a part, or a whole, that has moved already. Faces of `fixed` are never changed.
  SurfaceModel(std::unique_ptr<Envelope> guard, std::vector<Point> points,
               const std::vector<Face>& faces, const std::vector<Face>& fixed)
      : guard_(std::move(guard)), journal_(guard_->make_journal()), points_(std::move(points)) {
    for (const Face& face : faces) faces_.insert(rotated(face));
    for (const Face& face : fixed) fixed_.insert(rotated(face));
    reference_ = triangles();
  }

  const Envelope& guard() const { return *guard_; }
  Envelope& guard() { return *guard_; }
  SurfaceJournal& journal() { return *journal_; }
  const std::set<Face>& faces() const { return faces_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Triangle>& reference() const { return reference_; }
  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result;
    for (const Face& f : faces_) result.push_back({at(f[0]), at(f[1]), at(f[2])});
    return result;
  }
  const Point& at(VertexHandle v) const { return points_[v.index()]; }
  std::vector<Face> star(VertexHandle v) const {
    std::vector<Face> result;
    for (const Face& f : faces_) {
      if (f[0] == v || f[1] == v || f[2] == v) result.push_back(f);
    }
    return result;
  }
  std::vector<VertexHandle> vertices() const {
    std::set<VertexHandle> all;
    for (const Face& f : faces_) all.insert(f.begin(), f.end());
    return {all.begin(), all.end()};
  }

  /// Each is true if the guard allowed it; then it is made. With `keep` false it is undone again.
  bool move(VertexHandle v, const Point& to, bool keep = true) {
    const std::vector<Face> faces = star(v);
    const auto before = with_points(faces);
    const Point old = std::exchange(points_[v.index()], to);
    const bool allowed = ask(before, with_points(faces));
    if (allowed && keep) return true;
    if (allowed) guard_->undo(*journal_);
    points_[v.index()] = old;
    return allowed;
  }
  bool contract(VertexHandle v, VertexHandle into, bool keep = true) {
    std::vector<Face> after;
    const std::vector<Face> old = star(v);
    for (Face f : old) {
      if (f[0] == into || f[1] == into || f[2] == into) continue;
      std::replace(f.begin(), f.end(), v, into);
      after.push_back(f);
    }
    return exchange(old, after, keep);
  }
  /// The edge (a, b) of faces (a, b, c) and (b, a, d) by (c, d).
  bool flip(VertexHandle a, VertexHandle b, bool keep = true) {
    const VertexHandle c = beside(a, b);
    const VertexHandle d = beside(b, a);
    if (!c.is_valid() || !d.is_valid() || c == d) return false;
    return exchange({{a, b, c}, {b, a, d}}, {{c, a, d}, {d, b, c}}, keep);
  }
  /// A vertex on all faces of an edge.
  bool split(VertexHandle a, VertexHandle b, const Point& at, bool keep = true) {
    const VertexHandle v(static_cast<std::uint32_t>(points_.size()));
    points_.push_back(at);
    std::vector<Face> old;
    std::vector<Face> created;
    for (const Face& f : faces_) {
      for (unsigned k = 0; k < 3; ++k) {
        const VertexHandle p = f[k];
        const VertexHandle q = f[(k + 1) % 3];
        if ((p != a || q != b) && (p != b || q != a)) continue;
        old.push_back(f);
        created.push_back({p, v, f[(k + 2) % 3]});
        created.push_back({v, q, f[(k + 2) % 3]});
      }
    }
    const bool allowed = exchange(old, created, keep);
    if (!allowed || !keep) points_.pop_back();
    return allowed;
  }
  /// Any edit by faces.
  bool exchange(const std::vector<Face>& old, const std::vector<Face>& created, bool keep = true) {
    if (!ask(with_points(old), with_points(created))) return false;
    if (!keep) {
      guard_->undo(*journal_);
      return true;
    }
    for (const Face& f : old) faces_.erase(rotated(f));
    for (const Face& f : created) faces_.insert(rotated(f));
    return true;
  }
  /// A random edit of one of these kinds, at most `reach` edges long.
  bool random_edit(contract::Random& random, double reach, bool keep = true) {
    const std::vector<VertexHandle> all = vertices();
    const VertexHandle v = all[random.index(all.size())];
    const std::vector<Face> around = star(v);
    const Face& f = around[random.index(around.size())];
    const VertexHandle w = f[0] == v ? f[1] : f[1] == v ? f[2] : f[0];
    const double length = (at(w) - at(v)).norm();
    switch (random.index(6)) {
      case 0:
        return contract(v, w, keep);
      case 1:
      case 2:
        return flip(v, w, keep);
      case 3:
        return split(v, w, at(v) + random.real(0.2, 0.8) * (at(w) - at(v)), keep);
      default:
        if (guard_->place(v) == SurfacePlace::corner) return false;
        return move(v, guard_->nearest(v, at(v) + random.in_ball(reach * length)), keep);
    }
  }

 private:
  VertexHandle beside(VertexHandle a, VertexHandle b) const {
    for (const Face& f : faces_) {
      for (unsigned k = 0; k < 3; ++k) {
        if (f[k] == a && f[(k + 1) % 3] == b) return f[(k + 2) % 3];
      }
    }
    return {};
  }
  std::vector<SurfaceFace> with_points(const std::vector<Face>& faces) const {
    std::vector<SurfaceFace> result;
    for (const Face& f : faces) result.push_back({f, {at(f[0]), at(f[1]), at(f[2])}});
    return result;
  }
  bool ask(const std::vector<SurfaceFace>& before, const std::vector<SurfaceFace>& after) {
    for (const SurfaceFace& face : before) {
      if (fixed_.contains(rotated(face.vertices))) return false;
    }
    return guard_->replace(before, after, *journal_);
  }

  std::unique_ptr<Envelope> guard_;
  std::unique_ptr<SurfaceJournal> journal_;
  std::set<Face> faces_;
  std::set<Face> fixed_;
  std::vector<Point> points_;
  std::vector<Triangle> reference_;
};

/// The vertex that is exactly at a place; one past the last if none is.
inline VertexHandle vertex_at(const SurfaceModel& model, const Point& p) {
  const auto& points = model.points();
  return VertexHandle(
      static_cast<std::uint32_t>(std::find(points.begin(), points.end(), p) - points.begin()));
}

}  // namespace tetmend::test
