// SPDX-License-Identifier: MIT
#include "explain/slot_shell.h"

#include <algorithm>
#include <map>

namespace tetmend::explain {

namespace {

/// Goes from vertex to vertex as long as there is a next one.
std::vector<VertexHandle> follow_chain(std::map<VertexHandle, VertexHandle> next,
                                       VertexHandle start) {
  std::vector<VertexHandle> chain = {start};
  for (auto step = next.find(start); step != next.end(); step = next.find(chain.back())) {
    const VertexHandle to = step->second;
    next.erase(step);
    if (to == start) break;
    chain.push_back(to);
  }
  return chain;
}

}  // namespace

std::array<VertexHandle, 2> others(const TetVertices& tet, VertexHandle a, VertexHandle b) {
  unsigned i = 0;
  unsigned j = 0;
  while (tet[i] != a) ++i;
  while (tet[j] != b) ++j;
  // Of edge e = ij and the opposite one: (i, j, k, l) is an even order for these (k, l).
  constexpr std::array<std::array<std::uint8_t, 2>, 6> kOpposite = {
      {{2, 3}, {3, 1}, {1, 2}, {0, 3}, {2, 0}, {0, 1}}};
  const auto& [k, l] = kOpposite[kEdgeOf[i][j]];
  if (i < j) return {tet[k], tet[l]};
  return {tet[l], tet[k]};
}

std::array<VertexHandle, 3> others(const TetVertices& tet, VertexHandle a) {
  unsigned i = 0;
  while (tet[i] != a) ++i;
  const auto& face = kFaceVertices[i];
  return {tet[face[0]], tet[face[1]], tet[face[2]]};
}

std::vector<TetHandle> tets_around(const SlotMesh& mesh, std::span<const VertexHandle> vertices) {
  std::vector<TetHandle> found;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& tet = mesh.vertices(t);
    if (std::all_of(vertices.begin(), vertices.end(),
                    [&](VertexHandle v) { return contains(tet, v); })) {
      found.push_back(t);
    }
  }
  return found;
}

SlotShell order_shell(std::span<const NamedTet> tets, VertexHandle a, VertexHandle b) {
  SlotShell shell{a, b, {}, {}, false};
  std::map<VertexHandle, VertexHandle> next;
  std::map<VertexHandle, TetHandle> tet_after;
  std::map<VertexHandle, unsigned> arrivals;
  for (const NamedTet& tet : tets) {
    if (!contains(tet.vertices, a) || !contains(tet.vertices, b)) continue;
    const auto [p, q] = others(tet.vertices, a, b);
    next[p] = q;
    tet_after[p] = tet.tet;
    ++arrivals[q];
  }
  if (next.empty()) return shell;
  const auto start = std::find_if(next.begin(), next.end(),
                                  [&](const auto& step) { return !arrivals.contains(step.first); });
  shell.closed = start == next.end();
  shell.ring = follow_chain(next, shell.closed ? next.begin()->first : start->first);
  for (const VertexHandle p : shell.ring) {
    if (const auto tet = tet_after.find(p); tet != tet_after.end()) {
      shell.tets.push_back(tet->second);
    }
  }
  return shell;
}

SlotShell shell_of(const SlotMesh& mesh, std::span<const TetHandle> tets, VertexHandle a,
                   VertexHandle b) {
  std::vector<NamedTet> named;
  for (const TetHandle t : tets) named.push_back({t, mesh.vertices(t)});
  return order_shell(named, a, b);
}

SlotShell find_slot_shell(const SlotMesh& mesh, VertexHandle a, VertexHandle b) {
  return shell_of(mesh, tets_around(mesh, std::array{a, b}), a, b);
}

std::vector<VertexHandle> circle_around(std::span<const std::array<VertexHandle, 3>> triangles) {
  std::map<VertexHandle, VertexHandle> next;
  const auto has_side = [&](VertexHandle from, VertexHandle to) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
      return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) ||
             (t[2] == from && t[0] == to);
    });
  };
  std::size_t sides = 0;
  for (const auto& t : triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexHandle from = t[i];
      const VertexHandle to = t[(i + 1) % 3];
      if (has_side(to, from)) continue;
      next[from] = to;
      ++sides;
    }
  }
  if (next.empty()) return {};
  std::vector<VertexHandle> circle = follow_chain(next, next.begin()->first);
  return circle.size() == sides ? circle : std::vector<VertexHandle>();
}

}  // namespace tetmend::explain
