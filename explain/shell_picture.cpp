// SPDX-License-Identifier: MIT
#include "explain/shell_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetmend::explain {

namespace {

constexpr Quality kWorstOfNone = std::numeric_limits<Quality>::infinity();

double quality(const SlotMesh& mesh, const TetVertices& tet) {
  return standard_of_drawings(mesh).quality(mesh.point(tet[0]), mesh.point(tet[1]),
                                            mesh.point(tet[2]), mesh.point(tet[3]));
}

Quality to_quality(double value) {
  return static_cast<Quality>(value);
}

double over_triangle(const SlotMesh& mesh, const ShellPicture& s, std::size_t i, std::size_t k,
                     std::size_t j) {
  const VertexHandle p = s.ring[i];
  const VertexHandle q = s.ring[k];
  const VertexHandle r = s.ring[j];
  return std::min(quality(mesh, {s.a, p, q, r}), quality(mesh, {p, q, r, s.b}));
}

void add_triangle(const SlotMesh& mesh, const ShellPicture& s, unsigned i, unsigned k, unsigned j,
                  FlatCovering& covering) {
  const Quality worst = to_quality(over_triangle(mesh, s, i, k, j));
  covering.triangles.push_back({{i, k, j}, worst});
  covering.worst = std::min(covering.worst, worst);
}

/// What the search of the operators finds in the polygon. Its floor is 0, so that pockets that are
/// no better than the old tets are seen as well: those that are better are the same for any floor.
void search_pockets(const SlotMesh& mesh, std::span<const Quality> old_sides, ShellPicture& s) {
  const auto m = static_cast<unsigned>(s.ring.size());
  if (m > kMaxSearchRing) return;
  std::vector<Point> ring;
  for (const VertexHandle v : s.ring) ring.push_back(mesh.point(v));
  CoveringProblem problem;
  problem.standard = standard_of_drawings(mesh);
  problem.a = mesh.point(s.a);
  problem.b = mesh.point(s.b);
  problem.ring = ring;
  problem.old_sides = old_sides;
  problem.locked_vertices = s.locks.vertices;
  problem.locked_edges = s.locks.edges;
  problem.allow_core = false;
  const auto search = std::make_unique<CoveringSearch>();
  Covering full;
  if (search->run(problem, full)) {
    s.full.worst = kWorstOfNone;
    for (const auto& [i, k, j] : std::span(full.triangles).first(full.triangle_count)) {
      add_triangle(mesh, s, i, k, j, s.full);
    }
  }
  search->explore(problem);
  s.pockets.assign(std::size_t{m} * m, {});
  for (unsigned i = 0; i < m; ++i) {
    for (unsigned d = 2; d + 1 < m; ++d) {
      const auto pocket = search->pocket(i, d);
      if (pocket) s.pockets[i * m + (i + d) % m] = *pocket;
    }
  }
}

unsigned place_in(const std::vector<VertexHandle>& ring, VertexHandle v) {
  return static_cast<unsigned>(std::find(ring.begin(), ring.end(), v) - ring.begin());
}

}  // namespace

Eigen::Vector2d ShellPicture::place(std::size_t i) const {
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) /
                       static_cast<double>(std::max<std::size_t>(ring.size(), 1));
  return {-std::sin(angle), std::cos(angle)};
}

std::vector<Chord> chords_of(const ShellPicture& picture) {
  std::vector<Chord> chords;
  if (picture.pockets.empty()) return chords;
  const auto m = static_cast<unsigned>(picture.ring.size());
  for (unsigned i = 0; i < m; ++i) {
    for (unsigned j = i + 2; j < m; ++j) {
      if (i == 0 && j + 1 == m) continue;  // a side
      const Chord chord{i, j, picture.pocket(i, j), picture.pocket(j, i)};
      if (chord.best()[0] > 0) chords.push_back(chord);
    }
  }
  std::stable_sort(chords.begin(), chords.end(),
                   [](const Chord& x, const Chord& y) { return x.best() > y.best(); });
  return chords;
}

std::string locks_text(const ShellPicture& picture) {
  const std::size_t m = picture.ring.size();
  std::vector<std::string> locked;
  for (std::size_t i = 0; i < m; ++i) {
    const auto here = picture.ring[i].index();
    if (((picture.locks.vertices >> i) & 1u) != 0)
      locked.push_back(fmt::format("chords at {}", here));
    if (((picture.locks.edges >> i) & 1u) != 0) {
      locked.push_back(
          fmt::format("pockets at the side {} {}", here, picture.ring[(i + 1) % m].index()));
    }
  }
  if (locked.empty()) return {};
  return fmt::format("Locked, as a caller is to remove an edge there: {}.",
                     fmt::join(locked, ", "));
}

FlatCovering covering_of(const SlotMesh& mesh, const ShellPicture& picture,
                         std::span<const TetVertices> tets) {
  FlatCovering covering;
  covering.worst = kWorstOfNone;
  std::vector<NamedTet> core;
  const auto m = static_cast<unsigned>(picture.ring.size());
  for (const TetVertices& tet : tets) {
    const bool known = std::all_of(tet.begin(), tet.end(), [&](VertexHandle v) {
      return v == picture.a || v == picture.b || place_in(picture.ring, v) < m;
    });
    if (!known) return {};
    if (contains(tet, picture.a) && contains(tet, picture.b)) {
      core.push_back({TetHandle(), tet});
    } else if (contains(tet, picture.a)) {
      const auto [p, q, r] = others(tet, picture.a);
      add_triangle(mesh, picture, place_in(picture.ring, p), place_in(picture.ring, q),
                   place_in(picture.ring, r), covering);
    }
  }
  const SlotShell cycle = order_shell(core, picture.a, picture.b);
  for (std::size_t i = 0; i < cycle.tets.size(); ++i) {
    const VertexHandle p = cycle.ring[i];
    const VertexHandle q = cycle.ring[(i + 1) % cycle.ring.size()];
    const Quality worst = to_quality(quality(mesh, {picture.a, picture.b, p, q}));
    covering.core.push_back({place_in(picture.ring, p), place_in(picture.ring, q), worst});
    covering.worst = std::min(covering.worst, worst);
  }
  if (covering.core.empty() && covering.triangles.empty()) covering.worst = 0;
  return covering;
}

ShellPicture picture_of_shell(const SlotMesh& mesh, const SlotShell& shell,
                              std::span<const std::array<VertexHandle, 2>> ancestors) {
  ShellPicture s;
  s.a = shell.a;
  s.b = shell.b;
  s.ring = shell.ring;
  std::vector<TetVertices> tets;
  std::vector<Quality> sides;
  for (const TetHandle t : shell.tets) {
    tets.push_back(mesh.vertices(t));
    sides.push_back(to_quality(quality(mesh, mesh.vertices(t))));
  }
  s.before = covering_of(mesh, s, tets);
  s.floor = s.before.worst;
  s.locks = lock_ancestors(s.a, s.b, s.ring, ancestors);
  search_pockets(mesh, sides, s);
  s.tables = fill_tables(mesh, s.a, s.b, s.ring, s.locks);
  return s;
}

ShellPicture picture_of_sandwich(const SlotMesh& mesh, VertexHandle a, VertexHandle b,
                                 std::span<const std::array<VertexHandle, 3>> triangles) {
  ShellPicture s;
  s.a = a;
  s.b = b;
  s.ring = circle_around(triangles);
  if (s.ring.size() < 3) return s;
  s.before.worst = kWorstOfNone;
  for (const auto& [p, q, r] : triangles) {
    add_triangle(mesh, s, place_in(s.ring, p), place_in(s.ring, q), place_in(s.ring, r), s.before);
  }
  s.floor = s.before.worst;
  search_pockets(mesh, {}, s);
  s.tables = fill_tables(mesh, s.a, s.b, s.ring, s.locks);
  return s;
}

}  // namespace tetmend::explain
