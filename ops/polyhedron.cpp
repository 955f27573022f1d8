// SPDX-License-Identifier: MIT
#include "ops/polyhedron.h"

#include <algorithm>

#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// The vertex behind a face that lies inside the mesh.
VertexHandle apex_behind(const TetMesh& mesh, HalfFace f) {
  const HalfFace twin = mesh.twin(f);
  return mesh.vertices(twin.tet())[twin.face()];
}

}  // namespace

void Polyhedron::start(const TetMesh& mesh, TetHandle t) {
  tets_.clear();
  vertices_.clear();
  set_.clear();
  centre_ = Point::Zero();
  for (const VertexHandle v : mesh.vertices(t)) {
    vertices_.push_back(v);
    centre_ += mesh.point(v) / 4;
  }
  add(t);
  list_faces(mesh);
  list_surface(mesh);
}

bool Polyhedron::start_at_ball(const TetMesh& mesh, std::span<const HalfFace> link) {
  tets_.clear();
  vertices_.clear();
  faces_.assign(link.begin(), link.end());
  for (const HalfFace f : link) {
    tets_.push_back(f.tet());
    for (const VertexHandle v : mesh.vertices(f)) {
      if (number_of(v) < vertices_.size()) continue;
      if (vertices_.size() == kMaxVertices) return false;
      vertices_.push_back(v);
    }
  }
  list_surface(mesh);
  return true;
}

bool Polyhedron::grow(const TetMesh& mesh, Workspace& workspace, std::size_t limit) {
  if (vertices_.size() >= limit) return false;
  const VertexHandle v = next_vertex(mesh, workspace);
  if (!v.is_valid()) return false;
  vertices_.push_back(v);
  do {
    list_faces(mesh);
  } while (add_reachable(mesh));
  list_surface(mesh);
  return true;
}

void Polyhedron::add(TetHandle t) {
  tets_.push_back(t);
  set_.insert(t.index());
}

/// Adds the tets behind the surface that need no new vertex. False if there was none.
bool Polyhedron::add_reachable(const TetMesh& mesh) {
  const std::size_t before = tets_.size();
  for (const HalfFace f : faces_) {
    if (!mesh.is_free(f)) continue;
    const TetHandle t = mesh.twin(f).tet();
    if (set_.contains(t.index()) || !may_add(mesh, t)) continue;
    if (number_of(apex_behind(mesh, f)) < vertices_.size()) add(t);
  }
  return tets_.size() > before;
}

/// A constrained face must not get a tet of the polyhedron on both sides.
bool Polyhedron::may_add(const TetMesh& mesh, TetHandle t) const {
  if (!mesh.has_constraints(t)) return true;
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace face(t, f);
    if (!mesh.is_constrained(face) || mesh.is_boundary(face)) continue;
    if (set_.contains(mesh.twin(face).tet().index())) return false;
  }
  return true;
}

void Polyhedron::list_faces(const TetMesh& mesh) {
  faces_.clear();
  for (const TetHandle t : tets_) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (mesh.is_boundary(face) || !set_.contains(mesh.twin(face).tet().index())) {
        faces_.push_back(face);
      }
    }
  }
}

void Polyhedron::list_surface(const TetMesh& mesh) {
  surface_.clear();
  PointMask outer = 0;
  for (const HalfFace f : faces_) {
    PolyhedronProblem::Triangle triangle{};
    for (unsigned i = 0; i < 3; ++i) {
      const std::size_t n = number_of(mesh.vertices(f)[i]);
      triangle[i] = static_cast<std::uint8_t>(n);
      outer |= PointMask{1} << n;
    }
    surface_.push_back(triangle);
  }
  const auto all = static_cast<PointMask>((std::uint64_t{1} << vertices_.size()) - 1);
  inside_ = all & ~outer;
}

/// Invalid if the surface cannot be crossed anywhere, or where the worker may.
VertexHandle Polyhedron::next_vertex(const TetMesh& mesh, Workspace& workspace) {
  candidates_.clear();
  std::size_t most = 0;
  for (const HalfFace f : faces_) {
    if (!mesh.is_free(f)) continue;
    const VertexHandle v = apex_behind(mesh, f);
    auto known = std::find_if(candidates_.begin(), candidates_.end(),
                              [&](const Candidate& other) { return other.vertex == v; });
    if (known == candidates_.end()) known = candidates_.insert(known, {v, 0});
    most = std::max(most, ++known->faces);
  }
  VertexHandle best;
  double nearest = 0;
  for (const auto& [v, faces] : candidates_) {
    if (faces < most) continue;
    if (!workspace.holds(v)) return {};
    const double distance = (mesh.point(v) - centre_).squaredNorm();
    if (best.is_valid() && !(distance < nearest)) continue;
    best = v;
    nearest = distance;
  }
  return best;
}

bool Polyhedron::is_embedded(const TetMesh& mesh, const SideTable& table) const {
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    const TetVertices& tet = mesh.vertices(tets_[i]);
    if (!mesh.is_certified_positive(tet)) return false;
    for (std::size_t k = 0; k < i; ++k) {
      if (table.overlap(corners(tet), corners(mesh.vertices(tets_[k])))) return false;
    }
  }
  return true;
}

PointMask Polyhedron::corners(const TetVertices& tet) const {
  PointMask mask = 0;
  for (const VertexHandle v : tet) mask |= PointMask{1} << number_of(v);
  return mask;
}

std::size_t Polyhedron::number_of(VertexHandle v) const {
  return static_cast<std::size_t>(std::find(vertices_.begin(), vertices_.end(), v) -
                                  vertices_.begin());
}

}  // namespace tetmend
