// SPDX-License-Identifier: MIT
// Edits, refusals, and the way back.
#include "kernel/transaction.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/workspace.h"
#include "tests/support/mesh_parts.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

// --- stencils ------------------------------------------------------------------------------------

struct TetCavity {
  std::vector<TetHandle> old;
  std::vector<TetVertices> created;
};

TetVertices with(TetVertices tet, unsigned i, VertexHandle v) {
  tet[i] = v;
  return tet;
}

/// Two tets at an inner face become three around the line between their apexes.
TetCavity flip_23(const TetMesh& mesh, HalfFace face) {
  const HalfFace twin = mesh.twin(face);
  TetCavity cavity{{face.tet(), twin.tet()}, {}};
  const VertexHandle apex = mesh.vertices(twin.tet())[twin.face()];
  for (unsigned i = 0; i < 4; ++i) {
    if (i != face.face()) cavity.created.push_back(with(mesh.vertices(face.tet()), i, apex));
  }
  return cavity;
}

/// Three tets around an edge become two. Precondition: a closed shell of degree 3.
TetCavity flip_32(const Shell& shell) {
  const auto& p = shell.ring;
  return {{shell.tets[0], shell.tets[1], shell.tets[2]},
          {{p[0], p[1], p[2], shell.b}, {p[0], p[2], p[1], shell.a}}};
}

/// Each tet of a shell becomes two, m in the place of a and of b.
TetCavity split_edge(const TetMesh& mesh, TetEdge edge, VertexHandle m) {
  TetCavity cavity;
  const auto [a, b] = mesh.vertices(edge);
  for (const TetHandle t : ring(mesh, edge).tets) {
    cavity.old.push_back(t);
    for (const unsigned i : kEdgeVertices[edge_in(mesh, t, a, b)->edge()]) {
      cavity.created.push_back(with(mesh.vertices(t), i, m));
    }
  }
  return cavity;
}

TetCavity split_tet(const TetMesh& mesh, TetHandle t, VertexHandle m) {
  TetCavity cavity{{t}, {}};
  for (unsigned i = 0; i < 4; ++i) cavity.created.push_back(with(mesh.vertices(t), i, m));
  return cavity;
}

/// Four tets around a vertex become one.
std::optional<TetCavity> remove_vertex(const TetMesh& mesh, VertexHandle v) {
  const auto faces = link(mesh, v);
  if (faces.size() != 4) return std::nullopt;
  TetCavity cavity;
  for (const HalfFace f : faces) cavity.old.push_back(f.tet());
  const auto ring = one_ring(mesh, v);
  if (ring.size() != 4) return std::nullopt;
  const HalfFace base = HalfFace(cavity.old[0], mesh.local_index(cavity.old[0], v));
  for (const VertexHandle w : ring) {
    if (mesh.local_index(base.tet(), w) == 4) {
      cavity.created.push_back(with(mesh.vertices(base.tet()), base.face(), w));
    }
  }
  return cavity;
}

Point middle(const TetMesh& mesh, const TetVertices& v) {
  return (mesh.point(v[0]) + mesh.point(v[1]) + mesh.point(v[2]) + mesh.point(v[3])) / 4;
}

EditResult replace(Transaction& tx, const TetCavity& cavity) {
  return tx.replace_cavity(cavity.old, cavity.created);
}

/// A 2-3 flip whose new tets are all positive.
TetCavity valid_flip_23(const TetMesh& mesh) {
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (mesh.is_boundary(HalfFace(t, f))) continue;
      const TetCavity cavity = flip_23(mesh, HalfFace(t, f));
      if (std::all_of(cavity.created.begin(), cavity.created.end(),
                      [&](const TetVertices& v) { return mesh.is_certified_positive(v); })) {
        return cavity;
      }
    }
  }
  FAIL("no face to flip");
  return {};
}

std::vector<VertexHandle> free_vertices(const TetMesh& mesh) {
  std::vector<VertexHandle> free = live_vertices(mesh);
  std::erase_if(free, [&](VertexHandle v) { return mesh.is_fixed(v); });
  return free;
}

// --- random edits --------------------------------------------------------------------------------

/// Makes random edits in nested transactions and checks the mesh after each.
class RandomEditor {
 public:
  RandomEditor(TetMesh& mesh, Workspace& workspace, std::uint64_t seed)
      : mesh_(mesh), workspace_(workspace), random_(seed) {}

  /// A transaction with edits, children and undos, kept or not. True if kept.
  bool play(unsigned depth) {
    const TetMesh before = mesh_;
    bool kept = false;
    {
      Transaction tx(mesh_, workspace_);
      const std::size_t steps = 1 + random_.index(6);
      for (std::size_t i = 0; i < steps; ++i) {
        if (depth < 3 && random_.index(4) == 0) {
          const TetMesh at_child = mesh_;
          if (!play(depth + 1)) require_same(at_child);
        } else {
          edit();
        }
        if (random_.index(10) == 0) {
          tx.undo();
          require_same(before);
          CHECK(tx.empty());
        }
      }
      kept = random_.index(2) == 0;
      if (kept) tx.keep();
    }
    if (!kept) require_same(before);
    return kept;
  }

  /// Handles that edits created, in their order.
  const std::vector<TetHandle>& log() const { return log_; }
  std::size_t made() const { return made_; }
  std::size_t refused() const { return refused_; }

 private:
  void require_same(const TetMesh& other) { REQUIRE(mesh_ == other); }

  void edit() {
    const TetMesh before = mesh_;
    EditResult result = EditResult::not_closed;
    {
      // A child of its own, because an edit may start with a new vertex that a refusal leaves over.
      Transaction child(mesh_, workspace_);
      result = try_edit(child);
      if (result == EditResult::made) child.keep();
    }
    if (result != EditResult::made) {
      ++refused_;
      require_same(before);
      return;
    }
    ++made_;
    const std::string findings = to_string(check_integrity(mesh_));
    REQUIRE(findings == "");
  }

  EditResult try_edit(Transaction& tx) {
    const std::vector<TetHandle> tets = live_tets(mesh_);
    const TetHandle t = tets[random_.index(tets.size())];
    const std::size_t kind = random_.index(mesh_.tet_count() > 150 ? 5 : 7);
    switch (kind) {
      case 0: {
        const HalfFace face(t, static_cast<unsigned>(random_.index(4)));
        if (mesh_.is_boundary(face)) return EditResult::not_closed;
        return logged(tx, flip_23(mesh_, face));
      }
      case 1:
      case 2: {
        for (unsigned e = 0; e < 6; ++e) {
          Shell shell;
          if (find_shell(mesh_, TetEdge(t, e), shell, Territory()) != ShellKind::too_large &&
              shell.degree == 3 && !mesh_.is_boundary(HalfFace(t, 0)) && closes(shell)) {
            return logged(tx, flip_32(shell));
          }
        }
        return EditResult::not_closed;
      }
      case 3: {
        const auto vertices = live_vertices(mesh_);
        const VertexHandle v = vertices[random_.index(vertices.size())];
        const auto faces = link(mesh_, v);
        return tx.move_vertex(v, mesh_.point(v) + random_.in_ball(0.1), faces);
      }
      case 4: {
        for (const VertexHandle v : free_vertices(mesh_)) {
          if (const auto cavity = remove_vertex(mesh_, v)) return logged(tx, *cavity);
        }
        return EditResult::not_closed;
      }
      case 5: {
        const TetEdge edge(t, static_cast<unsigned>(random_.index(6)));
        const auto [a, b] = mesh_.vertices(edge);
        const VertexHandle m = tx.add_vertex((mesh_.point(a) + mesh_.point(b)) / 2);
        return logged(tx, split_edge(mesh_, edge, m));
      }
      default: {
        const VertexHandle m = tx.add_vertex(middle(mesh_, mesh_.vertices(t)));
        return logged(tx, split_tet(mesh_, t, m));
      }
    }
  }
  /// find_shell reports the first obstacle; the flip itself must refuse constrained shells.
  bool closes(const Shell& shell) const {
    return mesh_.local_index(shell.tets[2], shell.ring[0]) != 4;
  }
  EditResult logged(Transaction& tx, const TetCavity& cavity) {
    const EditResult result = replace(tx, cavity);
    if (result == EditResult::made) {
      log_.insert(log_.end(), tx.created().begin(), tx.created().end());
    }
    return result;
  }

  TetMesh& mesh_;
  Workspace& workspace_;
  Random random_;
  std::vector<TetHandle> log_;
  std::size_t made_ = 0;
  std::size_t refused_ = 0;
};

MeshData constrained_ball() {
  MeshData data = zoo_data("ball_20");
  for (MeshData::Tet& tet : data.tets) {
    double x = 0;
    for (const std::uint32_t v : tet.vertices) x += data.points[v].x();
    tet.label = x < 0 ? 1 : 2;
  }
  data.edges.push_back({{data.tets[10].vertices[0], data.tets[10].vertices[2]}, 1});
  data.required_vertices = {3};
  return data;
}

}  // namespace

// --- random edits --------------------------------------------------------------------------------

TEST_CASE("after thousands of random edits in nested transactions every undo gives the same mesh") {
  std::size_t made = 0;
  std::size_t refused = 0;
  for (const auto& [data, rounds] :
       {std::pair(zoo_data("ball_20"), 500), std::pair(constrained_ball(), 500),
        std::pair(two_regions(), 200), std::pair(zoo_data("tangled_ball_60"), 40),
        std::pair(touching_at_edge(), 200)}) {
    TetMesh mesh(data);
    Workspace workspace(mesh);
    const double volume = total_volume(mesh);
    const std::uint64_t surface = surface_fingerprint(mesh);
    RandomEditor editor(mesh, workspace, 7);
    for (int i = 0; i < rounds; ++i) editor.play(0);
    CHECK(total_volume(mesh) == doctest::Approx(volume).epsilon(1e-9));
    CHECK(surface_fingerprint(mesh) == surface);
    made += editor.made();
    refused += editor.refused();
    // What is written can be read again.
    const TetMesh again(mesh.to_data());
    CHECK(again.tet_count() == mesh.tet_count());
    CHECK(surface_fingerprint(again) == surface);
    CHECK(to_string(check_integrity(again)) == "");
  }
  CHECK(made > 2000);
  CHECK(refused > 2000);
}

TEST_CASE("edits that are undone and done again get the same handle numbers") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    TetMesh mesh(zoo_data("ball_20"));
    Workspace workspace(mesh);
    RandomEditor(mesh, workspace, 100 + seed).play(1);  // leaves free slots, or not
    const auto run = [&](std::vector<TetHandle>& log) {
      const TetMesh before = mesh;
      TetMesh after;
      {
        Transaction tx(mesh, workspace);
        RandomEditor editor(mesh, workspace, seed);
        for (int i = 0; i < 6; ++i) editor.play(1);
        log = editor.log();
        after = mesh;
      }
      REQUIRE(mesh == before);
      return after;
    };
    std::vector<TetHandle> first, second;
    const TetMesh one = run(first);
    const TetMesh two = run(second);
    CHECK(first == second);
    CHECK(one == two);
  }
}

// --- single edits --------------------------------------------------------------------------------

TEST_CASE("a 2-3 flip and its way back over a 3-2 flip keep the mesh sound") {
  TetMesh mesh(two_tets());
  Workspace workspace(mesh);
  const double volume = total_volume(mesh);
  Transaction tx(mesh, workspace);
  REQUIRE(replace(tx, flip_23(mesh, inner_face(mesh))) == EditResult::made);
  CHECK(mesh.tet_count() == 3);
  CHECK(tx.created().size() == 3);
  CHECK(to_string(check_integrity(mesh)) == "");
  Shell shell;
  REQUIRE(find_shell(mesh, *edge_in(mesh, TetHandle(0), VertexHandle(3), VertexHandle(4)), shell,
                     Territory()) == ShellKind::closed);
  REQUIRE(replace(tx, flip_32(shell)) == EditResult::made);
  CHECK(mesh.tet_count() == 2);
  CHECK(mesh.tet_slots() == 3);
  CHECK(mesh.is_deleted(tx.created()[1]) == false);
  CHECK(to_string(check_integrity(mesh)) == "");
  tx.keep();
  CHECK(total_volume(mesh) == doctest::Approx(volume));
  for (const TetHandle t : live_tets(mesh)) {
    CHECK(mesh.is_touched(t));
    CHECK(mesh.is_created(t));
  }
}

TEST_CASE("new tets take the slots of the old, then free slots, then the mesh grows") {
  TetMesh mesh(zoo_data("ball_20"));
  Workspace workspace(mesh);
  const std::size_t slots = mesh.tet_slots();
  Transaction tx(mesh, workspace);
  const TetHandle t(7);
  const VertexHandle m = tx.add_vertex(middle(mesh, mesh.vertices(t)));
  CHECK(m.index() == 20);
  const TetVertices whole = mesh.vertices(t);
  REQUIRE(replace(tx, split_tet(mesh, t, m)) == EditResult::made);
  const std::vector<TetHandle> four(tx.created().begin(), tx.created().end());
  CHECK(four[0] == t);
  CHECK(four[1].index() == slots);
  REQUIRE(tx.replace_cavity(four, {&whole, 1}) == EditResult::made);
  CHECK(tx.created()[0] == t);
  CHECK(mesh.is_deleted(m));
  CHECK(mesh.vertex_count() == 20);
  // The slots that became free last are used first.
  const VertexHandle again = tx.add_vertex(middle(mesh, mesh.vertices(t)));
  CHECK(again == m);
  REQUIRE(replace(tx, split_tet(mesh, t, again)) == EditResult::made);
  CHECK(mesh.tet_slots() == slots + 3);
  CHECK(to_string(check_integrity(mesh)) == "");
}

TEST_CASE("an edit that fits but is not kept leaves the mesh as it was") {
  TetMesh mesh(two_tets());
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  {
    Transaction tx(mesh, workspace);
    REQUIRE(replace(tx, flip_23(mesh, inner_face(mesh))) == EditResult::made);
    CHECK_FALSE(mesh == before);
    CHECK_FALSE(tx.empty());
  }
  CHECK(mesh == before);
}

TEST_CASE("refused edits say why and change nothing") {
  TetMesh mesh(zoo_data("sandwich_5"));
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  const TetCavity flip = valid_flip_23(mesh);

  TetCavity incomplete = flip;
  incomplete.created.pop_back();
  CHECK(replace(tx, incomplete) == EditResult::not_closed);
  TetCavity larger = flip;
  larger.old.pop_back();
  CHECK(replace(tx, larger) == EditResult::not_closed);
  TetCavity twice = flip;
  twice.created.push_back(twice.created[0]);
  CHECK(replace(tx, twice) == EditResult::not_closed);
  TetCavity turned = flip;
  std::swap(turned.created[1][0], turned.created[1][1]);
  CHECK(replace(tx, turned) == EditResult::inverted);
  TetCavity pinched = flip;
  pinched.created[0][1] = pinched.created[0][0];
  CHECK(replace(tx, pinched) == EditResult::inverted);
  CHECK(tx.empty());
  CHECK(mesh == before);
  CHECK(tx.created().empty());
}

TEST_CASE(
    "workspaces that take turns, and one older than a garbage collection, leave a sound mesh") {
  TetMesh mesh = make_mesh(zoo_data("cube_3"));
  Workspace first(mesh), second(mesh);
  const auto split = [&](Workspace& workspace, TetHandle t) {
    Transaction tx(mesh, workspace);
    const TetVertices v = mesh.vertices(t);
    Point middle = Point::Zero();
    for (const VertexHandle w : v) middle += 0.25 * mesh.point(w);
    const TetCavity cavity = split_tet(mesh, t, tx.add_vertex(middle));
    REQUIRE(tx.replace_cavity(cavity.old, cavity.created) == EditResult::made);
    tx.keep();
    const VertexHandle m = mesh.vertices(t)[0] == v[0] ? mesh.vertices(t)[3] : mesh.vertices(t)[0];
    return m;
  };
  const auto take_out = [&](Workspace& workspace, VertexHandle m) {
    Transaction tx(mesh, workspace);
    const auto cavity = remove_vertex(mesh, m);
    REQUIRE(cavity);
    if (tx.replace_cavity(cavity->old, cavity->created) == EditResult::made) tx.keep();
  };
  const std::size_t tets = mesh.tet_count();
  // Both workspaces list the slots that the first one made free and the second one filled.
  std::vector<VertexHandle> middles;
  for (std::uint32_t i = 0; i < 8; ++i) {
    middles.push_back(split(first, TetHandle(i)));
  }
  for (const VertexHandle m : middles) take_out(first, m);
  Workspace third(mesh);
  for (std::uint32_t i = 0; i < 24; ++i) {
    split(i % 3 == 0 ? first : i % 3 == 1 ? second : third, live_tets(mesh)[i]);
    REQUIRE(check_integrity(mesh).empty());
  }
  CHECK(mesh.tet_count() == tets + 3 * 24);
  CHECK(live_tets(mesh).size() == mesh.tet_count());
  mesh.collect_garbage();
  for (std::uint32_t i = 0; i < 6; ++i) split(first, live_tets(mesh)[5 * i]);
  CHECK(check_integrity(mesh).empty());
  CHECK(live_tets(mesh).size() == mesh.tet_count());
}

TEST_CASE("a move without a link is refused, and the kernel finds the link itself") {
  TetMesh mesh = make_mesh(zoo_data("ball_60"));
  Workspace workspace(mesh);
  for (const VertexHandle v : live_vertices(mesh)) {
    if (mesh.is_fixed(v)) continue;
    Transaction tx(mesh, workspace);
    CHECK(tx.move_vertex(v, {50, 0, 0}, {}) == EditResult::not_closed);
    CHECK(tx.move_vertex(v, {50, 0, 0}) == EditResult::inverted);
    CHECK(tx.move_vertex(v, mesh.point(v) + Point(1e-9, 0, 0)) == EditResult::made);
  }
  Transaction tx(mesh, workspace);
  CHECK(tx.move_vertex(VertexHandle(), {0, 0, 0}) == EditResult::not_closed);
}

TEST_CASE("a new vertex that has tets elsewhere is refused") {
  TetMesh mesh(zoo_data("ball_60"));
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  std::size_t refused = 0;
  for (const TetHandle t : live_tets(mesh)) {
    for (const VertexHandle v : live_vertices(mesh)) {
      if (mesh.local_index(t, v) != 4) continue;
      Transaction tx(mesh, workspace);
      const EditResult result = replace(tx, split_tet(mesh, t, v));
      REQUIRE(result != EditResult::made);
      ++refused;
    }
  }
  CHECK(refused > 1000);
  CHECK(mesh == before);
}

TEST_CASE("a constrained face is never removed") {
  TetMesh mesh(constrained_face());
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  CHECK(replace(tx, flip_23(mesh, inner_face(mesh))) == EditResult::constrained);
  CHECK(mesh == before);
}

TEST_CASE("a border between labels is never removed") {
  MeshData data = two_tets();
  data.tets[1].label = 4;
  TetMesh mesh(data);
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  CHECK(replace(tx, flip_23(mesh, inner_face(mesh))) == EditResult::constrained);
  CHECK(mesh == before);
}

TEST_CASE("a constrained edge is never removed, and its marks follow new tets") {
  MeshData data = shell_mesh({.degree = 3});
  data.edges.push_back({{0, 1}, 4});
  data.edges.push_back({{2, 3}, 5});
  TetMesh mesh(data);
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  // find_shell stops at the constraint, so the flip is written out: ring 2 3 4 around 0 1.
  const VertexHandle a(0), b(1), p(2), q(3), r(4);
  CHECK(replace(tx, {live_tets(mesh), {{p, q, r, b}, {p, r, q, a}}}) == EditResult::constrained);
  CHECK(mesh == before);
  // Splitting a tet beside it is allowed.
  const TetHandle t = live_tets(mesh)[0];
  const VertexHandle m = tx.add_vertex(middle(mesh, mesh.vertices(t)));
  REQUIRE(replace(tx, split_tet(mesh, t, m)) == EditResult::made);
  CHECK(to_string(check_integrity(mesh)) == "");
  std::size_t marked = 0;
  for (const TetHandle u : live_tets(mesh)) {
    if (const auto edge = edge_in(mesh, u, a, b)) marked += mesh.is_constrained(*edge);
  }
  CHECK(marked == 4);
}

TEST_CASE("the marks of a constrained face and a boundary triangle follow new tets") {
  TetMesh mesh(constrained_face());
  Workspace workspace(mesh);
  const std::uint64_t surface = surface_fingerprint(mesh);
  Transaction tx(mesh, workspace);
  const VertexHandle m = tx.add_vertex(middle(mesh, mesh.vertices(TetHandle(0))));
  REQUIRE(replace(tx, split_tet(mesh, TetHandle(0), m)) == EditResult::made);
  CHECK(to_string(check_integrity(mesh)) == "");
  CHECK(surface_fingerprint(mesh) == surface);
}

TEST_CASE("a required vertex neither vanishes nor moves") {
  for (const bool required : {false, true}) {
    MeshData data = one_tet();
    data.points.push_back({0.1, 0.1, 0.1});
    const auto t = data.tets[0].vertices;
    data.tets.clear();
    for (unsigned i = 0; i < 4; ++i) {
      data.tets.push_back({t, 0});
      data.tets.back().vertices[i] = 4;
    }
    if (required) data.required_vertices = {4};
    TetMesh mesh(data);
    const TetMesh before = mesh;
    Workspace workspace(mesh);
    Transaction tx(mesh, workspace);
    const VertexHandle v(4);
    const EditResult expected = required ? EditResult::constrained : EditResult::made;
    CHECK(tx.move_vertex(v, {0, 0, 0.1}, link(mesh, v)) == expected);
    const auto cavity = remove_vertex(mesh, v);
    REQUIRE(cavity);
    CHECK(replace(tx, *cavity) == expected);
    CHECK(mesh.is_deleted(v) == !required);
    tx.undo();
    CHECK(mesh == before);
  }
}

TEST_CASE("vertices of the boundary and of constrained edges do not move") {
  TetMesh mesh(constrained_ball());
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  std::size_t moved = 0;
  for (const VertexHandle v : live_vertices(mesh)) {
    const Point tiny = mesh.point(v) + Point(1e-9, 0, 0);
    const EditResult result = tx.move_vertex(v, tiny, link(mesh, v));
    CHECK((result == EditResult::constrained) == mesh.is_fixed(v));
    if (mesh.is_boundary(v)) CHECK(mesh.is_fixed(v));
    moved += result == EditResult::made;
  }
  CHECK(moved > 0);
  tx.undo();
  CHECK(mesh == before);
}

TEST_CASE("a move that turns a tet over is refused, one that untangles is not") {
  TetMesh mesh(zoo_data("cube_2"));
  Workspace workspace(mesh);
  const VertexHandle v = free_vertices(mesh).at(0);
  const TetMesh before = mesh;
  Transaction tx(mesh, workspace);
  CHECK(tx.move_vertex(v, {1.2, 0.5, 0.5}, link(mesh, v)) == EditResult::inverted);
  CHECK(mesh == before);
  CHECK(tx.move_vertex(v, {0.5, 0.5, 0.5}, link(mesh, v)) == EditResult::made);
  CHECK(mesh.point(v) == Point(0.5, 0.5, 0.5));
  CHECK(to_string(check_integrity(mesh)) == "");

  MeshData data = zoo_data("cube_2");
  data.points[v.index()] = {1.2, 0.5, 0.5};
  TetMesh tangled(data);
  REQUIRE(count_not_positive(tangled) > 0);
  Workspace other(tangled);
  Transaction untangle(tangled, other);
  CHECK(untangle.move_vertex(v, {0.5, 0.5, 0.5}, link(tangled, v)) == EditResult::made);
  CHECK(count_not_positive(tangled) == 0);
}

TEST_CASE("vertices that move together need not be in one another's way") {
  TetMesh mesh(zoo_data("ball_60"));
  Workspace workspace(mesh);
  const TetMesh before = mesh;
  Random random(5);
  const auto free = free_vertices(mesh);
  std::vector<Quality> old_values, now, expected;
  int only_together = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const VertexHandle v = free[random.index(free.size())];
    const VertexHandle w = free[random.index(free.size())];
    if (v == w) continue;
    const Point way = random.in_ball(0.3);
    const auto faces = link(mesh, v);
    const std::vector<HalfFace> of_v(faces.begin(), faces.end());
    const auto of_w = link(mesh, w);
    const std::array<VertexMove, 2> moves = {VertexMove{v, mesh.point(v) + way, of_v},
                                             VertexMove{w, mesh.point(w) + way, of_w}};
    Transaction tx(mesh, workspace);
    if (tx.move_vertex(v, moves[0].point, of_v) != EditResult::inverted) continue;
    if (tx.move_vertices(moves) != EditResult::made) {
      CHECK(mesh == before);
      continue;
    }
    ++only_together;
    CHECK(mesh.point(v) == before.point(v) + way);
    CHECK(mesh.point(w) == before.point(w) + way);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(count_not_positive(mesh) == 0);
    // Tets of both are compared once.
    std::set<TetHandle> around;
    for (const HalfFace f : of_v) around.insert(f.tet());
    for (const HalfFace f : of_w) around.insert(f.tet());
    expected.clear();
    for (const TetHandle t : around) expected.push_back(before.quality(t));
    std::sort(expected.begin(), expected.end());
    tx.compare(old_values, now);
    CHECK(old_values == expected);
    CHECK(now.size() == expected.size());
    tx.undo();
    CHECK(mesh == before);
  }
  CHECK(only_together > 5);
}

TEST_CASE("of vertices that move together none moves when one may not") {
  TetMesh mesh(zoo_data("ball_60"));
  Workspace workspace(mesh);
  const TetMesh before = mesh;
  const VertexHandle v = free_vertices(mesh).at(0);
  VertexHandle fixed;
  for (const VertexHandle w : live_vertices(mesh)) {
    if (mesh.is_fixed(w)) fixed = w;
  }
  const auto faces = link(mesh, v);
  const Point near = mesh.point(v) + Point(1e-9, 0, 0);
  const std::array<VertexMove, 2> moves = {VertexMove{v, near, faces},
                                           VertexMove{fixed, mesh.point(fixed), {}}};
  Transaction tx(mesh, workspace);
  CHECK(tx.move_vertices(moves) == EditResult::constrained);
  CHECK(mesh == before);
}

TEST_CASE("vertices are rearranged if fewer tets are inverted then, even if others turn over") {
  const MeshData good = kuhn_cube(4, 0, 1);
  MeshData data = kuhn_cube(4, 1.5, 2);
  TetMesh mesh(data);
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  const std::size_t inverted = count_not_positive(mesh);
  REQUIRE(inverted > 50);
  const std::vector<VertexHandle> free = free_vertices(mesh);
  std::vector<std::vector<HalfFace>> links;
  std::vector<VertexMove> moves;
  for (const VertexHandle v : free) {
    const auto faces = link(mesh, v);
    links.emplace_back(faces.begin(), faces.end());
    moves.push_back({v, good.points[v.index()], {}});
  }
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i].link = links[i];
  // One vertex goes astray, so that tets that were positive are turned over.
  moves[0].point += Point(0.3, 0.2, 0.1);
  {
    Transaction tx(mesh, workspace);
    CHECK(tx.move_vertices(moves) == EditResult::inverted);
    CHECK(mesh == before);
    REQUIRE(tx.rearrange_vertices(moves) == EditResult::made);
    std::size_t turned = 0;
    for (const TetHandle t : live_tets(mesh)) {
      CHECK(mesh.quality(t) == mesh.evaluate(mesh.vertices(t)));
      turned += before.quality(t) > 0 && mesh.quality(t) <= 0 ? 1 : 0;
    }
    CHECK(turned > 0);
    CHECK(count_not_positive(mesh) < inverted);
    CHECK(to_string(check_integrity(mesh)) == "");
    tx.undo();
    CHECK(mesh == before);
    // The way back makes more of them.
    REQUIRE(tx.rearrange_vertices(moves) == EditResult::made);
    const TetMesh better = mesh;
    for (VertexMove& move : moves) move.point = before.point(move.vertex);
    CHECK(tx.rearrange_vertices(moves) == EditResult::inverted);
    CHECK(mesh == better);
    tx.keep();
  }
  CHECK(count_not_positive(mesh) < inverted);
}

TEST_CASE("vertices of which one is fixed are not rearranged") {
  TetMesh mesh(kuhn_cube(4, 1.5, 2));
  const TetMesh before = mesh;
  Workspace workspace(mesh);
  const VertexHandle v = free_vertices(mesh).at(0);
  const auto faces = link(mesh, v);
  const std::array<VertexMove, 2> moves = {VertexMove{v, Point(0.5, 0.5, 0.5), faces},
                                           VertexMove{VertexHandle(0), mesh.point(v), {}}};
  REQUIRE(mesh.is_fixed(VertexHandle(0)));
  Transaction tx(mesh, workspace);
  CHECK(tx.rearrange_vertices(moves) == EditResult::constrained);
  CHECK(mesh == before);
}

// --- comparison ----------------------------------------------------------------------------------

TEST_CASE("compare gives the qualities of all that was touched, before and now, ascending") {
  TetMesh mesh(zoo_data("sandwich_5"));
  Workspace workspace(mesh);
  std::vector<Quality> before, now;
  Transaction tx(mesh, workspace);
  tx.compare(before, now);
  CHECK(before.empty());
  CHECK(now.empty());

  const TetCavity flip = valid_flip_23(mesh);
  std::vector<Quality> expected = {mesh.quality(flip.old[0]), mesh.quality(flip.old[1])};
  std::sort(expected.begin(), expected.end());
  REQUIRE(replace(tx, flip) == EditResult::made);
  const std::vector<TetHandle> flipped(tx.created().begin(), tx.created().end());
  tx.compare(before, now);
  CHECK(before == expected);
  CHECK(now.size() == 3);
  CHECK(std::is_sorted(now.begin(), now.end()));

  {
    // A child sees only its own edits; tets made before count as "before".
    Transaction child(mesh, workspace);
    const VertexHandle m = child.add_vertex(middle(mesh, mesh.vertices(flipped[0])));
    const Quality whole = mesh.quality(flipped[0]);
    REQUIRE(replace(child, split_tet(mesh, flipped[0], m)) == EditResult::made);
    std::vector<Quality> child_before, child_now;
    child.compare(child_before, child_now);
    CHECK(child_before == std::vector<Quality>{whole});
    CHECK(child_now.size() == 4);
    child.keep();
  }
  tx.compare(before, now);
  CHECK(before == expected);
  std::vector<Quality> all;
  for (const TetHandle t : live_tets(mesh)) {
    if (mesh.is_touched(t)) all.push_back(mesh.quality(t));
  }
  std::sort(all.begin(), all.end());
  CHECK(now == all);
  CHECK(now.size() == 6);
}

TEST_CASE("compare counts a moved and then replaced tet once, with its first quality") {
  TetMesh mesh(zoo_data("cube_2"));
  Workspace workspace(mesh);
  const VertexHandle v = free_vertices(mesh).at(0);
  std::vector<Quality> expected;
  for (const TetHandle t : star(mesh, v)) expected.push_back(mesh.quality(t));
  std::sort(expected.begin(), expected.end());
  Transaction tx(mesh, workspace);
  std::vector<Quality> before, now;
  for (const double x : {0.45, 0.5, 0.52}) {
    REQUIRE(tx.move_vertex(v, {x, 0.5, 0.5}, link(mesh, v)) == EditResult::made);
    tx.compare(before, now);
    CHECK(before == expected);
    CHECK(now.size() == expected.size());
  }
  const TetHandle t = star(mesh, v)[0];
  const VertexHandle m = tx.add_vertex(middle(mesh, mesh.vertices(t)));
  REQUIRE(replace(tx, split_tet(mesh, t, m)) == EditResult::made);
  tx.compare(before, now);
  CHECK(before == expected);
  CHECK(now.size() == expected.size() + 3);
}

TEST_CASE("the tets that a transaction made or changed are listed once, those that are gone not") {
  TetMesh mesh(zoo_data("cube_2"));
  Workspace workspace(mesh);
  const VertexHandle v = free_vertices(mesh).at(0);
  std::vector<TetHandle> changed;
  Transaction tx(mesh, workspace);
  tx.list_changed(changed);
  CHECK(changed.empty());
  for (const double x : {0.5, 0.52}) {
    REQUIRE(tx.move_vertex(v, {x, 0.5, 0.5}, link(mesh, v)) == EditResult::made);
  }
  const VertexHandle m = tx.add_vertex(middle(mesh, mesh.vertices(mesh.tet_of(v))));
  REQUIRE(replace(tx, split_tet(mesh, mesh.tet_of(v), m)) == EditResult::made);
  std::set<TetHandle> expected;
  for (const VertexHandle w : {v, m}) {
    for (const TetHandle t : star(mesh, w)) expected.insert(t);
  }
  tx.list_changed(changed);
  CHECK(changed.size() == expected.size());
  CHECK(std::set<TetHandle>(changed.begin(), changed.end()) == expected);
  tx.undo();
  tx.list_changed(changed);
  CHECK(changed.empty());
}

TEST_CASE("edits that were undone do not count in compare") {
  TetMesh mesh(zoo_data("sandwich_5"));
  Workspace workspace(mesh);
  Transaction tx(mesh, workspace);
  {
    Transaction child(mesh, workspace);
    REQUIRE(replace(child, valid_flip_23(mesh)) == EditResult::made);
  }
  std::vector<Quality> before, now;
  tx.compare(before, now);
  CHECK(before.empty());
  CHECK(now.empty());
}

// --- dates and properties ------------------------------------------------------------------------

TEST_CASE("dates are written to the vertices around a change, and only at the outermost keep") {
  TetMesh mesh(zoo_data("ball_20"));
  Workspace workspace(mesh);
  workspace.set_date(5);
  const TetHandle t(7);
  const TetVertices v = mesh.vertices(t);
  VertexHandle m;
  const auto dated = [&] {
    std::vector<VertexHandle> vertices;
    for (const VertexHandle w : live_vertices(mesh)) {
      CHECK((mesh.changed(w) == 0 || mesh.changed(w) == 5));
      if (mesh.changed(w) != 0) vertices.push_back(w);
    }
    return vertices;
  };
  {
    Transaction tx(mesh, workspace);
    {
      Transaction child(mesh, workspace);
      m = child.add_vertex(middle(mesh, v));
      REQUIRE(replace(child, split_tet(mesh, t, m)) == EditResult::made);
      child.keep();
    }
    CHECK(dated().empty());
    tx.keep();
  }
  std::vector<VertexHandle> expected(v.begin(), v.end());
  expected.push_back(m);
  std::sort(expected.begin(), expected.end());
  CHECK(dated() == expected);
}

TEST_CASE("a move dates the vertices around, not the vertex itself") {
  TetMesh mesh(zoo_data("cube_2"));
  Workspace workspace(mesh);
  workspace.set_date(9);
  const VertexHandle v = free_vertices(mesh).at(0);
  {
    Transaction tx(mesh, workspace);
    REQUIRE(tx.move_vertex(v, {0.5, 0.5, 0.5}, link(mesh, v)) == EditResult::made);
    tx.keep();
  }
  CHECK(mesh.changed(v) == 0);
  for (const VertexHandle w : one_ring(mesh, v)) CHECK(mesh.changed(w) == 9);
  for (const TetHandle t : star(mesh, v)) {
    CHECK(mesh.is_touched(t));
    CHECK_FALSE(mesh.is_created(t));
  }
}

TEST_CASE("dates and marks of edits that are not kept are not written") {
  TetMesh mesh(zoo_data("cube_2"));
  Workspace workspace(mesh);
  const VertexHandle v = free_vertices(mesh).at(0);
  {
    Transaction tx(mesh, workspace);
    {
      Transaction child(mesh, workspace);
      REQUIRE(child.move_vertex(v, {0.5, 0.5, 0.5}, link(mesh, v)) == EditResult::made);
      child.keep();
    }
    tx.undo();
    tx.keep();
  }
  for (const VertexHandle w : live_vertices(mesh)) CHECK(mesh.changed(w) == 0);
  for (const TetHandle t : live_tets(mesh)) CHECK_FALSE(mesh.is_touched(t));
}
