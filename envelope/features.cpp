// SPDX-License-Identifier: MIT
// Features of a surface.
//
//   collect faces -> sides, sorted by edge -> which edges are smooth -> patches -> feature edges ->
//   corners -> lines
#include "envelope/features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "envelope/planes.h"
#include "kernel/geometry.h"
#include "kernel/mesh_view.h"

namespace tetmend {

namespace {

using Ends = std::array<VertexHandle, 2>;

Ends ends_of(VertexHandle a, VertexHandle b) {
  return a < b ? Ends{a, b} : Ends{b, a};
}

std::array<VertexHandle, 3> sorted(std::array<VertexHandle, 3> v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// Finds the features of one mesh.
class FeatureFinder {
 public:
  FeatureFinder(const TetMesh& mesh, const FeatureOptions& options)
      : mesh_(mesh),
        options_(options),
        least_cosine_(std::cos(options.angle * std::numbers::pi / 180)),
        flatness_(flatness(mesh)) {}

  SurfaceFeatures find() {
    found_.places.assign(mesh_.vertex_slots(), SurfacePlace::inside);
    collect_faces();
    collect_named_edges();
    sort_sides();
    join_faces();
    if (options_.flat) {
      split_by_planes();
    } else {
      number_patches();
    }
    collect_edges();
    find_corners();
    make_lines();
    return std::move(found_);
  }

 private:
  struct Kind {  // faces of different kinds are never of one patch
    std::array<Label, 2> sides;
    Label label;
    bool named;
    bool interior;
    auto key() const { return std::tie(sides, label, named, interior); }
  };
  struct Side {
    Ends ends;
    std::uint32_t face;
    bool up;  // the face runs from the lower end to the higher
  };
  struct Named {
    Ends ends;
    Label label;
  };
  struct FeatureEdge {
    Ends ends;
    std::uint32_t first_side, last_side;
    Label label;
    bool named;
  };

  void collect_faces();
  void add_face(HalfFace f, const SurfaceTriangle& triangle);
  void keep(VertexHandle v) { kept_.push_back(v); }
  void collect_named_edges();
  void sort_sides();
  void join_faces();
  bool is_smooth(std::size_t begin, std::size_t end) const;
  Point normal(std::uint32_t face) const {
    const auto& v = found_.faces[face].vertices;
    const Point n =
        (mesh_.point(v[1]) - mesh_.point(v[0])).cross(mesh_.point(v[2]) - mesh_.point(v[0]));
    const double length = n.norm();
    return length > 0 ? Point(n / length) : Point::Zero();
  }
  void number_patches();
  void split_by_planes();
  void add_patch(std::uint32_t face, const Plane& plane);
  void collect_edges();
  void find_corners();
  std::vector<std::uint32_t> count_fans() const;
  void mark_pinched();
  bool bends(std::uint32_t e, std::uint32_t f, VertexHandle v) const;
  bool same_sides(const FeatureEdge& a, const FeatureEdge& b, VertexHandle middle) const;
  void make_lines();
  void walk(VertexHandle from, std::uint32_t edge, std::vector<char>& done);
  void add_line(const std::vector<VertexHandle>& chain, std::uint32_t edge);
  std::size_t straight_end(const std::vector<VertexHandle>& chain, std::size_t begin) const;
  std::span<const std::uint32_t> edges_at(VertexHandle v) const {
    const auto begin = first_edge_[v.index()];
    return {edges_of_.data() + begin, first_edge_[v.index() + 1] - begin};
  }

  const TetMesh& mesh_;
  const FeatureOptions& options_;
  double least_cosine_;
  double flatness_;
  SurfaceFeatures found_;
  std::vector<Kind> kinds_;  // of each face
  std::vector<VertexHandle> kept_;
  std::vector<Named> named_;               // sorted
  std::vector<Ends> walls_;                // edges of faces named inside a region, sorted
  std::vector<Side> sides_;                // sorted by edge
  std::vector<std::uint32_t> group_;       // first side of each edge, then the number of sides
  std::vector<char> smooth_;               // of each edge
  std::vector<std::uint32_t> neighbours_;  // 3 of each face across smooth edges, or itself
  std::vector<FeatureEdge> edges_;
  std::vector<std::uint32_t> edges_of_;  // by vertex
  std::vector<std::uint32_t> first_edge_;
};

void FeatureFinder::add_face(HalfFace f, const SurfaceTriangle& triangle) {
  Kind kind{{mesh_.label(f.tet()), 0}, triangle.label, triangle.named, triangle.interior};
  if (triangle.interior) kind.sides[1] = mesh_.label(mesh_.twin(f).tet());
  found_.faces.push_back({mesh_.vertices(f), 0});
  kinds_.push_back(kind);
  for (const VertexHandle v : mesh_.vertices(f)) {
    found_.places[v.index()] = SurfacePlace::smooth;
  }
}

void FeatureFinder::collect_faces() {
  const auto triangles = mesh_.surface_triangles();
  std::vector<std::pair<std::array<VertexHandle, 3>, std::uint32_t>> inner;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i].loose) {
      for (const VertexHandle v : triangles[i].vertices) keep(v);
    } else if (triangles[i].interior) {
      inner.emplace_back(sorted(triangles[i].vertices), i);
    }
  }
  std::sort(inner.begin(), inner.end());
  for (std::uint32_t i = 0; i < mesh_.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh_.is_deleted(t)) continue;
    for (unsigned k = 0; k < 4; ++k) {
      const HalfFace f(t, k);
      const HalfFace twin = mesh_.twin(f);
      if (twin.is_outside()) {
        add_face(f, triangles[twin.surface_triangle()]);
        continue;
      }
      if (!mesh_.is_constrained(f)) continue;
      const auto v = sorted(mesh_.vertices(f));
      if (mesh_.label(t) == mesh_.label(twin.tet())) {
        for (unsigned e = 0; e < 3; ++e) {
          keep(v[e]);
          walls_.push_back(ends_of(v[e], v[(e + 1) % 3]));
        }
      } else if (mesh_.label(t) < mesh_.label(twin.tet())) {
        const auto at =
            std::lower_bound(inner.begin(), inner.end(), std::pair(v, std::uint32_t{0}));
        add_face(f, triangles[at->second]);
      }
    }
  }
  std::sort(walls_.begin(), walls_.end());
}

void FeatureFinder::collect_named_edges() {
  const MeshView view(mesh_);
  const auto slots = view.vertex_slots();
  const auto vertex = [&](std::uint32_t i) { return VertexHandle(slots.empty() ? i : slots[i]); };
  for (const MeshData::Edge& edge : view.edges()) {
    named_.push_back({ends_of(vertex(edge.vertices[0]), vertex(edge.vertices[1])), edge.label});
  }
  for (const std::uint32_t i : view.required_vertices()) keep(vertex(i));
  kept_.insert(kept_.end(), options_.kept.begin(), options_.kept.end());
  std::sort(named_.begin(), named_.end(), [](const Named& a, const Named& b) {
    return std::tie(a.ends, a.label) < std::tie(b.ends, b.label);
  });
  for (std::size_t i = 1; i < named_.size(); ++i) {  // named twice: which one counts is open
    if (named_[i].ends == named_[i - 1].ends) {
      for (const VertexHandle v : named_[i].ends) keep(v);
    }
  }
}

void FeatureFinder::sort_sides() {
  for (std::uint32_t i = 0; i < found_.faces.size(); ++i) {
    const auto& v = found_.faces[i].vertices;
    for (unsigned k = 0; k < 3; ++k) {
      const VertexHandle a = v[k];
      const VertexHandle b = v[(k + 1) % 3];
      sides_.push_back({ends_of(a, b), i, a < b});
    }
  }
  std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
    return std::tie(a.ends, a.face) < std::tie(b.ends, b.face);
  });
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    if (i == 0 || sides_[i].ends != sides_[i - 1].ends) group_.push_back(i);
  }
  group_.push_back(static_cast<std::uint32_t>(sides_.size()));
}

/// Of an edge, given by its sides: no feature, as far as the two faces tell.
bool FeatureFinder::is_smooth(std::size_t begin, std::size_t end) const {
  if (end - begin != 2) return false;
  const Side& a = sides_[begin];
  const Side& b = sides_[begin + 1];
  if (a.up == b.up || kinds_[a.face].key() != kinds_[b.face].key()) return false;
  if (std::binary_search(walls_.begin(), walls_.end(), a.ends)) return false;
  const auto at = std::lower_bound(named_.begin(), named_.end(), a.ends,
                                   [](const Named& x, const Ends& ends) { return x.ends < ends; });
  if (at != named_.end() && at->ends == a.ends) return false;
  return normal(a.face).dot(normal(b.face)) >= least_cosine_;
}

void FeatureFinder::join_faces() {
  neighbours_.resize(3 * found_.faces.size());
  for (std::uint32_t i = 0; i < neighbours_.size(); ++i) neighbours_[i] = i / 3;
  const auto slot = [&](const Side& side) {
    const auto& v = found_.faces[side.face].vertices;
    const VertexHandle from = side.ends[side.up ? 0 : 1];
    return 3 * side.face + (v[0] == from ? 0 : v[1] == from ? 1 : 2);
  };
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    smooth_.push_back(is_smooth(group_[g], group_[g + 1]));
    if (!smooth_.back()) continue;
    const Side& a = sides_[group_[g]];
    const Side& b = sides_[group_[g] + 1];
    neighbours_[slot(a)] = b.face;
    neighbours_[slot(b)] = a.face;
  }
}

void FeatureFinder::add_patch(std::uint32_t face, const Plane& plane) {
  const Kind& kind = kinds_[face];
  found_.patches.push_back(
      {kind.sides, kind.label, kind.named, kind.interior, plane.origin, plane.normal});
}

void FeatureFinder::number_patches() {
  std::vector<char> seen(found_.faces.size(), 0);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t first = 0; first < found_.faces.size(); ++first) {
    if (seen[first]) continue;
    const auto patch = static_cast<std::uint32_t>(found_.patches.size());
    add_patch(first, {});
    queue.assign(1, first);
    seen[first] = 1;
    while (!queue.empty()) {
      const std::uint32_t i = queue.back();
      queue.pop_back();
      found_.faces[i].patch = patch;
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbours_[3 * i + k];
        if (!std::exchange(seen[next], 1)) queue.push_back(next);
      }
    }
  }
}

void FeatureFinder::split_by_planes() {
  std::vector<std::array<Point, 3>> triangles;
  triangles.reserve(found_.faces.size());
  for (const auto& face : found_.faces) {
    const auto& v = face.vertices;
    triangles.push_back({mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2])});
  }
  const Planes planes = find_planes(triangles, neighbours_, flatness_);
  std::vector<std::uint32_t> first(planes.planes.size(), 0);
  for (std::uint32_t i = 0; i < found_.faces.size(); ++i) {
    found_.faces[i].patch = planes.plane_of[i];
    first[planes.plane_of[i]] = i;
    if (planes.planes[planes.plane_of[i]].normal.isZero()) {  // no area: nothing holds its vertices
      for (const VertexHandle v : found_.faces[i].vertices) keep(v);
    }
  }
  for (std::size_t p = 0; p < planes.planes.size(); ++p) add_patch(first[p], planes.planes[p]);
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    if (!smooth_[g]) continue;
    const Side* sides = &sides_[group_[g]];
    smooth_[g] = planes.plane_of[sides[0].face] == planes.plane_of[sides[1].face];
  }
}

void FeatureFinder::collect_edges() {
  auto named = named_.begin();
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    const Ends& ends = sides_[group_[g]].ends;
    for (; named != named_.end() && named->ends < ends; ++named) {  // not on the surface
      for (const VertexHandle v : named->ends) keep(v);
    }
    const bool is_named = named != named_.end() && named->ends == ends;
    const Label label = is_named ? named->label : 0;
    while (named != named_.end() && named->ends == ends) ++named;
    if (!smooth_[g]) edges_.push_back({ends, group_[g], group_[g + 1], label, is_named});
  }
  for (; named != named_.end(); ++named) {
    for (const VertexHandle v : named->ends) keep(v);
  }
  first_edge_.assign(mesh_.vertex_slots() + 1, 0);
  for (const FeatureEdge& edge : edges_) {
    for (const VertexHandle v : edge.ends) ++first_edge_[v.index() + 1];
  }
  std::partial_sum(first_edge_.begin(), first_edge_.end(), first_edge_.begin());
  edges_of_.resize(2 * edges_.size());
  std::vector<std::uint32_t> next(first_edge_.begin(), std::prev(first_edge_.end()));
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    for (const VertexHandle v : edges_[e].ends) edges_of_[next[v.index()]++] = e;
  }
}

/// The line turns at v by more than the feature angle. Straight lines are found later.
bool FeatureFinder::bends(std::uint32_t e, std::uint32_t f, VertexHandle v) const {
  const auto away = [&](std::uint32_t edge) {
    const Ends& ends = edges_[edge].ends;
    return (mesh_.point(ends[0] == v ? ends[1] : ends[0]) - mesh_.point(v)).normalized();
  };
  return !(-away(e).dot(away(f)) >= least_cosine_);
}

/// Both edges lie between the same patches, as seen along the line.
bool FeatureFinder::same_sides(const FeatureEdge& a, const FeatureEdge& b,
                               VertexHandle middle) const {
  const auto list = [&](const FeatureEdge& edge, bool into) {
    std::vector<std::pair<std::uint32_t, bool>> patches;
    const bool up = (edge.ends[1] == middle) == into;
    for (std::uint32_t s = edge.first_side; s < edge.last_side; ++s) {
      patches.emplace_back(found_.faces[sides_[s].face].patch, sides_[s].up == up);
    }
    std::sort(patches.begin(), patches.end());
    return patches;
  };
  return list(a, true) == list(b, false);
}

void FeatureFinder::find_corners() {
  for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
    const VertexHandle v(i);
    SurfacePlace& place = found_.places[i];
    if (place == SurfacePlace::inside) continue;
    const auto edges = edges_at(v);
    if (mesh_.is_frozen(v)) {
      place = SurfacePlace::corner;
    } else if (!edges.empty()) {
      place = SurfacePlace::ridge;
      if (edges.size() != 2 || edges_[edges[0]].named != edges_[edges[1]].named ||
          edges_[edges[0]].label != edges_[edges[1]].label || bends(edges[0], edges[1], v) ||
          !same_sides(edges_[edges[0]], edges_[edges[1]], v)) {
        place = SurfacePlace::corner;
      }
    }
  }
  for (const VertexHandle v : kept_) {
    if (found_.places[v.index()] != SurfacePlace::inside) {
      found_.places[v.index()] = SurfacePlace::corner;
    }
  }
  mark_pinched();
}

/// Of each vertex: into how many parts its faces fall that smooth edges join.
std::vector<std::uint32_t> FeatureFinder::count_fans() const {
  std::vector<std::uint32_t> parent(3 * found_.faces.size());  // of corners of faces
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const auto corner = [&](std::uint32_t face, VertexHandle v) {
    const auto& w = found_.faces[face].vertices;
    return 3 * face + (w[0] == v ? 0u : w[1] == v ? 1u : 2u);
  };
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    if (!smooth_[g]) continue;
    const Side* pair = &sides_[group_[g]];
    for (const VertexHandle v : pair->ends) {
      parent[root(corner(pair[0].face, v))] = root(corner(pair[1].face, v));
    }
  }
  std::vector<std::uint32_t> fans(mesh_.vertex_slots(), 0);
  for (std::uint32_t c = 0; c < parent.size(); ++c) {
    fans[found_.faces[c / 3].vertices[c % 3].index()] += root(c) == c;
  }
  return fans;
}

/// Sheets that touch at a vertex give it more fans than its feature edges explain: one without
/// them, else one for each two sides of feature edges.
void FeatureFinder::mark_pinched() {
  std::vector<std::uint32_t> sides(mesh_.vertex_slots(), 0);
  for (const FeatureEdge& edge : edges_) {
    for (const VertexHandle v : edge.ends) sides[v.index()] += edge.last_side - edge.first_side;
  }
  const std::vector<std::uint32_t> fans = count_fans();
  for (std::uint32_t v = 0; v < fans.size(); ++v) {
    const std::uint32_t expected = sides[v] == 0 ? 2 : sides[v];
    if (found_.places[v] != SurfacePlace::inside && 2 * fans[v] != expected) {
      found_.places[v] = SurfacePlace::corner;
    }
  }
}

void FeatureFinder::make_lines() {
  std::vector<char> done(edges_.size(), 0);
  for (std::uint32_t i = 0; i < mesh_.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (found_.places[i] != SurfacePlace::corner) continue;
    for (const std::uint32_t e : edges_at(v)) {
      if (!done[e]) walk(v, e, done);
    }
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {  // rings without a corner
    if (!done[e]) walk(edges_[e].ends[0], e, done);
  }
}

/// The line from a vertex on, until a corner or back to the vertex.
void FeatureFinder::walk(VertexHandle from, std::uint32_t edge, std::vector<char>& done) {
  std::vector<VertexHandle> chain = {from};
  const std::uint32_t first = edge;
  for (VertexHandle v = from;;) {
    done[edge] = 1;
    const Ends& ends = edges_[edge].ends;
    v = ends[0] == v ? ends[1] : ends[0];
    chain.push_back(v);
    if (v == from || found_.places[v.index()] == SurfacePlace::corner) break;
    const auto edges = edges_at(v);
    edge = edges[0] == edge ? edges[1] : edges[0];
  }
  if (!options_.flat) return add_line(chain, first);
  if (chain.front() == chain.back()) found_.places[from.index()] = SurfacePlace::corner;
  for (std::size_t begin = 0; begin + 1 < chain.size();) {
    const std::size_t end = straight_end(chain, begin);
    found_.places[chain[end].index()] = SurfacePlace::corner;
    const auto from_begin = chain.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to_end = chain.begin() + static_cast<std::ptrdiff_t>(end);
    add_line({from_begin, to_end + 1}, first);
    begin = end;
  }
}

/// How far the chain goes straight on: forwards all the time, with all vertices on one line.
std::size_t FeatureFinder::straight_end(const std::vector<VertexHandle>& chain,
                                        std::size_t begin) const {
  const Point& origin = mesh_.point(chain[begin]);
  std::size_t end = begin + 1;
  for (; end + 1 < chain.size(); ++end) {
    const Point along = (mesh_.point(chain[end + 1]) - origin).normalized();
    double last = 0;
    for (std::size_t i = begin + 1; i <= end + 1; ++i) {
      const Point d = mesh_.point(chain[i]) - origin;
      const double t = d.dot(along);
      if (!(t > last) || (d - t * along).norm() > flatness_ / 2) return end;
      last = t;
    }
  }
  return end;
}

void FeatureFinder::add_line(const std::vector<VertexHandle>& chain, std::uint32_t edge) {
  const auto line = static_cast<std::uint32_t>(found_.lines.size());
  SurfaceFeatures::Line data{edges_[edge].label, edges_[edge].named};
  if (options_.flat) {
    data.origin = mesh_.point(chain.front());
    data.direction = (mesh_.point(chain.back()) - data.origin).normalized();
  }
  found_.lines.push_back(data);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    found_.edges.push_back({{chain[i], chain[i + 1]}, line});
  }
}

}  // namespace

double flatness(const TetMesh& mesh) {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    if (mesh.is_deleted(VertexHandle(i))) continue;
    low = low.cwiseMin(mesh.point(VertexHandle(i)));
    high = high.cwiseMax(mesh.point(VertexHandle(i)));
  }
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  return std::max(1e-13 * (high - low).norm(), kRounding * largest);
}

SurfaceFeatures find_features(const TetMesh& mesh, const FeatureOptions& options) {
  return FeatureFinder(mesh, options).find();
}

}  // namespace tetmend
