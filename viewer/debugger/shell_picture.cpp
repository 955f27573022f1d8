// SPDX-License-Identifier: MIT
#include "viewer/debugger/shell_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tetmend::viewer {

namespace {

constexpr Quality kBest = std::numeric_limits<Quality>::infinity();

double quality(const SlotMesh& mesh, const TetVertices& tet) {
  return minimum_sine(mesh.point(tet[0]), mesh.point(tet[1]), mesh.point(tet[2]),
                      mesh.point(tet[3]));
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

/// [chen, Alg. 1 and 2]: pockets by growing length. Fills s.pockets and s.full.
void fill_pockets(const SlotMesh& mesh, ShellPicture& s) {
  const std::size_t m = s.ring.size();
  s.pockets.assign(m * m, 0);
  std::vector<std::size_t> apex(m * m, m);
  for (std::size_t i = 0; i < m; ++i) {
    s.pockets[i * m + (i + 1) % m] = std::numeric_limits<double>::infinity();
  }
  for (std::size_t d = 2; d < m; ++d) {
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t j = (i + d) % m;
      for (std::size_t step = 1; step < d; ++step) {
        const std::size_t k = (i + step) % m;
        double worst = std::min(s.pocket(i, k), s.pocket(k, j));
        if (worst <= 0) continue;
        worst = std::min(worst, over_triangle(mesh, s, i, k, j));
        if (worst <= s.pocket(i, j)) continue;
        s.pockets[i * m + j] = worst;
        apex[i * m + j] = k;
      }
    }
  }
  s.full.worst = kBest;
  std::vector<std::array<std::size_t, 2>> open = {{0, m - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const std::size_t k = apex[i * m + j];
    if (k == m) continue;  // neighbours, or no triangulation at all
    add_triangle(mesh, s, static_cast<unsigned>(i), static_cast<unsigned>(k),
                 static_cast<unsigned>(j), s.full);
    open.push_back({i, k});
    open.push_back({k, j});
  }
  if (s.full.triangles.empty()) s.full.worst = 0;
}

unsigned place_in(const std::vector<VertexHandle>& ring, VertexHandle v) {
  return static_cast<unsigned>(std::find(ring.begin(), ring.end(), v) - ring.begin());
}

}  // namespace

glm::dvec2 ShellPicture::place(std::size_t i) const {
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) /
                       static_cast<double>(std::max<std::size_t>(ring.size(), 1));
  return {-std::sin(angle), std::cos(angle)};
}

std::vector<Chord> chords_of(const ShellPicture& picture) {
  std::vector<Chord> chords;
  const auto m = static_cast<unsigned>(picture.ring.size());
  for (unsigned i = 0; i < m; ++i) {
    for (unsigned j = i + 2; j < m; ++j) {
      if (i == 0 && j + 1 == m) continue;  // a side
      const Chord chord{i, j, picture.pocket(i, j), picture.pocket(j, i)};
      if (chord.best() > 0) chords.push_back(chord);
    }
  }
  std::stable_sort(chords.begin(), chords.end(),
                   [](const Chord& x, const Chord& y) { return x.best() > y.best(); });
  return chords;
}

FlatCovering covering_of(const SlotMesh& mesh, const ShellPicture& picture,
                         std::span<const TetVertices> tets) {
  FlatCovering covering;
  covering.worst = kBest;
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

ShellPicture picture_of_shell(const SlotMesh& mesh, const SlotShell& shell) {
  ShellPicture s;
  s.a = shell.a;
  s.b = shell.b;
  s.ring = shell.ring;
  std::vector<TetVertices> tets;
  for (const TetHandle t : shell.tets) tets.push_back(mesh.vertices(t));
  s.before = covering_of(mesh, s, tets);
  s.floor = s.before.worst;
  fill_pockets(mesh, s);
  return s;
}

ShellPicture picture_of_sandwich(const SlotMesh& mesh, VertexHandle a, VertexHandle b,
                                 std::span<const std::array<VertexHandle, 3>> triangles) {
  ShellPicture s;
  s.a = a;
  s.b = b;
  s.ring = circle_around(triangles);
  if (s.ring.size() < 3) return s;
  s.before.worst = kBest;
  for (const auto& [p, q, r] : triangles) {
    add_triangle(mesh, s, place_in(s.ring, p), place_in(s.ring, q), place_in(s.ring, r), s.before);
  }
  s.floor = s.before.worst;
  fill_pockets(mesh, s);
  return s;
}

}  // namespace tetmend::viewer
