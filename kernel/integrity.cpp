// SPDX-License-Identifier: MIT
// Checks that the arrays of a mesh agree with each other.
//
//   vertices of each tet -> neighbours and their senses -> links of vertices -> surface triangles
//   -> constraint bits, labels -> vertex flags -> qualities -> counts
//   A tet whose vertices are wrong is left out of all later checks: no bad index is followed.
#include "kernel/integrity.h"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

#include "kernel/exact_orientation.h"
#include "kernel/in_order.h"

namespace tetmend {

namespace {

using Face = std::array<VertexHandle, 3>;

/// Same three vertices in the opposite cyclic order.
bool is_reverse(const Face& a, const Face& b) {
  for (unsigned i = 0; i < 3; ++i) {
    if (a[0] == b[i]) return a[1] == b[(i + 2) % 3] && a[2] == b[(i + 1) % 3];
  }
  return false;
}

class Checker {
 public:
  Checker(const TetMesh& mesh, std::size_t limit) : mesh_(mesh), limit_(limit) {}

  std::vector<Finding> run() {
    check_vertices_of_tets();
    for_each_sound_tet([&](TetHandle t) { check_neighbours(t); });
    check_links();
    check_surface();
    for_each_sound_tet([&](TetHandle t) { check_constraints(t); });
    check_vertex_flags();
    for_each_sound_tet([&](TetHandle t) { check_quality(t); });
    check_counts();
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void report(Finding::Kind kind, TetHandle t, VertexHandle v, fmt::format_string<Args...> text,
              Args&&... args) {
    if (findings_.size() >= limit_) return;
    std::string where;
    if (t.is_valid()) where = fmt::format("tet {}: ", t.index());
    if (v.is_valid()) where += fmt::format("vertex {}: ", v.index());
    findings_.push_back({kind, t, v, where + fmt::format(text, std::forward<Args>(args)...)});
  }
  template <class Visit>
  void for_each_sound_tet(Visit&& visit) {
    for (std::uint32_t i = 0; i < sound_.size(); ++i) {
      if (sound_[i]) visit(TetHandle(i));
    }
  }
  bool is_live(VertexHandle v) const {
    return v.index() < mesh_.vertex_slots() && !mesh_.is_deleted(v);
  }
  bool is_sound(TetHandle t) const { return t.index() < sound_.size() && sound_[t.index()]; }
  /// The half-face on the other side, if it can be followed: inside, of a sound tet.
  bool has_sound_twin(HalfFace f) const {
    const HalfFace twin = mesh_.twin(f);
    return !twin.is_outside() && is_sound(twin.tet());
  }

  void check_vertices_of_tets();
  void check_neighbours(TetHandle t);
  void check_links();
  void check_surface();
  void check_triangles();
  void match_boundary();
  void check_boundary_face(HalfFace face, std::uint32_t k);
  void match_constraints();
  void check_constraints(TetHandle t);
  void check_edge_bits(HalfFace f, HalfFace twin);
  void check_vertex_flags();
  void check_quality(TetHandle t);
  void check_counts();

  const TetMesh& mesh_;
  const std::size_t limit_;
  std::vector<Finding> findings_;
  std::vector<char> sound_;     // live tets whose vertices are live and distinct
  std::vector<char> used_;      // vertices of sound tets
  std::vector<Face> interior_;  // sorted faces of the interior surface triangles, in order
};

void Checker::check_vertices_of_tets() {
  sound_.assign(mesh_.tet_slots(), 0);
  used_.assign(mesh_.vertex_slots(), 0);
  for (std::uint32_t i = 0; i < sound_.size(); ++i) {
    const TetHandle t(i);
    if (mesh_.is_deleted(t)) continue;
    const TetVertices& v = mesh_.vertices(t);
    bool sound = true;
    for (unsigned k = 0; k < 4; ++k) {
      if (!is_live(v[k])) {
        report(Finding::Kind::adjacency, t, v[k], "the tet's vertex {} is not in the mesh", k);
        sound = false;
      }
      for (unsigned l = 0; l < k; ++l) {
        if (v[k] != v[l]) continue;
        report(Finding::Kind::adjacency, t, v[k], "the tet has this vertex twice");
        sound = false;
      }
    }
    sound_[i] = sound;
    if (!sound) continue;
    for (const VertexHandle w : v) used_[w.index()] = 1;
  }
}

void Checker::check_neighbours(TetHandle t) {
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace face(t, f);
    const HalfFace twin = mesh_.twin(face);
    if (twin.is_outside()) continue;  // see check_surface
    const TetHandle u = twin.tet();
    if (u.index() >= mesh_.tet_slots() || mesh_.is_deleted(u)) {
      report(Finding::Kind::adjacency, t, {}, "neighbour {} is tet {}, which is not in the mesh", f,
             u.index());
      continue;
    }
    if (u == t) {
      report(Finding::Kind::adjacency, t, {}, "the tet is its own neighbour {}", f);
      continue;
    }
    if (mesh_.twin(twin) != face) {
      report(Finding::Kind::adjacency, t, {},
             "face {} of neighbour {} does not point back to face {}", twin.face(), u.index(), f);
    }
    if (!sound_[u.index()]) continue;
    const Face here = mesh_.vertices(face);
    const Face there = mesh_.vertices(twin);
    if (in_order(here) != in_order(there)) {
      report(Finding::Kind::adjacency, t, {},
             "face {} and face {} of neighbour {} have other vertices", f, twin.face(), u.index());
    } else if (!is_reverse(here, there)) {
      report(Finding::Kind::orientation, t, {}, "face {} has the same sense in neighbour {}", f,
             u.index());
    }
  }
}

void Checker::check_links() {
  for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh_.is_deleted(v)) continue;
    const TetHandle t = mesh_.tet_of(v);
    if (!t.is_valid()) {
      if (used_[i]) report(Finding::Kind::vertex_link, {}, v, "no tet is stored, but it has one");
    } else if (t.index() >= mesh_.tet_slots() || mesh_.is_deleted(t)) {
      report(Finding::Kind::vertex_link, t, v, "the stored tet is not in the mesh");
    } else if (mesh_.local_index(t, v) == 4) {
      report(Finding::Kind::vertex_link, t, v, "the stored tet does not contain the vertex");
    }
  }
}

void Checker::check_surface() {
  check_triangles();
  match_boundary();
  match_constraints();
}

/// Each by itself; leaves those that are constraints in interior_.
void Checker::check_triangles() {
  const auto triangles = mesh_.surface_triangles();
  for (std::uint32_t k = 0; k < triangles.size(); ++k) {
    for (const VertexHandle v : triangles[k].vertices) {
      if (is_live(v)) continue;
      report(Finding::Kind::boundary, {}, v, "not in the mesh, but in surface triangle {}", k);
    }
    if (!triangles[k].interior || triangles[k].loose) continue;
    interior_.push_back(in_order(triangles[k].vertices));
  }
  std::sort(interior_.begin(), interior_.end());
  if (std::adjacent_find(interior_.begin(), interior_.end()) != interior_.end()) {
    report(Finding::Kind::constraint, {}, {},
           "two interior surface triangles have the same vertices");
  }
}

/// Outside faces and boundary triangles match one to one.
void Checker::match_boundary() {
  const auto triangles = mesh_.surface_triangles();
  std::vector<std::uint8_t> met(triangles.size(), 0);
  for_each_sound_tet([&](TetHandle t) {
    for (unsigned f = 0; f < 4; ++f) {
      if (!mesh_.is_boundary(HalfFace(t, f))) continue;
      const std::uint32_t k = mesh_.twin(HalfFace(t, f)).surface_triangle();
      check_boundary_face(HalfFace(t, f), k);
      if (k < triangles.size() && met[k] < 2) ++met[k];
    }
  });
  for (std::uint32_t k = 0; k < triangles.size(); ++k) {
    if (triangles[k].interior || triangles[k].loose || met[k] == 1) continue;
    const Face& v = triangles[k].vertices;
    if (!is_live(v[0]) || !is_live(v[1]) || !is_live(v[2])) continue;  // told before
    report(Finding::Kind::boundary, {}, {}, "surface triangle {} is the face of {} tets", k,
           met[k] == 0 ? "no" : "several");
  }
}

void Checker::check_boundary_face(HalfFace face, std::uint32_t k) {
  const auto triangles = mesh_.surface_triangles();
  const TetHandle t = face.tet();
  if (k >= triangles.size()) {
    report(Finding::Kind::boundary, t, {}, "face {} names surface triangle {} of {}", face.face(),
           k, triangles.size());
    return;
  }
  if (triangles[k].interior || triangles[k].loose) {
    report(Finding::Kind::boundary, t, {}, "face {} names surface triangle {}, which is {}",
           face.face(), k, triangles[k].interior ? "interior" : "loose");
  }
  if (in_order(mesh_.vertices(face)) != in_order(triangles[k].vertices)) {
    report(Finding::Kind::boundary, t, {}, "face {} and surface triangle {} have other vertices",
           face.face(), k);
  }
}

/// Each interior triangle needs both sides; that the bits of two sides agree is checked by face.
void Checker::match_constraints() {
  std::vector<std::uint8_t> sides(interior_.size(), 0);
  for_each_sound_tet([&](TetHandle t) {
    if (!mesh_.has_constraints(t)) return;
    for (unsigned f = 0; f < 4; ++f) {
      if (!mesh_.is_constrained(HalfFace(t, f))) continue;
      const Face face = in_order(mesh_.vertices(HalfFace(t, f)));
      const auto found = std::lower_bound(interior_.begin(), interior_.end(), face);
      if (found == interior_.end() || *found != face) {
        report(Finding::Kind::constraint, t, {},
               "face {} is marked as constrained, but no interior surface triangle names it", f);
      } else {
        ++sides[static_cast<std::size_t>(found - interior_.begin())];
      }
    }
  });
  for (std::size_t k = 0; k < interior_.size(); ++k) {
    if (sides[k] == 2) continue;
    const Face& v = interior_[k];
    report(Finding::Kind::constraint, {}, {},
           "constrained face ({} {} {}) is marked in {} tets instead of 2", v[0].index(),
           v[1].index(), v[2].index(), sides[k]);
  }
}

/// Edge bits must be the same on both sides of a face, so that they are the same all around an
/// edge.
void Checker::check_edge_bits(HalfFace f, HalfFace twin) {
  const Face v = mesh_.vertices(f);
  for (unsigned i = 0; i < 3; ++i) {
    const VertexHandle a = v[i];
    const VertexHandle b = v[(i + 1) % 3];
    const auto edge_of = [&](TetHandle t) {
      return TetEdge(t, kEdgeOf[mesh_.local_index(t, a)][mesh_.local_index(t, b)]);
    };
    if (mesh_.local_index(twin.tet(), a) == 4 || mesh_.local_index(twin.tet(), b) == 4) continue;
    if (mesh_.is_constrained(edge_of(f.tet())) && !mesh_.is_constrained(edge_of(twin.tet()))) {
      report(Finding::Kind::constraint, f.tet(), {},
             "edge ({} {}) is marked as constrained, but not in tet {}", a.index(), b.index(),
             twin.tet().index());
    }
  }
}

void Checker::check_constraints(TetHandle t) {
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace face(t, f);
    if (!has_sound_twin(face)) continue;
    const HalfFace twin = mesh_.twin(face);
    if (mesh_.is_constrained(face) != mesh_.is_constrained(twin) && face < twin) {
      report(Finding::Kind::constraint, t, {}, "face {} is constrained on one side only", f);
    }
    if (mesh_.label(t) != mesh_.label(twin.tet()) && !mesh_.is_constrained(face) && face < twin) {
      report(Finding::Kind::label, t, {},
             "labels {} and {} meet at face {}, which is not constrained", mesh_.label(t),
             mesh_.label(twin.tet()), f);
    }
    if (mesh_.has_constraints(t)) check_edge_bits(face, twin);
  }
}

void Checker::check_vertex_flags() {
  std::vector<char> boundary(mesh_.vertex_slots(), 0);
  std::vector<char> fixed(mesh_.vertex_slots(), 0);
  for (const SurfaceTriangle& triangle : mesh_.surface_triangles()) {
    for (const VertexHandle v : triangle.vertices) {
      if (!is_live(v)) continue;
      fixed[v.index()] = 1;
      if (!triangle.interior && !triangle.loose) boundary[v.index()] = 1;
    }
  }
  std::vector<char> frozen(mesh_.vertex_slots(), 0);
  for_each_sound_tet([&](TetHandle t) {
    if (mesh_.is_frozen(t)) {
      for (const VertexHandle v : mesh_.vertices(t)) frozen[v.index()] = 1;
    }
    for (unsigned e = 0; e < 6 && mesh_.has_constraints(t); ++e) {
      if (!mesh_.is_constrained(TetEdge(t, e))) continue;
      for (const VertexHandle v : mesh_.vertices(TetEdge(t, e))) fixed[v.index()] = 1;
    }
  });
  for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (mesh_.is_deleted(v)) continue;
    if (mesh_.is_boundary(v) != (boundary[i] != 0)) {
      report(Finding::Kind::boundary, {}, v, "{}",
             boundary[i] ? "on the boundary, but not marked so" : "marked as boundary, but inside");
    }
    if (fixed[i] && !mesh_.is_fixed(v)) {
      report(Finding::Kind::constraint, {}, v, "on a constraint, but free to move");
    }
    if (mesh_.is_frozen(v) != (frozen[i] != 0)) {
      report(Finding::Kind::constraint, {}, v, "{}",
             frozen[i] ? "of a frozen tet, but not marked so"
                       : "marked as frozen, but of no such tet");
    }
  }
}

void Checker::check_quality(TetHandle t) {
  const Quality cached = mesh_.quality(t);
  const Quality computed = mesh_.evaluate(mesh_.vertices(t));
  // By bits, so that a quality that is not a number agrees with itself.
  if (std::bit_cast<std::uint32_t>(cached) == std::bit_cast<std::uint32_t>(computed)) return;
  report(Finding::Kind::quality, t, {}, "the cached quality is {}, the points give {}", cached,
         computed);
}

void Checker::check_counts() {
  std::size_t tets = 0;
  std::size_t vertices = 0;
  for (std::uint32_t i = 0; i < mesh_.tet_slots(); ++i) tets += !mesh_.is_deleted(TetHandle(i));
  for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
    vertices += !mesh_.is_deleted(VertexHandle(i));
  }
  if (tets != mesh_.tet_count()) {
    report(Finding::Kind::count, {}, {}, "{} tets are counted, {} are there", mesh_.tet_count(),
           tets);
  }
  if (vertices != mesh_.vertex_count()) {
    report(Finding::Kind::count, {}, {}, "{} vertices are counted, {} are there",
           mesh_.vertex_count(), vertices);
  }
}

}  // namespace

std::string_view name_of(Finding::Kind kind) {
  static constexpr std::array<std::string_view, 8> kNames = {
      "adjacency", "orientation", "vertex_link", "boundary",
      "label",     "quality",     "constraint",  "count"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<Finding> check_integrity(const TetMesh& mesh, std::size_t limit) {
  return Checker(mesh, limit).run();
}

std::string to_string(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += fmt::format("{}: {}\n", name_of(finding.kind), finding.message);
  }
  return text;
}

std::size_t count_not_positive(const TetMesh& mesh) {
  const ExactOrientation count = count_orientations(mesh);
  return count.zero + count.negative;
}

std::size_t count_not_positive(const TetMesh& mesh, const MeshStatistics& statistics) {
  return statistics.flat == 0 ? statistics.inverted : count_not_positive(mesh);
}

}  // namespace tetmend
