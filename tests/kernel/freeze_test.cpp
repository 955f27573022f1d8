// SPDX-License-Identifier: MIT
// Frozen tets: nothing removes them or moves their vertices, and every copy and order keeps them.
#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Ring 2 .. 7 around the edge 0 1. Tet i has the ring vertices 2 + i and 3 + i.
TetMesh shell_of_six() {
  return TetMesh(shell_mesh({.degree = 6}));
}

bool is_third(TetHandle t) {
  return t.index() % 3 == 0;
}

/// Corners of the frozen tets.
std::multiset<std::vector<double>> frozen_corners(const TetMesh& mesh) {
  std::multiset<std::vector<double>> all;
  for (const TetHandle t : live_tets(mesh)) {
    if (!mesh.is_frozen(t)) continue;
    std::vector<double> corners;
    for (const VertexHandle v : mesh.vertices(t)) {
      for (int k = 0; k < 3; ++k) corners.push_back(mesh.point(v)[k]);
    }
    all.insert(std::move(corners));
  }
  return all;
}

}  // namespace

TEST_CASE("freezing marks tets and fixes their vertices, until other tets are frozen") {
  TetMesh mesh(zoo_data("ball_60"));
  const TetMesh before = mesh;
  CHECK(mesh.freeze([](TetHandle t) { return t == TetHandle(7); }) == 1);
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(!(mesh == before));
  for (const TetHandle t : live_tets(mesh)) {
    CHECK(mesh.is_frozen(t) == (t == TetHandle(7)));
    if (t == TetHandle(7)) CHECK(mesh.has_constraints(t));
  }
  for (const VertexHandle v : live_vertices(mesh)) {
    const bool frozen = mesh.local_index(TetHandle(7), v) < 4;
    CHECK(mesh.is_frozen(v) == frozen);
    CHECK(mesh.is_fixed(v) == (frozen || before.is_fixed(v)));
  }
  CHECK(mesh.freeze([](TetHandle t) { return t == TetHandle(8); }) == 1);
  CHECK(!mesh.is_frozen(TetHandle(7)));
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(mesh.freeze([](TetHandle) { return false; }) == 0);
  CHECK(mesh == before);
}

TEST_CASE("a frozen tet is never removed") {
  TetMesh mesh(shell_mesh({.degree = 3}));
  const VertexHandle a(0), b(1), p(2), q(3), r(4);
  const std::vector<TetVertices> two = {{p, q, r, b}, {p, r, q, a}};
  mesh.freeze([](TetHandle t) { return t == TetHandle(2); });
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  CHECK(tx.replace_cavity(live_tets(mesh), two) == EditResult::constrained);
  CHECK(mesh == before);
}

TEST_CASE("what lies beside a frozen tet may be replaced, and undo brings all back") {
  TetMesh mesh = shell_of_six();
  mesh.freeze([](TetHandle t) { return t == TetHandle(2); });
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  {
    Transaction tx(mesh, workspace);
    const TetVertices tv = mesh.vertices(TetHandle(3));
    Point centre = Point::Zero();
    for (const VertexHandle v : tv) centre += 0.25 * mesh.point(v);
    const VertexHandle m = tx.add_vertex(centre);
    std::vector<TetVertices> four(4, tv);
    for (unsigned i = 0; i < 4; ++i) four[i][i] = m;
    const std::vector<TetHandle> old = {TetHandle(3)};
    REQUIRE(tx.replace_cavity(old, four) == EditResult::made);
    CHECK(to_string(check_integrity(mesh)) == "");
    for (const TetHandle t : live_tets(mesh)) CHECK(mesh.is_frozen(t) == (t == TetHandle(2)));
    CHECK(!mesh.is_frozen(m));
  }
  CHECK(mesh == before);
}

TEST_CASE("a vertex of a frozen tet does not move") {
  TetMesh mesh(zoo_data("ball_200"));
  const TetMesh thawed = mesh;
  mesh.freeze(is_third);
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  std::size_t held = 0;
  for (const VertexHandle v : live_vertices(mesh)) {
    if (thawed.is_fixed(v) || !mesh.is_frozen(v)) continue;
    const Point tiny = mesh.point(v) + Point(1e-9, 0, 0);
    CHECK(tx.move_vertex(v, tiny, link(mesh, v)) == EditResult::constrained);
    ++held;
  }
  CHECK(held > 10);
}

TEST_CASE("a shell with a frozen tet is constrained from wherever it is looked at") {
  TetMesh mesh = shell_of_six();
  Shell shell;
  REQUIRE(find_shell(mesh, *edge_in(mesh, TetHandle(0), VertexHandle(0), VertexHandle(1)), shell,
                     Territory()) == ShellKind::closed);
  mesh.freeze([](TetHandle t) { return t == TetHandle(4); });
  for (const TetHandle t : live_tets(mesh)) {
    const auto edge = edge_in(mesh, t, VertexHandle(0), VertexHandle(1));
    REQUIRE(edge);
    CHECK(find_shell(mesh, *edge, shell, Territory()) == ShellKind::constrained);
  }
}

TEST_CASE("a face of a frozen tet is not free, seen from either side") {
  TetMesh mesh = shell_of_six();
  mesh.freeze([](TetHandle t) { return t == TetHandle(4); });
  std::size_t held = 0;
  std::size_t free = 0;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (mesh.is_boundary(face)) {
        CHECK(!mesh.is_free(face));
        continue;
      }
      const bool beside = mesh.is_frozen(t) || mesh.is_frozen(mesh.twin(face).tet());
      CHECK(mesh.is_free(face) == !beside);
      ++(beside ? held : free);
    }
  }
  CHECK(held == 4);
  CHECK(free == 8);
}

TEST_CASE("garbage collection and sorting keep frozen tets") {
  TetMesh mesh(zoo_data("ball_200"));
  CHECK(mesh.freeze(is_third) == (mesh.tet_count() + 2) / 3);
  const auto before = frozen_corners(mesh);
  REQUIRE(before.size() == (mesh.tet_count() + 2) / 3);
  Workspace workspace(mesh);
  workspace.provide(mesh, 10, 10);
  mesh.sort_spatially();
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(frozen_corners(mesh) == before);
  mesh.collect_garbage();
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(frozen_corners(mesh) == before);
}
