// SPDX-License-Identifier: MIT
#include "kernel/integrity.h"

#include <algorithm>

#include <fmt/format.h>

namespace tetmend {

namespace {

class IntegrityCheck {
 public:
  explicit IntegrityCheck(const TetMesh& mesh) : mesh_(mesh), met_(mesh.surface_triangles().size(), 0) {}

  std::vector<Finding> run() {
    std::size_t live = 0;
    for (std::uint32_t i = 0; i < mesh_.tet_slots(); ++i) {
      const TetHandle t(i);
      if (mesh_.is_deleted(t)) continue;
      ++live;
      if (!check_vertices(t)) continue;
      for (unsigned f = 0; f < 4; ++f) check_face(HalfFace(t, f));
      if (mesh_.quality(t) != mesh_.evaluate(mesh_.vertices(t))) {
        add(Finding::Kind::quality, t, {}, "the cached quality is stale");
      }
    }
    if (live != mesh_.tet_count()) add(Finding::Kind::count, {}, {}, "the number of tets is wrong");
    check_surface();
    check_links();
    return std::move(findings_);
  }

 private:
  void add(Finding::Kind kind, TetHandle t, VertexHandle v, std::string message) {
    if (t.is_valid()) message = fmt::format("tet {}: {}", t.index(), message);
    if (v.is_valid()) message = fmt::format("vertex {}: {}", v.index(), message);
    findings_.push_back({kind, t, v, std::move(message)});
  }

  bool check_vertices(TetHandle t) {
    const TetVertices& tv = mesh_.vertices(t);
    for (unsigned i = 0; i < 4; ++i) {
      const bool live = tv[i].index() < mesh_.vertex_slots() && !mesh_.is_deleted(tv[i]);
      const bool distinct = std::count(tv.begin(), tv.end(), tv[i]) == 1;
      if (live && distinct) continue;
      add(Finding::Kind::adjacency, t, {}, "a vertex is deleted or listed twice");
      return false;
    }
    return true;
  }

  void check_face(HalfFace face) {
    const HalfFace twin = mesh_.twin(face);
    if (twin.is_outside()) {
      check_boundary_face(face, twin.surface_triangle());
      return;
    }
    const TetHandle t = face.tet();
    if (twin.tet().index() >= mesh_.tet_slots() || mesh_.is_deleted(twin.tet()) || mesh_.twin(twin) != face) {
      add(Finding::Kind::adjacency, t, {}, fmt::format("the neighbour at face {} does not point back", face.face()));
      return;
    }
    auto here = mesh_.vertices(face);
    auto there = mesh_.vertices(twin);
    std::rotate(here.begin(), std::min_element(here.begin(), here.end()), here.end());
    std::rotate(there.begin(), std::min_element(there.begin(), there.end()), there.end());
    if (here == there) {
      add(Finding::Kind::orientation, t, {}, fmt::format("same sense as the neighbour at face {}", face.face()));
    } else if (here[0] != there[0] || here[1] != there[2] || here[2] != there[1]) {
      add(Finding::Kind::adjacency, t, {}, fmt::format("the neighbour at face {} shares other vertices", face.face()));
    }
    if (mesh_.is_constrained(face) != mesh_.is_constrained(twin)) {
      add(Finding::Kind::constraint, t, {}, fmt::format("face {} is constrained from one side only", face.face()));
    }
    if (mesh_.label(t) != mesh_.label(twin.tet()) && !mesh_.is_constrained(face)) {
      add(Finding::Kind::label, t, {}, fmt::format("another label behind face {}, which is not constrained", face.face()));
    }
    constrained_faces_ += mesh_.is_constrained(face);
  }

  void check_boundary_face(HalfFace face, std::uint32_t number) {
    if (number >= met_.size()) {
      add(Finding::Kind::boundary, face.tet(), {}, fmt::format("face {} names no surface triangle", face.face()));
      return;
    }
    ++met_[number];
    auto expected = mesh_.surface_triangles()[number].vertices;
    auto actual = mesh_.vertices(face);
    std::sort(expected.begin(), expected.end());
    std::sort(actual.begin(), actual.end());
    if (expected != actual) {
      add(Finding::Kind::boundary, face.tet(), {}, fmt::format("face {} is not surface triangle {}", face.face(), number));
    }
    for (const VertexHandle v : actual) {
      if (!mesh_.is_boundary(v)) add(Finding::Kind::boundary, {}, v, "on the boundary without the mark");
    }
  }

  void check_surface() {
    std::size_t interior = 0;
    for (std::size_t i = 0; i < met_.size(); ++i) {
      const SurfaceTriangle& triangle = mesh_.surface_triangles()[i];
      const unsigned wanted = triangle.interior || triangle.loose ? 0 : 1;
      interior += triangle.interior;
      if (met_[i] != wanted) {
        add(Finding::Kind::boundary, {}, {}, fmt::format("surface triangle {} is met {} times", i, met_[i]));
      }
    }
    if (constrained_faces_ != 2 * interior) {
      add(Finding::Kind::constraint, {}, {},
          fmt::format("{} constrained face sides for {} interior triangles", constrained_faces_, interior));
    }
  }

  void check_links() {
    std::vector<bool> used(mesh_.vertex_slots(), false);
    for (std::uint32_t i = 0; i < mesh_.tet_slots(); ++i) {
      if (mesh_.is_deleted(TetHandle(i))) continue;
      for (const VertexHandle v : mesh_.vertices(TetHandle(i))) {
        if (v.index() < used.size()) used[v.index()] = true;
      }
    }
    std::size_t live = 0;
    for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
      const VertexHandle v(i);
      if (mesh_.is_deleted(v)) continue;
      ++live;
      const TetHandle t = mesh_.tet_of(v);
      if (!t.is_valid()) {
        if (used[i]) add(Finding::Kind::vertex_link, {}, v, "has tets but names none");
      } else if (t.index() >= mesh_.tet_slots() || mesh_.is_deleted(t) || mesh_.local_index(t, v) == 4) {
        add(Finding::Kind::vertex_link, {}, v, "names a tet that does not contain it");
      }
    }
    if (live != mesh_.vertex_count()) add(Finding::Kind::count, {}, {}, "the number of vertices is wrong");
  }

  const TetMesh& mesh_;
  std::vector<unsigned> met_;  // how often each surface triangle is a boundary face
  std::size_t constrained_faces_ = 0;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_integrity(const TetMesh& mesh) { return IntegrityCheck(mesh).run(); }

}  // namespace tetmend
