// SPDX-License-Identifier: MIT
// Each kind of damage is found, and none is seen in sound meshes.
#include "kernel/integrity.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "kernel/statistics.h"
#include "tests/support/mesh_parts.h"
#include "tests/support/zoo.h"

namespace tetmend {

/// The arrays of a mesh, to break them.
struct TetMeshTestAccess {
  static auto& cell(TetMesh& m, TetHandle t) { return m.cells_[t.index()]; }
  static auto& quality(TetMesh& m, TetHandle t) { return m.quality_[t.index()]; }
  static auto& label(TetMesh& m, TetHandle t) { return m.label_[t.index()]; }
  static auto& flags(TetMesh& m, TetHandle t) { return m.tet_flags_[t.index()]; }
  static auto& link(TetMesh& m, VertexHandle v) { return m.vertex_tet_[v.index()]; }
  static auto& flags(TetMesh& m, VertexHandle v) { return m.vertex_flags_[v.index()]; }
  static auto& surface(TetMesh& m) { return m.surface_; }
  static auto& tet_count(TetMesh& m) { return m.tet_count_; }
  static auto& vertex_count(TetMesh& m) { return m.vertex_count_; }
  static constexpr auto kBoundary = TetMesh::kVertexBoundary;
  static constexpr auto kConstrained = TetMesh::kVertexConstrained;
  static constexpr auto kDeleted = TetMesh::kVertexDeleted;
  static constexpr auto kFrozen = TetMesh::kVertexFrozen;
};

}  // namespace tetmend

using namespace tetmend;
using namespace tetmend::test;
using Access = TetMeshTestAccess;
using Kind = Finding::Kind;

namespace {

bool finds(const TetMesh& mesh, Kind kind) {
  const auto findings = check_integrity(mesh);
  INFO(to_string(findings));
  return std::any_of(findings.begin(), findings.end(),
                     [&](const Finding& f) { return f.kind == kind; });
}
/// All findings are of this kind, and there is one.
bool finds_only(const TetMesh& mesh, Kind kind) {
  const auto findings = check_integrity(mesh);
  const bool only = std::all_of(findings.begin(), findings.end(),
                                [&](const Finding& f) { return f.kind == kind; });
  if (!only || findings.empty()) MESSAGE("found: " << to_string(findings));
  return only && !findings.empty();
}

HalfFace outer_face(const TetMesh& mesh) {
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (mesh.is_boundary(HalfFace(t, f))) return HalfFace(t, f);
    }
  }
  FAIL("no outer face");
  return {};
}
VertexHandle inner_vertex(const TetMesh& mesh) {
  for (const VertexHandle v : live_vertices(mesh)) {
    if (!mesh.is_boundary(v)) return v;
  }
  FAIL("no inner vertex");
  return {};
}

}  // namespace

TEST_CASE("every mesh of the zoo is without findings") {
  for (const NamedMesh& named : zoo()) {
    CAPTURE(named.name);
    CHECK(to_string(check_integrity(TetMesh(named.data))) == "");
  }
}

TEST_CASE("a neighbour that does not point back is found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  const HalfFace face = inner_face(mesh);
  auto& neighbours = Access::cell(mesh, face.tet()).neighbours;
  SUBCASE("another face of the neighbour") {
    const HalfFace twin = mesh.twin(face);
    neighbours[face.face()] = HalfFace(twin.tet(), (twin.face() + 1) % 4);
  }
  SUBCASE("a tet that does not exist") {
    neighbours[face.face()] = HalfFace(TetHandle(1u << 20), 0);
  }
  SUBCASE("the tet itself") {
    neighbours[face.face()] = HalfFace(face.tet(), (face.face() + 1) % 4);
  }
  SUBCASE("two neighbours exchanged") {
    std::swap(neighbours[0], neighbours[1]);
  }
  CHECK(finds(mesh, Kind::adjacency));
}

TEST_CASE("vertices that are dead, out of range or repeated in a tet are found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  const TetHandle t = live_tets(mesh)[5];
  SUBCASE("repeated") {
    Access::cell(mesh, t).vertices[1] = mesh.vertices(t)[0];
  }
  SUBCASE("out of range") {
    Access::cell(mesh, t).vertices[1] = VertexHandle(5000);
  }
  SUBCASE("dead") {
    Access::flags(mesh, mesh.vertices(t)[1]) |= Access::kDeleted;
  }
  SUBCASE("another one") {
    // A vertex that the tet does not have.
    std::uint32_t v = 0;
    while (mesh.local_index(t, VertexHandle(v)) != 4) ++v;
    Access::cell(mesh, t).vertices[1] = VertexHandle(v);
  }
  CHECK(finds(mesh, Kind::adjacency));
}

TEST_CASE("a tet whose neighbours lie on its own side is found") {
  TetMesh mesh = make_mesh(zoo_data("two_tets"));
  const HalfFace face = inner_face(mesh);
  // Turns the tet over and lets all faces follow.
  const unsigned a = (face.face() + 1) % 4;
  const unsigned b = (face.face() + 2) % 4;
  auto& cell = Access::cell(mesh, face.tet());
  std::swap(cell.vertices[a], cell.vertices[b]);
  std::swap(cell.neighbours[a], cell.neighbours[b]);
  Access::quality(mesh, face.tet()) = mesh.evaluate(cell.vertices);
  CHECK(finds_only(mesh, Kind::orientation));
}

TEST_CASE("a vertex that names no tet, a wrong tet or a dead tet is found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  const VertexHandle v(3);
  SUBCASE("none") {
    Access::link(mesh, v) = TetHandle();
  }
  SUBCASE("out of range") {
    Access::link(mesh, v) = TetHandle(1u << 20);
  }
  SUBCASE("wrong") {
    std::uint32_t t = 0;
    while (mesh.local_index(TetHandle(t), v) != 4) ++t;
    Access::link(mesh, v) = TetHandle(t);
  }
  CHECK(finds_only(mesh, Kind::vertex_link));
}

TEST_CASE("disagreement of outside faces and surface triangles is found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  const HalfFace face = outer_face(mesh);
  const std::uint32_t k = mesh.twin(face).surface_triangle();
  auto& neighbour = Access::cell(mesh, face.tet()).neighbours[face.face()];
  SUBCASE("no such triangle") {
    neighbour = HalfFace::outside(9999);
  }
  SUBCASE("invalid") {
    neighbour = HalfFace();
  }
  SUBCASE("another triangle") {
    neighbour = HalfFace::outside(k == 0 ? 1 : 0);
  }
  SUBCASE("marked as interior") {
    Access::surface(mesh)[k].interior = true;
  }
  SUBCASE("marked as loose") {
    Access::surface(mesh)[k].loose = true;
  }
  SUBCASE("other vertices") {
    Access::surface(mesh)[k].vertices[0] = inner_vertex(mesh);
  }
  SUBCASE("a triangle too many") {
    Access::surface(mesh).push_back(mesh.surface_triangles()[k]);
  }
  CHECK(finds(mesh, Kind::boundary));
}

TEST_CASE("wrong boundary marks of vertices are found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  const VertexHandle inner = inner_vertex(mesh);
  const VertexHandle outer = mesh.vertices(outer_face(mesh))[0];
  SUBCASE("a mark too many") {
    Access::flags(mesh, inner) |= Access::kBoundary;
  }
  SUBCASE("a mark too few") {
    Access::flags(mesh, outer) = Access::kConstrained;
  }
  CHECK(finds_only(mesh, Kind::boundary));
}

TEST_CASE("labels that meet at a face that is not constrained are found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  Access::label(mesh, TetHandle(4)) = 9;
  CHECK(finds_only(mesh, Kind::label));
}

TEST_CASE("a cached quality that is off by one bit is found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  Quality& quality = Access::quality(mesh, TetHandle(4));
  quality = std::nextafter(quality, 1.0f);
  CHECK(finds_only(mesh, Kind::quality));
}

TEST_CASE("wrong constraint bits are found") {
  SUBCASE("a face without a surface triangle, on both sides") {
    TetMesh mesh = make_mesh(zoo_data("ball_20"));
    const HalfFace face = inner_face(mesh);
    const HalfFace twin = mesh.twin(face);
    Access::flags(mesh, face.tet()) |= static_cast<std::uint16_t>(1u << face.face());
    Access::flags(mesh, twin.tet()) |= static_cast<std::uint16_t>(1u << twin.face());
    CHECK(finds_only(mesh, Kind::constraint));
  }
  SUBCASE("a face of one side only") {
    TetMesh mesh = make_mesh(constrained_face());
    Access::flags(mesh, TetHandle(1)) = 0;
    CHECK(finds_only(mesh, Kind::constraint));
  }
  SUBCASE("an interior triangle that no tet knows") {
    TetMesh mesh = make_mesh(constrained_face());
    Access::flags(mesh, TetHandle(0)) = 0;
    Access::flags(mesh, TetHandle(1)) = 0;
    CHECK(finds_only(mesh, Kind::constraint));
  }
  SUBCASE("a boundary face") {
    TetMesh mesh = make_mesh(one_tet());
    Access::flags(mesh, TetHandle(0)) = 1;
    CHECK(finds_only(mesh, Kind::constraint));
  }
  SUBCASE("an edge that is not marked in all tets of its shell") {
    TetMesh mesh = make_mesh(shell_with_constrained_edge());
    Access::flags(mesh, TetHandle(3)) = 0;
    CHECK(finds_only(mesh, Kind::constraint));
  }
  SUBCASE("a vertex of a constrained edge that is free") {
    MeshData data = zoo_data("ball_60");
    const TetMesh plain = make_mesh(data);
    const VertexHandle v = inner_vertex(plain);
    const TetVertices tv = plain.vertices(plain.tet_of(v));
    const VertexHandle w = tv[0] == v ? tv[1] : tv[0];
    data.edges.push_back({{v.index(), w.index()}, 0});
    TetMesh mesh = make_mesh(data);
    CHECK(check_integrity(mesh).empty());
    Access::flags(mesh, v) = 0;
    CHECK(finds_only(mesh, Kind::constraint));
  }
}

TEST_CASE("wrong marks of frozen tets and their vertices are found") {
  TetMesh mesh = make_mesh(zoo_data("ball_60"));
  mesh.freeze([](TetHandle t) { return t.index() % 20 == 0; });
  REQUIRE(to_string(check_integrity(mesh)) == "");
  const auto set = [&](VertexHandle v, bool frozen) {
    auto& flags = Access::flags(mesh, v);
    flags = static_cast<std::uint8_t>(frozen ? flags | Access::kFrozen : flags & ~Access::kFrozen);
  };
  SUBCASE("a vertex of a frozen tet that is free") {
    set(mesh.vertices(TetHandle(20))[1], false);
    CHECK(finds_only(mesh, Kind::constraint));
  }
  SUBCASE("a vertex of no frozen tet that is marked") {
    const auto vertices = live_vertices(mesh);
    const auto free = std::find_if(vertices.begin(), vertices.end(),
                                   [&](VertexHandle v) { return !mesh.is_frozen(v); });
    REQUIRE(free != vertices.end());
    set(*free, true);
    CHECK(finds_only(mesh, Kind::constraint));
  }
}

TEST_CASE("wrong counts are found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  SUBCASE("tets") {
    ++Access::tet_count(mesh);
  }
  SUBCASE("vertices") {
    --Access::vertex_count(mesh);
  }
  CHECK(finds_only(mesh, Kind::count));
}

TEST_CASE("a tet that vanished without its neighbours is found") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  Access::cell(mesh, TetHandle(4)) = {};
  CHECK(finds(mesh, Kind::adjacency));
  CHECK(finds(mesh, Kind::count));
}

TEST_CASE("findings name the place and stop at the limit") {
  TetMesh mesh = make_mesh(zoo_data("ball_20"));
  for (const TetHandle t : live_tets(mesh)) Access::quality(mesh, t) = 2;
  CHECK(check_integrity(mesh, 10).size() == 10);
  const auto findings = check_integrity(mesh, 1000);
  CHECK(findings.size() == mesh.tet_count());
  CHECK(findings[3].tet == TetHandle(3));
  CHECK(findings[3].message.find("tet 3: the cached quality is 2") == 0);
  CHECK(to_string({findings[0]}).find("quality: tet 0: ") == 0);
}

TEST_CASE("random damage to any array never leads out of bounds") {
  Random random(8);
  const TetMesh sound = make_mesh(zoo_data("two_regions"));
  std::size_t unnoticed = 0;
  for (int round = 0; round < 2000; ++round) {
    TetMesh mesh = sound;
    const TetHandle t(static_cast<std::uint32_t>(random.index(mesh.tet_slots())));
    const VertexHandle v(static_cast<std::uint32_t>(random.index(mesh.vertex_slots())));
    const auto number =
        static_cast<std::uint32_t>(random.index(std::uint64_t{1} << (1 + random.index(32))));
    const std::size_t i = random.index(4);
    switch (random.index(5)) {
      case 0:
        Access::cell(mesh, t).vertices[i] = VertexHandle(number);
        break;
      case 1:
        Access::cell(mesh, t).neighbours[i] = HalfFace::from_code(number);
        break;
      case 2:
        Access::link(mesh, v) = TetHandle(number);
        break;
      case 3:
        Access::surface(mesh)[number % mesh.surface_triangles().size()].vertices[i % 3] =
            VertexHandle(number);
        break;
      default:
        Access::label(mesh, t) = static_cast<Label>(number);
        break;
    }
    unnoticed += check_integrity(mesh).empty();
  }
  // Only damage that writes what was there, or another tet of a vertex.
  CHECK(unnoticed < 200);
}

TEST_CASE("tets that are not positive are counted and no finding") {
  const TetMesh mesh = make_mesh(zoo_data("tangled_ball_60"));
  CHECK(check_integrity(mesh).empty());
  CHECK(count_not_positive(mesh) > 0);
  CHECK(count_not_positive(make_mesh(zoo_data("ball_60"))) == 0);
  CHECK(count_not_positive(make_mesh(zoo_data("flat_tet"))) == 1);
}

TEST_CASE("signs that the statistics of a mesh tell are those of exact arithmetic") {
  for (const char* name : {"ball_60", "cube_3", "tangled_ball_60", "one_tet"}) {
    CAPTURE(name);
    const TetMesh mesh = make_mesh(zoo_data(name));
    CHECK(count_not_positive(mesh, compute_statistics(mesh)) == count_not_positive(mesh));
  }
  MeshData data = one_tet();
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const TetMesh flat = make_mesh(data);
  REQUIRE(compute_statistics(flat).flat == 1);
  CHECK(count_not_positive(flat, compute_statistics(flat)) == 1);
}
