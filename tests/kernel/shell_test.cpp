// SPDX-License-Identifier: MIT
// Shells of edges: closed, open, constrained, too large.
#include "kernel/shell.h"

#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using ShellEdge = std::pair<VertexHandle, VertexHandle>;

/// All edges of the mesh with the tets around each.
std::map<ShellEdge, std::set<TetHandle>> shells_of(const TetMesh& mesh) {
  std::map<ShellEdge, std::set<TetHandle>> shells;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned e = 0; e < 6; ++e) {
      const auto [a, b] = mesh.vertices(TetEdge(t, e));
      shells[std::minmax(a, b)].insert(t);
    }
  }
  return shells;
}

TetEdge edge_between(const TetMesh& mesh, VertexHandle a, VertexHandle b) {
  for (const TetHandle t : live_tets(mesh)) {
    if (const auto edge = edge_in(mesh, t, a, b)) return *edge;
  }
  FAIL("no such edge");
  return {};
}

}  // namespace

TEST_CASE("a closed shell is found from each of its tets, its ring in positive sense") {
  for (unsigned m = 3; m <= 12; ++m) {
    CAPTURE(m);
    const TetMesh mesh = make_mesh(shell_mesh({.degree = m}));
    for (const TetHandle start : live_tets(mesh)) {
      Shell shell;
      const auto edge = edge_in(mesh, start, VertexHandle(0), VertexHandle(1));
      REQUIRE(edge);
      REQUIRE(find_shell(mesh, *edge, shell, Territory()) == ShellKind::closed);
      CHECK(shell.degree == m);
      CHECK(shell.tets[0] == start);
      std::set<VertexHandle> ring;
      std::set<TetHandle> tets;
      for (unsigned i = 0; i < m; ++i) {
        CHECK(mesh.is_certified_positive({shell.a, shell.b, shell.ring[i], shell.next(i)}));
        CHECK(shell.previous(i + 1 == m ? 0 : i + 1) == shell.ring[i]);
        for (const VertexHandle v : {shell.a, shell.b, shell.ring[i], shell.next(i)}) {
          CHECK(mesh.local_index(shell.tets[i], v) != 4);
        }
        ring.insert(shell.ring[i]);
        tets.insert(shell.tets[i]);
      }
      CHECK(ring.size() == m);
      CHECK(tets.size() == m);
    }
  }
}

TEST_CASE("find_shell tells closed from boundary on every edge of a mesh") {
  for (const char* name : {"ball_60", "cube_2", "open_shell_7", "touching_at_edge"}) {
    CAPTURE(name);
    const TetMesh mesh = make_mesh(zoo_data(name));
    std::set<ShellEdge> boundary;
    for (const SurfaceTriangle& triangle : mesh.surface_triangles()) {
      for (unsigned i = 0; i < 3; ++i) {
        boundary.insert(std::minmax(triangle.vertices[i], triangle.vertices[(i + 1) % 3]));
      }
    }
    for (const auto& [edge, tets] : shells_of(mesh)) {
      for (const TetHandle t : tets) {
        Shell shell;
        const ShellKind kind =
            find_shell(mesh, *edge_in(mesh, t, edge.first, edge.second), shell, Territory());
        REQUIRE(kind == (boundary.contains(edge) ? ShellKind::boundary : ShellKind::closed));
        if (kind != ShellKind::closed) continue;
        CHECK(std::set<TetHandle>(shell.tets.begin(), shell.tets.begin() + shell.degree) == tets);
        for (unsigned i = 0; i < shell.degree; ++i) {
          CHECK(mesh.is_certified_positive({shell.a, shell.b, shell.ring[i], shell.next(i)}));
        }
      }
    }
  }
}

TEST_CASE("a ring meets each tet once, from whichever tet it starts") {
  for (const char* name : {"ball_60", "cube_2", "open_shell_7", "two_regions", "one_tet", "shell_3",
                           "shell_with_constrained_edge", "inverted_tet"}) {
    CAPTURE(name);
    const TetMesh mesh = make_mesh(zoo_data(name));
    for (const auto& [edge, tets] : shells_of(mesh)) {
      for (const TetHandle start : tets) {
        std::vector<TetHandle> met;
        const Ring around = ring(mesh, *edge_in(mesh, start, edge.first, edge.second));
        CHECK(ShellEdge(std::minmax(around.a, around.b)) == edge);
        for (const TetHandle t : around.tets) {
          REQUIRE(edge_in(mesh, t, edge.first, edge.second));
          met.push_back(t);
          REQUIRE(met.size() <= tets.size());
        }
        CHECK(std::set<TetHandle>(met.begin(), met.end()) == tets);
        CHECK(met.size() == tets.size());
      }
    }
  }
}

TEST_CASE("a shell with a constrained edge or face is constrained from wherever it is looked at") {
  for (const MeshData& data : {shell_with_constrained_edge(), shell_with_constrained_face()}) {
    const TetMesh mesh = make_mesh(data);
    for (const TetHandle t : live_tets(mesh)) {
      Shell shell;
      const auto edge = edge_in(mesh, t, VertexHandle(0), VertexHandle(1));
      CHECK(find_shell(mesh, *edge, shell, Territory()) == ShellKind::constrained);
    }
  }
}

TEST_CASE("a shell of the largest degree is closed and one more is too large") {
  Shell shell;
  const TetMesh largest = make_mesh(shell_mesh({.degree = kMaxDegree}));
  CHECK(find_shell(largest, edge_between(largest, VertexHandle(0), VertexHandle(1)), shell,
                   Territory()) == ShellKind::closed);
  CHECK(shell.degree == kMaxDegree);
  const TetMesh larger = make_mesh(shell_mesh({.degree = kMaxDegree + 1}));
  CHECK(find_shell(larger, edge_between(larger, VertexHandle(0), VertexHandle(1)), shell,
                   Territory()) == ShellKind::too_large);
}

TEST_CASE("find_edge answers the same with a good, a useless, a deleted and no hint") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  Workspace workspace(mesh);
  // A 3-2 flip leaves a deleted slot.
  TetHandle deleted;
  for (const auto& [edge, tets] : shells_of(mesh)) {
    Shell shell;
    if (find_shell(mesh, *edge_in(mesh, *tets.begin(), edge.first, edge.second), shell,
                   Territory()) != ShellKind::closed ||
        shell.degree != 3) {
      continue;
    }
    const auto& p = shell.ring;
    Transaction tx(mesh, workspace);
    const std::array<TetVertices, 2> created = {
        {{p[0], p[1], p[2], shell.b}, {p[0], p[2], p[1], shell.a}}};
    if (tx.replace_cavity({shell.tets.data(), 3}, created) != EditResult::made) continue;
    deleted = shell.tets[2];
    tx.keep();
    break;
  }
  REQUIRE(deleted.is_valid());
  REQUIRE(mesh.is_deleted(deleted));

  const auto shells = shells_of(mesh);
  Random random(3);
  for (const VertexHandle a : live_vertices(mesh)) {
    for (const VertexHandle b : live_vertices(mesh)) {
      const auto known = shells.find(std::minmax(a, b));
      const bool exists = known != shells.end();
      const auto tets = live_tets(mesh);
      std::vector<TetHandle> hints = {TetHandle(), deleted, TetHandle(1u << 28),
                                      tets[random.index(tets.size())]};
      if (exists) hints.push_back(*known->second.begin());
      for (const TetHandle hint : hints) {
        const auto edge = find_edge(mesh, a, b, workspace, hint);
        REQUIRE(edge.has_value() == exists);
        if (!edge) continue;
        const auto [c, d] = mesh.vertices(*edge);
        CHECK(std::minmax(a, b) == std::minmax(c, d));
        CHECK_FALSE(mesh.is_deleted(edge->tet()));
      }
      if (exists) CHECK(find_edge(mesh, a, b, workspace, hints.back())->tet() == hints.back());
    }
  }
}
