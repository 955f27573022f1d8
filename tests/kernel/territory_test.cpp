// SPDX-License-Identifier: MIT
// A worker in a territory: walks stop at the border, edits take its own slots only.
#include "kernel/territory.h"

#include <algorithm>
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

/// A cube cut in two: block 0 has the vertices with x below a half.
struct Halves {
  TetMesh mesh{kuhn_cube(4, 0.2, 1)};
  std::vector<BlockId> blocks = std::vector<BlockId>(mesh.vertex_slots());

  Halves() {
    for (const VertexHandle v : live_vertices(mesh)) {
      blocks[v.index()] = mesh.point(v).x() < 0.5 ? 0 : 1;
    }
  }
  Territory left() { return {blocks, 0}; }
  bool inside(TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    return std::all_of(v.begin(), v.end(), [&](VertexHandle w) { return left().holds(w); });
  }
};

struct Inside {
  Halves halves;
  Workspace workspace{halves.mesh};
  Workspace::FreeSlots slots;

  explicit Inside(Workspace::FreeSlots given = {}) : slots(std::move(given)) {
    workspace.enter(halves.left(), slots);
  }
};

/// The middle of a shell of three around an inner edge of the territory, if there is one.
bool find_inner_shell(Halves& halves, Shell& shell) {
  for (const TetHandle t : live_tets(halves.mesh)) {
    for (unsigned e = 0; e < 6 && halves.inside(t); ++e) {
      if (find_shell(halves.mesh, TetEdge(t, e), shell, halves.left()) == ShellKind::closed) {
        return true;
      }
    }
  }
  return false;
}

/// Splits the edge of a shell: two tets for each.
std::vector<TetVertices> split_edge_tets(const Shell& shell, VertexHandle v) {
  std::vector<TetVertices> tets;
  for (unsigned i = 0; i < shell.degree; ++i) {
    tets.push_back({shell.a, v, shell.ring[i], shell.next(i)});
    tets.push_back({v, shell.b, shell.ring[i], shell.next(i)});
  }
  return tets;
}

}  // namespace

TEST_CASE("a territory holds the vertices of its block, the whole mesh holds all") {
  Halves halves;
  std::size_t held = 0;
  for (const VertexHandle v : live_vertices(halves.mesh)) {
    CHECK(Territory().holds(v));
    if (halves.left().holds(v)) ++held;
  }
  CHECK(held > 0);
  CHECK(held < halves.mesh.vertex_count());
  CHECK(Territory().is_whole());
  CHECK(!halves.left().is_whole());
}

TEST_CASE("a star is walked to its end or not at all, and the border is noted") {
  Inside in;
  std::size_t complete = 0;
  std::size_t cut = 0;
  for (const VertexHandle v : live_vertices(in.halves.mesh)) {
    if (!in.halves.left().holds(v)) continue;
    Workspace everywhere(in.halves.mesh);
    std::vector<HalfFace> all;
    REQUIRE(collect_link(in.halves.mesh, v, everywhere, all));
    const bool own =
        std::all_of(all.begin(), all.end(), [&](HalfFace f) { return in.halves.inside(f.tet()); });
    std::vector<HalfFace> found;
    in.workspace.forget_border();
    const bool walked = collect_link(in.halves.mesh, v, in.workspace, found);
    CHECK(walked == own);
    CHECK(in.workspace.met_border() == !own);
    if (own) CHECK(found == all);
    for (const HalfFace f : found) CHECK(in.halves.inside(f.tet()));
    ++(own ? complete : cut);
  }
  CHECK(complete > 0);
  CHECK(cut > 0);
}

TEST_CASE("a shell is closed only if all of it lies in the territory") {
  Halves halves;
  std::size_t borders = 0;
  for (const TetHandle t : live_tets(halves.mesh)) {
    if (!halves.inside(t)) continue;
    for (unsigned e = 0; e < 6; ++e) {
      Shell shell;
      if (find_shell(halves.mesh, TetEdge(t, e), shell, Territory()) != ShellKind::closed) continue;
      const bool own = std::all_of(shell.tets.begin(), shell.tets.begin() + shell.degree,
                                   [&](TetHandle s) { return halves.inside(s); });
      Shell found;
      const ShellKind kind = find_shell(halves.mesh, TetEdge(t, e), found, halves.left());
      CHECK(kind == (own ? ShellKind::closed : ShellKind::border));
      if (!own) ++borders;
    }
  }
  CHECK(borders > 0);
}

TEST_CASE("an edge beyond the border is not found, and the border is noted") {
  Inside in;
  for (const TetHandle t : live_tets(in.halves.mesh)) {
    const TetVertices& v = in.halves.mesh.vertices(t);
    if (!in.halves.left().holds(v[0]) || in.halves.left().holds(v[1])) continue;
    in.workspace.forget_border();
    CHECK(!find_edge(in.halves.mesh, v[0], v[1], in.workspace).has_value());
    CHECK(in.workspace.met_border());
  }
}

TEST_CASE("an edit that reaches out of the territory is refused, whatever it is, and noted") {
  Halves halves;
  Workspace workspace(halves.mesh);
  workspace.provide(halves.mesh, 100, 1);  // it is not for want of slots
  halves.blocks.resize(halves.mesh.vertex_slots(), 1);
  Workspace::FreeSlots slots = std::exchange(workspace.free_slots(), {});
  const Workspace everywhere(halves.mesh);
  const TetMesh before = halves.mesh;
  workspace.enter(halves.left(), slots);
  const auto is_inside = [&](TetHandle t) { return halves.inside(t); };
  std::size_t shells = 0;
  for (const TetHandle t : live_tets(halves.mesh)) {
    for (unsigned e = 0; e < 6 && is_inside(t); ++e) {
      Shell shell;
      const ShellKind kind = find_shell(halves.mesh, TetEdge(t, e), shell, Territory());
      const std::span<const TetHandle> old(shell.tets.data(), shell.degree);
      if (kind != ShellKind::closed || std::all_of(old.begin(), old.end(), is_inside)) continue;
      ++shells;
      Transaction transaction(halves.mesh, workspace);
      const VertexHandle middle =
          transaction.add_vertex(0.5 * (halves.mesh.point(shell.a) + halves.mesh.point(shell.b)));
      REQUIRE(middle.is_valid());
      workspace.forget_border();
      CHECK(transaction.replace_cavity(old, split_edge_tets(shell, middle)) == EditResult::no_room);
      CHECK(workspace.met_border());
    }
  }
  CHECK(shells > 0);
  std::size_t moves = 0;
  for (const VertexHandle v : live_vertices(halves.mesh)) {
    Workspace whole = everywhere;
    std::vector<HalfFace> all;
    if (halves.mesh.is_fixed(v) || !collect_link(halves.mesh, v, whole, all)) continue;
    if (std::all_of(all.begin(), all.end(), [&](HalfFace f) { return is_inside(f.tet()); }))
      continue;
    ++moves;
    Transaction transaction(halves.mesh, workspace);
    const VertexMove move{v, halves.mesh.point(v), all};
    CHECK(transaction.move_vertex(v, move.point, all) == EditResult::no_room);
    CHECK(transaction.move_at_surface({&move, 1}) == EditResult::no_room);
    CHECK(transaction.rearrange_vertices({&move, 1}) == EditResult::no_room);
  }
  CHECK(moves > 0);
  CHECK(halves.mesh == before);
}

TEST_CASE("without a free slot an edit that needs one is refused, and nothing changes") {
  Inside in;
  const TetMesh before = in.halves.mesh;
  {
    Transaction transaction(in.halves.mesh, in.workspace);
    CHECK(!transaction.add_vertex(Point(0.1, 0.1, 0.1)).is_valid());
    CHECK(transaction.empty());
  }
  CHECK(in.workspace.met_border());
  CHECK(in.halves.mesh == before);
}

TEST_CASE("an edit takes the slots that were given, and too few are no room") {
  Halves plan;
  Shell shell;
  REQUIRE(find_inner_shell(plan, shell));
  for (const std::size_t tets : {std::size_t{0}, std::size_t{shell.degree} - 1,
                                 std::size_t{shell.degree}, std::size_t{shell.degree} + 3}) {
    CAPTURE(tets);
    Halves halves;
    Workspace workspace(halves.mesh);
    workspace.provide(halves.mesh, tets, 1);
    halves.blocks.resize(halves.mesh.vertex_slots(), 1);
    Workspace::FreeSlots slots = std::exchange(workspace.free_slots(), {});
    const std::size_t tets_before = halves.mesh.tet_count();
    const TetMesh before = halves.mesh;
    workspace.enter(halves.left(), slots);
    EditResult result;
    {
      Transaction transaction(halves.mesh, workspace);
      const VertexHandle v =
          transaction.add_vertex(0.5 * (halves.mesh.point(shell.a) + halves.mesh.point(shell.b)));
      REQUIRE(v.is_valid());
      CHECK(halves.left().holds(v));
      result =
          transaction.replace_cavity({shell.tets.data(), shell.degree}, split_edge_tets(shell, v));
      if (result == EditResult::made) transaction.keep();
    }
    workspace.leave(slots);
    workspace.settle(halves.mesh);
    if (tets < shell.degree) {
      CHECK(result == EditResult::no_room);
      CHECK(workspace.met_border());
      CHECK(halves.mesh == before);
      CHECK(slots.tets.size() == tets);
      CHECK(slots.vertices.size() == 1);
    } else {
      CHECK(result == EditResult::made);
      CHECK(halves.mesh.tet_count() == tets_before + shell.degree);
      CHECK(halves.mesh.tet_count() == live_tets(halves.mesh).size());
      CHECK(halves.mesh.vertex_count() == live_vertices(halves.mesh).size());
      CHECK(slots.tets.size() == tets - shell.degree);
      CHECK(slots.vertices.empty());
      CHECK(to_string(check_integrity(halves.mesh)) == "");
    }
  }
}

TEST_CASE("a move is dated at the vertex itself, and undone with the rest") {
  TetMesh mesh(kuhn_cube(4, 0.2, 1));
  Workspace workspace(mesh);
  workspace.set_date(7);
  const auto vertices = live_vertices(mesh);
  const VertexHandle v = *std::find_if(vertices.begin(), vertices.end(),
                                       [&](VertexHandle w) { return !mesh.is_fixed(w); });
  std::vector<HalfFace> around;
  collect_link(mesh, v, workspace, around);
  const TetMesh before = mesh;
  {
    Transaction transaction(mesh, workspace);
    REQUIRE(transaction.move_vertex(v, mesh.point(v) + Point(1e-3, 0, 0), around) ==
            EditResult::made);
  }
  CHECK(mesh == before);
  Transaction transaction(mesh, workspace);
  REQUIRE(transaction.move_vertex(v, mesh.point(v) + Point(1e-3, 0, 0), around) ==
          EditResult::made);
  transaction.keep();
  CHECK(mesh.moved(v) == 7);
  CHECK(mesh.changed(v) == 0);
  CHECK(mesh.changed(mesh.vertices(around[0])[0]) == 7);
  CHECK(mesh.moved(mesh.vertices(around[0])[0]) == 0);
}
