// SPDX-License-Identifier: MIT
// Edits that change the surface: what the guard is asked, what is marked afterwards, and the way
// back.
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "envelope/envelope.h"
#include "kernel/integrity.h"
#include "kernel/star.h"
#include "kernel/surface_shell.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/mesh_parts.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

TetMesh free_mesh(const MeshData& data) {
  TetMesh mesh(data);
  mesh.set_surface_guard(Envelope::of(mesh, {}));
  return mesh;
}

struct SurfaceCavity {
  std::vector<TetHandle> old;
  std::vector<TetVertices> created;
  std::vector<Label> labels;

  EditResult make(Transaction& transaction) const {
    return transaction.replace_at_surface(old, created, labels);
  }
};

/// The first edge, in the order of the tets, with a shell on the surface that is wanted.
std::optional<SurfaceShell> find_shell(const TetMesh& mesh,
                                       const std::function<bool(const SurfaceShell&)>& wanted) {
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned e = 0; e < 6; ++e) {
      SurfaceShell shell;
      const ShellKind kind = find_surface_shell(mesh, TetEdge(t, e), shell, Territory());
      if (kind == ShellKind::closed && wanted(shell)) return shell;
    }
  }
  return std::nullopt;
}

/// Of two tets on each side of it.
bool is_flat_diagonal(const TetMesh& mesh, const SurfaceShell& shell, unsigned sides) {
  if (shell.side_count != sides || mesh.surface_guard()->is_feature(shell.a, shell.b)) return false;
  for (unsigned s = 0; s < sides; ++s) {
    if (shell.sides[s].count != 2) return false;
  }
  return true;
}

SurfaceCavity flip_cavity(const TetMesh& mesh, const SurfaceShell& shell) {
  SurfaceCavity cavity;
  for (unsigned s = 0; s < shell.side_count; ++s) {
    const ShellSide& side = shell.sides[s];
    const auto& p = side.ring;
    cavity.old.insert(cavity.old.end(), {side.tets[0], side.tets[1]});
    cavity.created.push_back({shell.a, p[0], p[1], p[2]});
    cavity.created.push_back({p[0], p[1], p[2], shell.b});
    cavity.labels.insert(cavity.labels.end(), 2, mesh.label(side.tets[0]));
  }
  return cavity;
}

SurfaceCavity split_cavity(const TetMesh& mesh, const SurfaceShell& shell, VertexHandle m) {
  SurfaceCavity cavity;
  for (unsigned s = 0; s < shell.side_count; ++s) {
    const ShellSide& side = shell.sides[s];
    for (unsigned i = 0; i < side.count; ++i) {
      cavity.old.push_back(side.tets[i]);
      cavity.created.push_back({shell.a, m, side.ring[i], side.ring[i + 1]});
      cavity.created.push_back({m, shell.b, side.ring[i], side.ring[i + 1]});
      cavity.labels.insert(cavity.labels.end(), 2, mesh.label(side.tets[i]));
    }
  }
  return cavity;
}

SurfaceCavity contraction(const TetMesh& mesh, VertexHandle v, VertexHandle w) {
  SurfaceCavity cavity;
  for (const HalfFace f : link(mesh, v)) {
    cavity.old.push_back(f.tet());
    const auto [a, b, c] = mesh.vertices(f);
    if (a == w || b == w || c == w) continue;
    cavity.created.push_back({w, a, b, c});
    cavity.labels.push_back(mesh.label(f.tet()));
  }
  return cavity;
}

void check_sound(TetMesh mesh) {
  mesh.renew_surface();
  const auto findings = check_integrity(mesh);
  CHECK_MESSAGE(findings.empty(), to_string(findings));
  const TetMesh rebuilt(mesh.to_data());
  CHECK(rebuilt.tet_count() == mesh.tet_count());
  CHECK(rebuilt.surface_triangles().size() == mesh.surface_triangles().size());
}

EditResult move(Transaction& transaction, VertexHandle v, const Point& to, Workspace& workspace) {
  std::vector<HalfFace> around;
  REQUIRE(find_star(transaction.mesh(), v, workspace, around) == StarKind::whole);
  const VertexMove move = {v, to, around};
  return transaction.move_at_surface({&move, 1});
}

}  // namespace

TEST_CASE("a diagonal of a plane side is flipped, and flipped back bit for bit") {
  TetMesh mesh = free_mesh(kuhn_cube(2, 0, 1));
  const TetMesh start = mesh;
  Workspace workspace(mesh);
  const auto shell = find_shell(mesh, [&](const auto& s) { return is_flat_diagonal(mesh, s, 1); });
  REQUIRE(shell);
  {
    Transaction transaction(mesh, workspace);
    REQUIRE(flip_cavity(mesh, *shell).make(transaction) == EditResult::made);
    CHECK_FALSE(mesh == start);
  }
  CHECK(mesh == start);
  {
    Transaction outer(mesh, workspace);
    {
      Transaction inner(mesh, workspace);
      REQUIRE(flip_cavity(mesh, *shell).make(inner) == EditResult::made);
      inner.keep();
    }
    outer.undo();
    CHECK(mesh == start);
    REQUIRE(flip_cavity(mesh, *shell).make(outer) == EditResult::made);
    outer.keep();
  }
  check_sound(mesh);
  CHECK(mesh.tet_count() == start.tet_count());
}

TEST_CASE("without a guard, or where an edge is a feature, the surface stays") {
  TetMesh fixed{kuhn_cube(2, 0, 1)};
  TetMesh free = free_mesh(kuhn_cube(2, 0, 1));
  const auto shell = find_shell(free, [&](const auto& s) { return is_flat_diagonal(free, s, 1); });
  REQUIRE(shell);
  {
    Workspace workspace(fixed);
    const TetMesh before = fixed;
    Transaction transaction(fixed, workspace);
    CHECK(flip_cavity(fixed, *shell).make(transaction) == EditResult::constrained);
    CHECK(move(transaction, vertex_at(fixed, {0.5, 0.5, 0}), {0.5, 0.6, 0}, workspace) ==
          EditResult::constrained);
    CHECK(fixed == before);
  }
  Workspace workspace(free);
  const TetMesh before = free;
  const auto edge = find_shell(free, [&](const auto& s) {
    return s.sides[0].count == 2 && free.surface_guard()->is_feature(s.a, s.b);
  });
  REQUIRE(edge);
  Transaction transaction(free, workspace);
  CHECK(flip_cavity(free, *edge).make(transaction) != EditResult::made);
  CHECK(free == before);
}

TEST_CASE("vertices move in planes and along straight edges, and nowhere else") {
  TetMesh mesh = free_mesh(kuhn_cube(2, 0, 1));
  const TetMesh start = mesh;
  Workspace workspace(mesh);
  const VertexHandle side = vertex_at(mesh, {0.5, 0.5, 0});
  const VertexHandle ridge = vertex_at(mesh, {0.5, 0, 0});
  const VertexHandle corner = vertex_at(mesh, {0, 0, 0});
  {
    Transaction transaction(mesh, workspace);
    CHECK(move(transaction, side, {0.5, 0.5, 0.01}, workspace) == EditResult::constrained);
    CHECK(move(transaction, ridge, {0.5, 0.1, 0}, workspace) == EditResult::constrained);
    CHECK(move(transaction, corner, {0.01, 0, 0}, workspace) == EditResult::constrained);
    CHECK(mesh == start);
    CHECK(move(transaction, side, {0.55, 0.4, 0}, workspace) == EditResult::made);
    CHECK(move(transaction, ridge, {0.6, 0, 0}, workspace) == EditResult::made);
    CHECK(move(transaction, side, {1.5, 0.5, 0}, workspace) == EditResult::inverted);
  }
  CHECK(mesh == start);
  mesh.freeze([&](TetHandle t) { return mesh.local_index(t, side) < 4; });
  Transaction transaction(mesh, workspace);
  CHECK(move(transaction, side, {0.55, 0.4, 0}, workspace) == EditResult::constrained);
}

TEST_CASE("new vertices of the surface are fixed for other operators, and can vanish again") {
  TetMesh mesh = free_mesh(kuhn_cube(2, 0, 1));
  const TetMesh start = mesh;
  Workspace workspace(mesh);
  const auto shell = find_shell(mesh, [&](const auto& s) { return is_flat_diagonal(mesh, s, 1); });
  REQUIRE(shell);
  VertexHandle m;
  {
    Transaction transaction(mesh, workspace);
    m = transaction.add_vertex(0.5 * (mesh.point(shell->a) + mesh.point(shell->b)));
    REQUIRE(split_cavity(mesh, *shell, m).make(transaction) == EditResult::made);
    CHECK(mesh.is_boundary(m));
    transaction.undo();
    CHECK(mesh == start);
    m = transaction.add_vertex(0.5 * (mesh.point(shell->a) + mesh.point(shell->b)));
    REQUIRE(split_cavity(mesh, *shell, m).make(transaction) == EditResult::made);
    transaction.keep();
  }
  CHECK(mesh.surface_guard()->place(m) == SurfacePlace::smooth);
  check_sound(mesh);
  const TetMesh split_mesh = mesh;
  Transaction transaction(mesh, workspace);
  const SurfaceCavity cavity = contraction(mesh, m, shell->a);
  CHECK(transaction.replace_cavity(cavity.old, cavity.created) == EditResult::constrained);
  CHECK(mesh == split_mesh);
  REQUIRE(cavity.make(transaction) == EditResult::made);
  CHECK(mesh.is_deleted(m));
  transaction.keep();
  check_sound(mesh);
}

TEST_CASE("a wall between two regions is flipped from both sides at once") {
  TetMesh mesh = free_mesh(two_regions());
  const TetMesh start = mesh;
  Workspace workspace(mesh);
  const auto shell = find_shell(mesh, [&](const auto& s) { return is_flat_diagonal(mesh, s, 2); });
  REQUIRE(shell);
  Transaction transaction(mesh, workspace);
  SurfaceCavity cavity = flip_cavity(mesh, *shell);
  std::vector<Label> wrong = cavity.labels;
  std::reverse(wrong.begin(), wrong.end());
  CHECK(transaction.replace_at_surface(cavity.old, cavity.created, wrong) != EditResult::made);
  CHECK(mesh == start);
  REQUIRE(cavity.make(transaction) == EditResult::made);
  transaction.undo();
  CHECK(mesh == start);
  REQUIRE(cavity.make(transaction) == EditResult::made);
  transaction.keep();
  check_sound(mesh);
}

TEST_CASE("labels of triangles and named edges follow the surface") {
  MeshData data = kuhn_cube(2, 0, 1);
  {
    const TetMesh plain(data);
    for (const SurfaceTriangle& triangle : plain.surface_triangles()) {
      const auto& v = triangle.vertices;
      double z = 0;
      for (const VertexHandle w : v) z += plain.point(w).z();
      data.triangles.push_back({{v[0].index(), v[1].index(), v[2].index()}, z == 0 ? 7 : 8});
    }
    const auto number = [&](const Point& p) { return vertex_at(plain, p).index(); };
    data.edges = {{{number({0, 0, 0}), number({0.5, 0, 0})}, 3},
                  {{number({0.5, 0, 0}), number({1, 0, 0})}, 3}};
  }
  TetMesh mesh = free_mesh(data);
  Workspace workspace(mesh);
  const VertexHandle middle = vertex_at(mesh, {0.5, 0, 0});
  const VertexHandle end = vertex_at(mesh, {1, 0, 0});
  {
    Transaction transaction(mesh, workspace);
    REQUIRE(contraction(mesh, middle, end).make(transaction) == EditResult::made);
    transaction.keep();
  }
  check_sound(mesh);
  mesh.renew_surface();
  const MeshData now = mesh.to_data();
  REQUIRE(now.edges.size() == 1);
  CHECK(now.edges[0].label == 3);
  std::set<Point::Scalar> ends;
  for (const std::uint32_t v : now.edges[0].vertices) ends.insert(now.points[v].x());
  CHECK(ends == std::set<double>{0, 1});
  double area = 0;
  for (const MeshData::Triangle& t : now.triangles) {
    const auto p = [&](std::size_t i) { return now.points[t.vertices[i]]; };
    const bool is_bottom = p(0).z() == 0 && p(1).z() == 0 && p(2).z() == 0;
    CHECK(t.label == (is_bottom ? 7 : 8));
    if (is_bottom) area += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
  }
  CHECK(area == doctest::Approx(1));
  CHECK(mesh.surface_origins().size() == mesh.surface_triangles().size());
}

TEST_CASE("the shell of an edge inside a region, or where walls meet the boundary, is none") {
  const TetMesh mesh{two_regions()};
  std::size_t walls = 0;
  std::size_t outer = 0;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned e = 0; e < 6; ++e) {
      SurfaceShell shell;
      const auto ends = mesh.vertices(TetEdge(t, e));
      const bool on_surface = mesh.is_fixed(ends[0]) && mesh.is_fixed(ends[1]);
      if (find_surface_shell(mesh, TetEdge(t, e), shell, Territory()) != ShellKind::closed)
        continue;
      CHECK(on_surface);
      (shell.side_count == 2 ? walls : outer) += 1;
      for (unsigned s = 0; s < shell.side_count; ++s) {
        const ShellSide& side = shell.sides[s];
        for (unsigned i = 0; i < side.count; ++i) {
          CHECK(mesh.label(side.tets[i]) == mesh.label(side.tets[0]));
          CHECK(mesh.is_certified_positive({shell.a, shell.b, side.ring[i], side.ring[i + 1]}));
          CHECK(mesh.local_index(side.tets[i], side.ring[i]) < 4);
          CHECK(mesh.local_index(side.tets[i], side.ring[i + 1]) < 4);
        }
      }
    }
  }
  CHECK(walls > 0);
  CHECK(outer > 0);
}
