// SPDX-License-Identifier: MIT
// The surface of a mesh, as far as features follow from it.
#include <algorithm>
#include <utility>

#include "envelope/features.h"
#include "kernel/mesh_view.h"

namespace tetmend {

namespace {

using FaceVertices = std::array<VertexHandle, 3>;

FaceVertices sorted(FaceVertices v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// Reads one mesh.
class SurfaceReader {
 public:
  explicit SurfaceReader(const TetMesh& mesh) : mesh_(mesh) {}

  SurfaceInput read() {
    collect_faces();
    collect_named();
    return std::move(read_);
  }

 private:
  void keep(VertexHandle v) { read_.kept.push_back(v); }
  void collect_faces();
  void look_at(HalfFace f);
  void add_face(HalfFace f, const SurfaceTriangle& triangle);
  void add_wall(const FaceVertices& v);
  void collect_named();

  const TetMesh& mesh_;
  std::vector<std::pair<FaceVertices, std::uint32_t>> inner_;  // triangles inside, sorted
  SurfaceInput read_;
};

void SurfaceReader::collect_faces() {
  const auto triangles = mesh_.surface_triangles();
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i].loose) {
      for (const VertexHandle v : triangles[i].vertices) keep(v);
    } else if (triangles[i].interior) {
      inner_.emplace_back(sorted(triangles[i].vertices), i);
    }
  }
  std::sort(inner_.begin(), inner_.end());
  for (std::uint32_t i = 0; i < mesh_.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh_.is_deleted(t)) continue;
    for (unsigned k = 0; k < 4; ++k) look_at(HalfFace(t, k));
  }
}

void SurfaceReader::look_at(HalfFace f) {
  const auto triangles = mesh_.surface_triangles();
  const HalfFace twin = mesh_.twin(f);
  if (twin.is_outside()) {
    add_face(f, triangles[twin.surface_triangle()]);
    return;
  }
  if (!mesh_.is_constrained(f)) return;
  const FaceVertices v = sorted(mesh_.vertices(f));
  if (mesh_.label(f.tet()) == mesh_.label(twin.tet())) {
    add_wall(v);
  } else if (mesh_.label(f.tet()) < mesh_.label(twin.tet())) {
    const auto at = std::lower_bound(inner_.begin(), inner_.end(), std::pair(v, std::uint32_t{0}));
    add_face(f, triangles[at->second]);
  }
}

void SurfaceReader::add_face(HalfFace f, const SurfaceTriangle& triangle) {
  SurfaceInput::Kind kind{
      {mesh_.label(f.tet()), 0}, triangle.label, triangle.named, triangle.interior};
  if (triangle.interior) kind.sides[1] = mesh_.label(mesh_.twin(f).tet());
  read_.faces.push_back({mesh_.vertices(f), 0});
  read_.kinds.push_back(kind);
  for (const VertexHandle v : mesh_.vertices(f)) {
    if (mesh_.is_frozen(v)) keep(v);
  }
}

void SurfaceReader::add_wall(const FaceVertices& v) {
  for (unsigned k = 0; k < 3; ++k) {
    const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
    keep(v[k]);
    read_.walls.push_back({a, b});
  }
}

void SurfaceReader::collect_named() {
  const MeshView view(mesh_);
  const auto slots = view.vertex_slots();
  const auto vertex = [&](std::uint32_t i) { return VertexHandle(slots.empty() ? i : slots[i]); };
  for (const MeshData::Edge& edge : view.edges()) {
    read_.named.push_back({{vertex(edge.vertices[0]), vertex(edge.vertices[1])}, edge.label});
  }
  // What a deck says of elements that nobody here understands names their points alone.
  for (const std::uint32_t i : view.required_vertices()) read_.held.push_back(vertex(i));
}

}  // namespace

SurfaceInput read_surface(const TetMesh& mesh) {
  return SurfaceReader(mesh).read();
}

}  // namespace tetmend
