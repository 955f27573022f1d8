// SPDX-License-Identifier: MIT
// Builds a TetMesh from plain arrays: orientation, adjacency, constraints, qualities.
//
//   check indices
//   orient: swap two vertices of every tet if most are negative; of single tets that are not
//   positive if their neighbours ask for it match faces: bucket the half-faces by smallest vertex,
//   sort each bucket by the other two, pair equal ones surface: named triangles in file order, then
//   boundary faces and label interfaces that no triangle names constraints: face bits, edge bits,
//   fixed vertices
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "kernel/shell.h"
#include "kernel/tet_mesh.h"
#include "kernel/workspace.h"

namespace tetmend {

class MeshBuilder {
 public:
  MeshBuilder(const MeshData& data, TetMesh& mesh, BuildReport& report)
      : data_(data), mesh_(mesh), report_(report) {}

  void build() {
    check_indices();
    copy_points();
    copy_tets();
    orient();
    match_all_faces();
    build_surface();
    link_vertices();
    evaluate();
    mark_edges();
    mark_vertices();
  }

 private:
  /// A half-face in the bucket of its smallest vertex; `even` tells in which sense the tet lists
  /// (smallest, low, high).
  struct FaceRecord {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t half_face;
    bool even;
  };

  void check_indices() const;
  void copy_points();
  void copy_tets();
  void orient();
  void reorder_tets();
  void fill_buckets();
  void match_all_faces();
  std::size_t count_same_side() const;
  void match_pair(const FaceRecord& a, const FaceRecord& b);
  void build_surface();
  void add_surface_face(HalfFace f, SurfaceTriangle triangle);
  void link_vertices();
  void evaluate();
  void mark_edges();
  void mark_vertices();
  [[noreturn]] void fail_same_side(const FaceRecord& a, const FaceRecord& b) const;

  void swap_orientation(std::size_t t) {
    std::swap(mesh_.cells_[t].vertices[2], mesh_.cells_[t].vertices[3]);
  }
  double tet_volume6(std::size_t t) const {
    const TetVertices& v = mesh_.cells_[t].vertices;
    return volume6(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
  }
  std::string describe(std::size_t t) const {
    const auto& v = data_.tets[t].vertices;
    return fmt::format("tet {} (vertices {} {} {} {})", t + 1, v[0] + 1, v[1] + 1, v[2] + 1,
                       v[3] + 1);
  }
  bool is_flat(std::size_t t, double v6) const {
    const TetVertices& v = mesh_.cells_[t].vertices;
    const double sign = v6 < 0 ? -1.0 : 1.0;
    return sign > 0 ? !mesh_.is_certified_positive(v)
                    : !mesh_.is_certified_positive({v[0], v[1], v[3], v[2]});
  }

  const MeshData& data_;
  TetMesh& mesh_;
  BuildReport& report_;
  std::vector<std::uint32_t> bucket_begin_;  // by smallest vertex
  std::vector<FaceRecord> records_;
};

void MeshBuilder::check_indices() const {
  const std::size_t n = data_.points.size();
  if (data_.tets.empty()) throw Error("the mesh has no tetrahedra");
  if (data_.tets.size() >= (std::size_t{1} << 29) || n >= (std::size_t{1} << 31)) {
    throw Error(fmt::format("{} tetrahedra and {} points are more than 32-bit indices can name",
                            data_.tets.size(), n));
  }
  for (std::size_t t = 0; t < data_.tets.size(); ++t) {
    const auto& v = data_.tets[t].vertices;
    for (std::size_t i = 0; i < 4; ++i) {
      if (v[i] >= n) {
        throw BuildError(fmt::format("{}: no point {}, there are {}", describe(t), v[i] + 1ull, n),
                         t);
      }
      for (std::size_t j = 0; j < i; ++j) {
        if (v[i] == v[j]) throw BuildError(describe(t) + ": the same vertex twice", t);
      }
    }
  }
  const auto check = [n](std::span<const std::uint32_t> vertices, const char* what,
                         std::size_t number) {
    for (const std::uint32_t v : vertices) {
      if (v >= n)
        throw Error(fmt::format("{} {}: no point {}, there are {}", what, number + 1, v + 1ull, n));
    }
  };
  for (std::size_t i = 0; i < data_.triangles.size(); ++i)
    check(data_.triangles[i].vertices, "triangle", i);
  for (std::size_t i = 0; i < data_.edges.size(); ++i) check(data_.edges[i].vertices, "edge", i);
  check(data_.required_vertices, "required vertex", 0);
}

void MeshBuilder::copy_points() {
  const std::size_t n = data_.points.size();
  mesh_.points_ = data_.points;
  mesh_.vertex_tet_.assign(n, TetHandle());
  mesh_.vertex_flags_.assign(n, 0);
  mesh_.vertex_date_.assign(n, 0);
  mesh_.vertex_moved_.assign(n, 0);
  mesh_.vertex_origin_.resize(n);
  for (std::uint32_t v = 0; v < n; ++v) mesh_.vertex_origin_[v] = v;
  mesh_.vertex_count_ = n;
  mesh_.vertex_properties_.resize(n);
  mesh_.point_labels_ = data_.point_labels;
}

void MeshBuilder::copy_tets() {
  const std::size_t n = data_.tets.size();
  mesh_.cells_.resize(n);
  mesh_.label_.resize(n);
  mesh_.tet_flags_.assign(n, 0);
  mesh_.quality_.assign(n,
                        0);  // computed in the end; a workspace that looks at them is needed before
  mesh_.tet_count_ = n;
  mesh_.tet_properties_.resize(n);
  for (std::size_t t = 0; t < n; ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      mesh_.cells_[t].vertices[i] = VertexHandle(data_.tets[t].vertices[i]);
    }
    mesh_.label_[t] = data_.tets[t].label;
  }
}

/// Counts, for the orientation at hand, the faces on whose one side two tets lie.
std::size_t MeshBuilder::count_same_side() const {
  std::size_t count = 0;
  for (std::size_t i = 1; i < records_.size(); ++i) {
    const FaceRecord& a = records_[i - 1];
    const FaceRecord& b = records_[i];
    const bool same_bucket = !std::binary_search(bucket_begin_.begin(), bucket_begin_.end(), i);
    if (same_bucket && a.low == b.low && a.high == b.high && a.even == b.even) ++count;
  }
  return count;
}

void MeshBuilder::orient() {
  std::size_t negative = 0;
  std::size_t positive = 0;
  for (std::size_t t = 0; t < mesh_.cells_.size(); ++t) {
    const double v6 = tet_volume6(t);
    if (v6 < 0) ++negative;
    if (v6 > 0) ++positive;
  }
  if (negative > positive) {
    report_.mirrored = true;
    for (std::size_t t = 0; t < mesh_.cells_.size(); ++t) swap_orientation(t);
  }
  fill_buckets();
  // A negative tet is folded over, or it lists its vertices the other way round. Only the latter
  // clashes with its neighbours.
  if (count_same_side() > 0) reorder_tets();
}

/// Gives each tet that is not certainly positive the sense that its neighbours ask for, from the
/// positive tets inwards.
void MeshBuilder::reorder_tets() {
  const std::size_t n = mesh_.cells_.size();
  // Neighbours by half-face, with the top bit set where both tets list the face in the same sense.
  constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  constexpr std::uint32_t kSame = 0x80000000u;
  std::vector<std::uint32_t> across(4 * n, kNone);
  for (std::size_t i = 1; i < records_.size(); ++i) {
    const FaceRecord& a = records_[i - 1];
    const FaceRecord& b = records_[i];
    const bool same_bucket = !std::binary_search(bucket_begin_.begin(), bucket_begin_.end(), i);
    if (!same_bucket || a.low != b.low || a.high != b.high) continue;
    across[a.half_face] = b.half_face | (a.even == b.even ? kSame : 0);
    across[b.half_face] = a.half_face | (a.even == b.even ? kSame : 0);
  }
  std::vector<char> settled(n, 0);
  std::vector<char> swapped(n, 0);
  std::vector<std::uint32_t> queue;
  const auto settle = [&](std::uint32_t t, bool swap) {
    settled[t] = 1;
    swapped[t] = swap;
    queue.push_back(t);
  };
  const auto spread = [&] {
    while (!queue.empty()) {
      const std::uint32_t t = queue.back();
      queue.pop_back();
      for (std::uint32_t f = 4 * t; f < 4 * t + 4; ++f) {
        if (across[f] == kNone) continue;
        const std::uint32_t u = (across[f] & ~kSame) >> 2;
        if (!settled[u]) settle(u, (swapped[t] != 0) != ((across[f] & kSame) != 0));
      }
    }
  };
  for (std::uint32_t t = 0; t < n; ++t) {
    if (mesh_.is_certified_positive(mesh_.cells_[t].vertices)) settle(t, false);
  }
  spread();
  for (std::uint32_t t = 0; t < n; ++t) {  // parts without a positive tet
    if (settled[t]) continue;
    settle(t, tet_volume6(t) < 0);
    spread();
  }
  for (std::uint32_t t = 0; t < n; ++t) {
    if (!swapped[t]) continue;
    swap_orientation(t);
    ++report_.reordered_tets;
  }
  fill_buckets();
}

void MeshBuilder::fill_buckets() {
  const std::size_t faces = 4 * mesh_.cells_.size();
  bucket_begin_.assign(mesh_.points_.size() + 1, 0);
  records_.resize(faces);
  const auto smallest = [&](std::uint32_t code) {
    const auto v = mesh_.vertices(HalfFace::from_code(code));
    return std::min({v[0], v[1], v[2]}).index();
  };
  for (std::uint32_t code = 0; code < faces; ++code) ++bucket_begin_[smallest(code) + 1];
  for (std::size_t v = 1; v < bucket_begin_.size(); ++v) bucket_begin_[v] += bucket_begin_[v - 1];
  std::vector<std::uint32_t> next(bucket_begin_.begin(), bucket_begin_.end() - 1);
  for (std::uint32_t code = 0; code < faces; ++code) {
    auto v = mesh_.vertices(HalfFace::from_code(code));
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    const bool even = v[1] < v[2];
    records_[next[v[0].index()]++] = {std::min(v[1], v[2]).index(), std::max(v[1], v[2]).index(),
                                      code, even};
  }
  for (std::size_t v = 0; v + 1 < bucket_begin_.size(); ++v) {
    std::sort(records_.begin() + bucket_begin_[v], records_.begin() + bucket_begin_[v + 1],
              [](const FaceRecord& a, const FaceRecord& b) {
                return std::tie(a.low, a.high, a.half_face) < std::tie(b.low, b.high, b.half_face);
              });
  }
}

void MeshBuilder::fail_same_side(const FaceRecord& a, const FaceRecord& b) const {
  const std::size_t t = HalfFace::from_code(a.half_face).tet().index();
  const std::size_t u = HalfFace::from_code(b.half_face).tet().index();
  throw BuildError(
      fmt::format("{} and {} lie on the same side of their common face", describe(u), describe(t)),
      u);
}

void MeshBuilder::match_pair(const FaceRecord& a, const FaceRecord& b) {
  if (a.even == b.even) fail_same_side(a, b);
  const HalfFace f = HalfFace::from_code(a.half_face);
  const HalfFace g = HalfFace::from_code(b.half_face);
  mesh_.cells_[f.tet().index()].neighbours[f.face()] = g;
  mesh_.cells_[g.tet().index()].neighbours[g.face()] = f;
}

void MeshBuilder::match_all_faces() {
  for (std::size_t v = 0; v + 1 < bucket_begin_.size(); ++v) {
    const std::size_t end = bucket_begin_[v + 1];
    for (std::size_t i = bucket_begin_[v]; i < end;) {
      std::size_t j = i + 1;
      while (j < end && records_[j].low == records_[i].low && records_[j].high == records_[i].high)
        ++j;
      if (j - i > 2) {
        const std::size_t t = HalfFace::from_code(records_[i + 2].half_face).tet().index();
        throw BuildError(fmt::format("{}: a face of it has more than two tets", describe(t)), t);
      }
      if (j - i == 2) match_pair(records_[i], records_[i + 1]);
      i = j;
    }
  }
}

/// Registers a triangle as a face of the mesh: boundary number or constraint bits.
void MeshBuilder::add_surface_face(HalfFace f, SurfaceTriangle triangle) {
  const auto number = static_cast<std::uint32_t>(mesh_.surface_.size());
  TetMesh::Cell& cell = mesh_.cells_[f.tet().index()];
  const HalfFace twin = cell.neighbours[f.face()];
  triangle.interior = !twin.is_outside();
  if (triangle.interior) {
    mesh_.tet_flags_[f.tet().index()] |= static_cast<TetMesh::TetFlags>(1u << f.face());
    mesh_.tet_flags_[twin.tet().index()] |= static_cast<TetMesh::TetFlags>(1u << twin.face());
    ++report_.constrained_faces;
  } else {
    cell.neighbours[f.face()] = HalfFace::outside(number);
  }
  mesh_.surface_.push_back(triangle);
}

void MeshBuilder::build_surface() {
  for (const MeshData::Triangle& named : data_.triangles) {
    auto v = named.vertices;
    const SurfaceTriangle triangle{{VertexHandle(v[0]), VertexHandle(v[1]), VertexHandle(v[2])},
                                   named.label,
                                   true,
                                   false,
                                   false};
    std::sort(v.begin(), v.end());
    const auto begin = records_.begin() + bucket_begin_[v[0]];
    const auto end = records_.begin() + bucket_begin_[v[0] + 1];
    const auto found = std::find_if(
        begin, end, [&](const FaceRecord& r) { return r.low == v[1] && r.high == v[2]; });
    const HalfFace f = found == end ? HalfFace() : HalfFace::from_code(found->half_face);
    const bool repeated =
        found != end &&
        (mesh_.is_constrained(f) || (mesh_.twin(f).is_outside() && mesh_.twin(f) != HalfFace()));
    if (found == end || repeated) {
      mesh_.surface_.push_back(triangle);
      mesh_.surface_.back().loose = true;
      ++report_.loose_triangles;
    } else {
      add_surface_face(f, triangle);
    }
  }
  for (std::uint32_t code = 0; code < 4 * mesh_.cells_.size(); ++code) {
    const HalfFace f = HalfFace::from_code(code);
    const HalfFace twin = mesh_.twin(f);
    const bool unnamed_boundary = twin == HalfFace();
    const bool interface = !twin.is_outside() && f < twin && !mesh_.is_constrained(f) &&
                           mesh_.label(f.tet()) != mesh_.label(twin.tet());
    if (unnamed_boundary || interface)
      add_surface_face(f, {mesh_.vertices(f), 0, false, false, false});
  }
}

void MeshBuilder::link_vertices() {
  for (std::uint32_t t = 0; t < mesh_.cells_.size(); ++t) {
    for (const VertexHandle v : mesh_.cells_[t].vertices)
      mesh_.vertex_tet_[v.index()] = TetHandle(t);
  }
  for (const TetHandle t : mesh_.vertex_tet_) report_.unused_points += !t.is_valid();
}

void MeshBuilder::mark_edges() {
  Workspace workspace(mesh_);
  for (const MeshData::Edge& named : data_.edges) {
    const VertexHandle a(named.vertices[0]);
    const VertexHandle b(named.vertices[1]);
    mesh_.named_edges_.push_back({{a, b}, named.label});
    // Of a loose edge as well: a deleted vertex could not be written.
    for (const VertexHandle v : {a, b})
      mesh_.vertex_flags_[v.index()] |= TetMesh::kVertexConstrained;
    const std::optional<TetEdge> edge = find_edge(mesh_, a, b, workspace);
    if (!edge) {
      ++report_.loose_edges;
      continue;
    }
    for (const TetEdge e : shell(mesh_, *edge)) {
      mesh_.tet_flags_[e.tet().index()] |= static_cast<TetMesh::TetFlags>(16u << e.edge());
    }
  }
}

void MeshBuilder::mark_vertices() {
  for (const SurfaceTriangle& triangle : mesh_.surface_) {
    const auto flag = triangle.interior || triangle.loose ? TetMesh::kVertexConstrained
                                                          : TetMesh::kVertexBoundary;
    for (const VertexHandle v : triangle.vertices) mesh_.vertex_flags_[v.index()] |= flag;
  }
  for (const std::uint32_t v : data_.required_vertices) {
    mesh_.vertex_flags_[v] |= TetMesh::kVertexConstrained | TetMesh::kVertexRequired;
  }
}

void MeshBuilder::evaluate() {
  const std::size_t n = mesh_.cells_.size();
  for (std::size_t t = 0; t < n; ++t) {
    const double v6 = tet_volume6(t);
    mesh_.quality_[t] = mesh_.evaluate(mesh_.cells_[t].vertices);
    if (is_flat(t, v6)) {
      ++report_.flat_tets;
    } else if (v6 < 0) {
      ++report_.inverted_tets;
    }
  }
}

TetMesh::TetMesh(const MeshData& data, BuildReport* report) {
  BuildReport own;
  MeshBuilder(data, *this, report ? *report : own).build();
}

}  // namespace tetmend
