// SPDX-License-Identifier: MIT
#include "viewer/mesh/selection.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/star.h"
#include "kernel/statistics.h"
#include "kernel/workspace.h"
#include "viewer/mesh/direction.h"

namespace tetmend::viewer {

namespace {

constexpr float kThin = 2;
constexpr float kWide = 5;

/// Distance along the ray to the triangle, or infinity ([moeller_trumbore]).
double distance_to(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const glm::dvec3 u = b - a;
  const glm::dvec3 v = c - a;
  const glm::dvec3 p = glm::cross(ray.direction, v);
  const double det = glm::dot(u, p);
  if (det == 0) return kMiss;
  const glm::dvec3 s = ray.origin - a;
  const double x = glm::dot(s, p) / det;
  const glm::dvec3 q = glm::cross(s, u);
  const double y = glm::dot(ray.direction, q) / det;
  if (x < 0 || y < 0 || x + y > 1) return kMiss;
  const double t = glm::dot(v, q) / det;
  return t >= 0 ? t : kMiss;
}

/// Triangles without a tet are passed over.
std::optional<Hit> first_hit(std::span<const SurfaceVertex> corners,
                             std::span<const TetHandle> tets, const glm::dvec3& origin,
                             const Ray& ray) {
  const Ray local = {ray.origin - origin, ray.direction};
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const double d =
        distance_to(local, corners[i].position, corners[i + 1].position, corners[i + 2].position);
    if (d >= nearest || !tets[i / 3].is_valid()) continue;
    nearest = d;
    best = i / 3;
  }
  if (nearest == std::numeric_limits<double>::infinity()) return std::nullopt;
  return Hit{tets[best], ray.origin + nearest * ray.direction};
}

glm::dvec3 at(const TetMesh& mesh, VertexHandle v) {
  return to_glm(mesh.point(v));
}

/// The tets of a vertex, from face to face. Needs no marks by slot as star() does.
std::vector<TetHandle> tets_of_vertex(const TetMesh& mesh, VertexHandle v) {
  std::vector<TetHandle> found = {mesh.tet_of(v)};
  std::unordered_set<std::uint32_t> known = {found.front().index()};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const unsigned opposite = mesh.local_index(found[i], v);
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh.twin(HalfFace(found[i], f));
      if (f == opposite || twin.is_outside()) continue;
      if (known.insert(twin.tet().index()).second) found.push_back(twin.tet());
    }
  }
  return found;
}

std::vector<VertexHandle> vertices_around(const TetMesh& mesh, VertexHandle v,
                                          const std::vector<TetHandle>& tets) {
  std::vector<VertexHandle> found;
  for (const TetHandle t : tets) {
    for (const VertexHandle w : mesh.vertices(t)) {
      if (w != v) found.push_back(w);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Collects the parts of a highlight.
class SelectionPainter {
 public:
  SelectionPainter(const TetMesh& mesh, const glm::dvec3& origin) : mesh_(mesh), origin_(origin) {}

  void line(VertexHandle a, VertexHandle b, const Colour& colour, float width) {
    out_.lines.push_back(
        {glm::vec3(at(mesh_, a) - origin_), glm::vec3(at(mesh_, b) - origin_), colour, width});
  }
  /// Both sides.
  void face(VertexHandle a, VertexHandle b, VertexHandle c, const Colour& colour) {
    const std::array<glm::dvec3, 3> corners = {at(mesh_, a), at(mesh_, b), at(mesh_, c)};
    add_triangle(out_.faces, corners, colour, origin_);
  }

  void paint(std::monostate) {}
  void paint(TetHandle t) {
    const TetVertices& v = mesh_.vertices(t);
    Colour colour = kSelectionColour;
    colour.alpha = 50;  // red stays red
    for (const auto& f : kFaceVertices) face(v[f[0]], v[f[1]], v[f[2]], colour);
    for (const auto& e : kEdgeVertices) line(v[e[0]], v[e[1]], kSelectionColour, 3);
  }
  void paint(TetEdge edge) {
    const auto ends = mesh_.vertices(edge);
    for (const TetHandle t : ring(mesh_, edge).tets) {
      const TetEdge e = *edge_in(mesh_, t, ends[0], ends[1]);
      const TetVertices& v = mesh_.vertices(t);
      const auto& across = kEdgeVertices[5 - e.edge()];
      const VertexHandle p = v[across[0]];
      const VertexHandle q = v[across[1]];
      // Outlines: a veil over red tets has a colour of its own, which means nothing.
      for (const VertexHandle end : ends) {
        line(end, p, kLinkEdgeColour, kThin);
        line(end, q, kLinkEdgeColour, kThin);
      }
      line(p, q, kSkirtColour, 4);
    }
    line(ends[0], ends[1], kSupportingEdgeColour, kWide);
  }
  void paint(HalfFace f) {
    const auto c = mesh_.vertices(f);
    face(c[0], c[1], c[2], kSupportingFaceColour);
    for (unsigned i = 0; i < 3; ++i) line(c[i], c[(i + 1) % 3], kSupportingEdgeColour, 4);
  }
  void paint(VertexHandle v) {
    if (!mesh_.tet_of(v).is_valid()) return;
    for (const TetHandle t : tets_of_vertex(mesh_, v)) {
      const auto c = mesh_.vertices(HalfFace(t, mesh_.local_index(t, v)));
      for (unsigned i = 0; i < 3; ++i) {
        line(c[i], c[(i + 1) % 3], kLinkEdgeColour, 1);
        line(v, c[i], kSkirtColour, kThin);
      }
    }
    out_.lines.push_back({glm::vec3(at(mesh_, v) - origin_), glm::vec3(at(mesh_, v) - origin_),
                          kSupportingEdgeColour, 12});
  }

  Highlight take() { return std::move(out_); }

 private:
  const TetMesh& mesh_;
  glm::dvec3 origin_;
  Highlight out_;
};

/// The face of its tet that the hit lies on.
HalfFace face_at(const TetMesh& mesh, const Hit& hit) {
  double nearest = std::numeric_limits<double>::infinity();
  HalfFace found(hit.tet, 0);
  for (unsigned f = 0; f < 4; ++f) {
    const auto c = corners(mesh, HalfFace(hit.tet, f));
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double length = glm::length(normal);
    if (length == 0) continue;
    const double away = std::abs(glm::dot(normal, hit.point - c[0])) / length;
    if (away < nearest) found = HalfFace(hit.tet, f);
    nearest = std::min(nearest, away);
  }
  return found;
}

std::string angle(double degrees) {
  return fmt::format("{:.2f}°", degrees);
}

std::string name_of_shell(ShellKind kind) {
  switch (kind) {
    case ShellKind::closed:
      return "closed";
    case ShellKind::boundary:
      return "open: the edge lies on the boundary";
    case ShellKind::constrained:
      return "constrained";
    case ShellKind::too_large:
      return fmt::format("larger than {} tets", kMaxDegree);
    case ShellKind::border:
      return "open";
  }
  return {};
}

class Teller {
 public:
  explicit Teller(const TetMesh& mesh) : mesh_(mesh) {}

  void tell(std::monostate) {}
  void tell(TetHandle t) {
    const TetVertices& v = mesh_.vertices(t);
    const std::array<Point, 4> p = {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]),
                                    mesh_.point(v[3])};
    row("tet", fmt::format("{}", t.index()));
    row("region", fmt::format("{}", mesh_.label(t)));
    list("vertices", v);
    const bool is_bad = mesh_.quality(t) < kBadThreshold;
    const Standard& standard = mesh_.standard();
    row(standard.is_own() ? fmt::format("quality by {}", standard.measure_name()) : "quality",
        fmt::format("{:.4f}{}", mesh_.quality(t),
                    !is_bad                 ? ""
                    : standard.is_own()     ? "  (bad)"
                    : misses_goal(mesh_, t) ? "  (misses the goal)"
                                            : "  (a needle)"));
    for (const QualityMeasure& m : quality_measures()) {
      row(std::string(m.name), fmt::format("{:.4f}", m.evaluate(p[0], p[1], p[2], p[3])));
    }
    row("volume", volume_text(volume6(p[0], p[1], p[2], p[3]) / 6, mesh_.scale().exponent(), 4));
    const auto angles = dihedral_angles(p[0], p[1], p[2], p[3]);
    for (unsigned e = 0; e < 6; ++e) {
      const auto& ends = kEdgeVertices[e];
      row(fmt::format("angle {}-{}", v[ends[0]].index(), v[ends[1]].index()), angle(angles[e]),
          {TetEdge(t, e)});
    }
    std::vector<TetHandle> neighbours;
    for (const HalfFace n : mesh_.neighbours(t)) {
      if (!n.is_outside()) neighbours.push_back(n.tet());
    }
    list("neighbours", neighbours);
  }
  void tell(TetEdge edge) {
    const auto ends = mesh_.vertices(edge);
    Shell found;
    const ShellKind kind = find_shell(mesh_, edge, found, Territory());
    list("supporting edge", ends);
    row("length", fmt::format("{:.4g}", mesh_.scale().to_file(glm::distance(at(mesh_, ends[0]),
                                                                            at(mesh_, ends[1])))));
    row("shell", name_of_shell(kind));
    Quality worst = std::numeric_limits<Quality>::infinity();
    std::vector<TetHandle> tets;
    for (const TetHandle t : ring(mesh_, edge).tets) {
      worst = std::min(worst, mesh_.quality(t));
      tets.push_back(t);
    }
    row("degree (tets)", fmt::format("{}", tets.size()));
    row("worst quality", fmt::format("{:.4f}", worst));
    list("tets", tets);
    const bool is_closed = kind == ShellKind::closed;
    if (!is_closed) return;
    list("skirt polygon",
         std::vector<VertexHandle>(found.ring.begin(), found.ring.begin() + found.degree));
    row("supporting faces", fmt::format("{}", found.degree));
    row("link faces", fmt::format("{}", 2 * found.degree));
  }
  void tell(HalfFace f) {
    const auto c = mesh_.vertices(f);
    const HalfFace twin = mesh_.twin(f);
    list("face", c);
    const glm::dvec3 a = at(mesh_, c[0]);
    const double area = glm::length(glm::cross(at(mesh_, c[1]) - a, at(mesh_, c[2]) - a)) / 2;
    const double scale = mesh_.scale().to_file(1.0);
    row("area", fmt::format("{:.4g}", area * scale * scale));
    row("kind", twin.is_outside() ? "on the boundary" : "between two tets");
    std::vector<TetHandle> tets = {f.tet()};
    if (!twin.is_outside()) tets.push_back(twin.tet());
    list("tets", tets);
  }
  void link_to_edges(VertexHandle v, const std::vector<VertexHandle>& neighbours) {
    Workspace workspace(mesh_);
    std::vector<std::string> words;
    std::vector<Selection> links;
    for (const VertexHandle w : neighbours) {
      const auto edge = find_edge(mesh_, v, w, workspace);
      if (!edge) continue;
      words.push_back(fmt::format("{}", w.index()));
      links.emplace_back(*edge);
    }
    row("edges to", fmt::format("{}", fmt::join(words, " ")), std::move(links));
  }
  void tell(VertexHandle v) {
    const Point p = mesh_.point_in_file(v);
    row("vertex", fmt::format("{}", v.index()));
    row("point", fmt::format("{:.6g} {:.6g} {:.6g}", p.x(), p.y(), p.z()));
    row("kind", mesh_.is_boundary(v) ? "on the boundary" : mesh_.is_fixed(v) ? "fixed" : "free");
    if (!mesh_.tet_of(v).is_valid()) return;
    Quality worst = std::numeric_limits<Quality>::infinity();
    const auto ball = tets_of_vertex(mesh_, v);
    for (const TetHandle t : ball) worst = std::min(worst, mesh_.quality(t));
    row("ball (tets)", fmt::format("{}", ball.size()));
    row("worst quality", fmt::format("{:.4f}", worst));
    const auto neighbours = vertices_around(mesh_, v, ball);
    row("one-ring", fmt::format("{} vertices", neighbours.size()));
    link_to_edges(v, {neighbours.begin(), neighbours.end()});
    list("tets", ball);
  }

  std::vector<Row> take() { return std::move(rows_); }

 private:
  void row(std::string name, std::string value, std::vector<Selection> links = {}) {
    rows_.push_back({std::move(name), std::move(value), std::move(links)});
  }
  /// Numbers, each of which leads to what it names.
  template <class Handles>
  void list(std::string name, const Handles& handles) {
    std::vector<std::string> words;
    std::vector<Selection> links;
    for (const auto handle : handles) {
      words.push_back(fmt::format("{}", handle.index()));
      links.emplace_back(handle);
    }
    row(std::move(name), fmt::format("{}", fmt::join(words, " ")), std::move(links));
  }

  const TetMesh& mesh_;
  std::vector<Row> rows_;
};

}  // namespace

std::optional<Hit> cast(const Scene& scene, const Ray& ray) {
  return first_hit(scene.surface, scene.surface_tets, scene.origin, ray);
}

std::optional<Hit> cast_through(const Scene& scene, const Ray& ray) {
  return first_hit(scene.through, scene.through_tets, scene.origin, ray);
}

Selection refine(const TetMesh& mesh, const Hit& hit, PickKind kind, const Camera& camera,
                 const Canvas& canvas) {
  if (kind == PickKind::tet) return hit.tet;
  const auto mouse = camera.project(hit.point, canvas);
  if (!mouse) return hit.tet;
  std::array<glm::dvec2, 4> seen;
  const auto c = corners(mesh, hit.tet);
  for (unsigned i = 0; i < 4; ++i) {
    const auto pixel = camera.project(c[i], canvas);
    if (!pixel) return hit.tet;
    seen[i] = *pixel;
  }
  double to_vertex = std::numeric_limits<double>::infinity();
  double to_edge = to_vertex;
  double extent = 0;
  unsigned vertex = 0;
  unsigned edge = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const double d = glm::distance(*mouse, seen[i]);
    if (d < to_vertex) vertex = i;
    to_vertex = std::min(to_vertex, d);
  }
  for (unsigned e = 0; e < 6; ++e) {
    const glm::dvec2& a = seen[kEdgeVertices[e][0]];
    const glm::dvec2& b = seen[kEdgeVertices[e][1]];
    const double d = distance_to_segment(*mouse, a, b);
    if (d < to_edge) edge = e;
    to_edge = std::min(to_edge, d);
    extent = std::max(extent, glm::distance(a, b));
  }
  constexpr double kVertexReach = 8;
  constexpr double kEdgeReach = 4;
  // On a small tet most of the face must still mean the tet.
  const double share = std::min(1.0, extent / 80);
  if (kind == PickKind::face) return face_at(mesh, hit);
  if (kind == PickKind::vertex || (kind == PickKind::nearest && to_vertex < share * kVertexReach)) {
    return mesh.vertices(hit.tet)[vertex];
  }
  if (kind == PickKind::edge || to_edge < share * kEdgeReach) return TetEdge(hit.tet, edge);
  return hit.tet;
}

Ball ball_around(const TetMesh& mesh, const Selection& selection) {
  std::vector<glm::dvec3> points;
  if (const auto* t = std::get_if<TetHandle>(&selection)) {
    for (const glm::dvec3& p : corners(mesh, *t)) points.push_back(p);
  } else if (const auto* e = std::get_if<TetEdge>(&selection)) {
    for (const TetHandle around : ring(mesh, *e).tets) {
      for (const glm::dvec3& p : corners(mesh, around)) points.push_back(p);
    }
  } else if (const auto* f = std::get_if<HalfFace>(&selection)) {
    for (const glm::dvec3& p : corners(mesh, *f)) points.push_back(p);
  } else if (const auto* v = std::get_if<VertexHandle>(&selection)) {
    points.push_back(at(mesh, *v));
    if (mesh.tet_of(*v).is_valid()) {
      for (const VertexHandle w : vertices_around(mesh, *v, tets_of_vertex(mesh, *v))) {
        points.push_back(at(mesh, w));
      }
    }
  }
  glm::dvec3 low = points.front();
  glm::dvec3 high = low;
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  constexpr double kSurroundings = 1.6;
  return {(low + high) / 2.0, std::max(kSurroundings * glm::distance(low, high) / 2, 1e-12)};
}

Highlight highlight(const TetMesh& mesh, const Selection& selection, const glm::dvec3& origin) {
  SelectionPainter painter(mesh, origin);
  std::visit([&](const auto& what) { painter.paint(what); }, selection);
  return painter.take();
}

Highlight highlight_points(std::span<const Point> corners, const glm::dvec3& origin) {
  Highlight marks;
  const auto place = [&](const Point& p) { return glm::vec3(to_glm(p) - origin); };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    marks.lines.push_back({place(corners[i]), place(corners[i]), kSupportingEdgeColour, 12});
    for (std::size_t k = 0; k < i; ++k) {
      marks.lines.push_back({place(corners[k]), place(corners[i]), kSupportingEdgeColour, kWide});
    }
  }
  return marks;
}

std::vector<NamedVertex> names_of(const TetMesh& mesh, const Selection& selection) {
  std::vector<NamedVertex> names;
  if (const auto* t = std::get_if<TetHandle>(&selection)) {
    for (const VertexHandle v : mesh.vertices(*t)) names.push_back({v, {}});
  } else if (const auto* e = std::get_if<TetEdge>(&selection)) {
    const auto ends = mesh.vertices(*e);
    names = {{ends[0], "a"}, {ends[1], "b"}};
    Shell found;
    if (find_shell(mesh, *e, found, Territory()) == ShellKind::closed) {
      for (unsigned i = 0; i < found.degree; ++i) {
        names.push_back({found.ring[i], fmt::format("p{}", i + 1)});
      }
      return names;
    }
    for (const TetHandle around : ring(mesh, *e).tets) {
      for (const VertexHandle v : mesh.vertices(around)) {
        const auto same = [&](const NamedVertex& name) { return name.vertex == v; };
        if (std::none_of(names.begin(), names.end(), same)) names.push_back({v, {}});
      }
    }
  } else if (const auto* f = std::get_if<HalfFace>(&selection)) {
    for (const VertexHandle v : mesh.vertices(*f)) names.push_back({v, {}});
  } else if (const auto* v = std::get_if<VertexHandle>(&selection)) {
    names.push_back({*v, "v"});
    if (!mesh.tet_of(*v).is_valid()) return names;
    for (const VertexHandle w : one_ring(mesh, *v)) names.push_back({w, {}});
  }
  return names;
}

std::vector<Row> describe(const TetMesh& mesh, const Selection& selection) {
  Teller teller(mesh);
  std::visit([&](const auto& what) { teller.tell(what); }, selection);
  return teller.take();
}

}  // namespace tetmend::viewer
