// SPDX-License-Identifier: MIT
#include "viewer/document.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

TEST_CASE("a mesh in the same place keeps the view, another one does not") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  s.document.view.camera.orbit(100, 20);
  const Camera turned = s.document.view.camera;
  s.document.set_mesh(TetMesh(test::kuhn_cube(3, 0, 1)), "finer");
  CHECK(s.document.view.camera == turned);
  s.document.set_mesh(TetMesh(test::one_tet()), "elsewhere");
  CHECK(s.document.view.camera.yaw == Camera::kHomeYaw);
  CHECK(s.document.view.camera.target != turned.target);
}

TEST_CASE("a file that cannot be opened leaves everything as it was") {
  TestSession s(test::one_tet());
  const test::TempFolder folder;
  CHECK_THROWS_AS(s.document.open(folder / "missing.mesh"), Error);
  MeshData empty = test::one_tet();
  empty.tets.clear();
  write_mesh(folder / "empty.mesh", empty);
  CHECK_THROWS_WITH_AS(s.document.open(folder / "empty.mesh"),
                       doctest::Contains("empty.mesh: the mesh has no tet"), Error);
  CHECK(s.document.mesh().tet_count() == 1);
  CHECK(s.document.file() == "test.mesh");
}

TEST_CASE("saving keeps what the file holds beside its mesh, and says what a format cannot hold") {
  const test::TempFolder folder;
  MeshData mesh = test::kuhn_cube(2, 0.1, 1);
  write_mesh(folder / "plain.vtu", mesh);
  mesh.point_data = {{"heat", 1, std::vector<double>(mesh.points.size(), 1.0)}};
  write_mesh(folder / "a.vtu", mesh);
  TestSession s(test::one_tet());
  s.document.open(folder / "a.vtu");
  s.document.save(folder / "b.vtu");
  CHECK_FALSE(s.document.message.is_error);
  REQUIRE(read_mesh(folder / "b.vtu").point_data.size() == 1);
  CHECK(read_mesh(folder / "b.vtu").point_data[0].name == "heat");
  s.document.save(folder / "b.mesh");
  CHECK(s.document.message.text.find("; ") != std::string::npos);
  CHECK(s.document.message.is_error);
  s.document.open(folder / "plain.vtu");
  s.document.save(folder / "b.vtu");
  CHECK_FALSE(s.document.message.is_error);
}

TEST_CASE("the list of the worst leads from tet to tet, and around") {
  TestSession s(test::delaunay_ball(100, 1));
  const auto worst = s.document.worst();
  CHECK(s.run("worst", {2}) == worst[1].index());
  CHECK(std::get<TetHandle>(s.document.selection()) == worst[1]);
  s.run("previous_worst");
  s.run("previous_worst");
  CHECK(std::get<TetHandle>(s.document.selection()) == worst.back());
  s.run("next_worst");
  CHECK(std::get<TetHandle>(s.document.selection()) == worst.front());
  const nlohmann::json at = s.run("locate");
  CHECK(static_cast<double>(at["x"]) == doctest::Approx(200).epsilon(0.02));
  CHECK(static_cast<double>(at["y"]) == doctest::Approx(150).epsilon(0.02));
  CHECK_THROWS_AS(s.run("worst", {101}), Error);
}

TEST_CASE("the statistics of another mesh stand beside") {
  TestSession s(test::one_tet());
  const test::TempFolder folder;
  write_mesh(folder / "before.mesh", test::two_tets());
  s.document.compare_with(folder / "before.mesh");
  REQUIRE(s.document.statistics_before());
  CHECK(s.document.statistics_before()->tets == 2);
  CHECK(s.document.statistics().tets == 1);
}

TEST_CASE("a scene is made again only when something it shows has changed") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  const unsigned first = s.document.scene_revision();
  s.document.view.camera.orbit(10, 10);
  s.document.view.theme = "dark";
  CHECK(s.document.scene_revision() == first);
  s.document.view.scene.peel = 1;
  CHECK(s.document.scene_revision() != first);
}

TEST_CASE("a folder, an empty trace and a file that is none are told as what they are") {
  const test::TempFolder folder;
  Document document;
  CHECK_THROWS_WITH_AS(document.open(folder / "."), doctest::Contains("this is a folder"), Error);
  std::ofstream(folder / "a.trace").flush();
  CHECK_THROWS_WITH_AS(document.open(folder / "a.trace"),
                       doctest::Contains("a.trace: the file is empty"), Error);
  std::ofstream(folder / "b.trace") << "nonsense that is long enough";
  CHECK_THROWS_WITH_AS(document.open(folder / "b.trace"), doctest::Contains("this is no trace"),
                       Error);
}

TEST_CASE("a mirrored mesh is told of") {
  const test::TempFolder folder;
  MeshData mesh = test::kuhn_cube(2, 0, 1);
  write_mesh(folder / "right.mesh", mesh);
  for (auto& tet : mesh.tets) std::swap(tet.vertices[0], tet.vertices[1]);
  write_mesh(folder / "mirrored.mesh", mesh);
  Document document;
  document.open(folder / "mirrored.mesh");
  REQUIRE(document.notes().size() == 1);
  CHECK(document.notes()[0].starts_with("the mesh was mirrored"));
  CHECK(document.message.text.find("mirrored:") != std::string::npos);
  document.open(folder / "right.mesh");
  CHECK(document.notes().empty());
}

TEST_CASE("elements that are dropped and parts that are not joined are told of") {
  const test::TempFolder folder;
  MeshData mesh = test::kuhn_cube(2, 0, 1);
  const MeshData other = mesh;  // a second cube beside it
  for (const Point& p : other.points) mesh.points.push_back(p + Point(1, 0, 0));
  for (MeshData::Tet tet : other.tets) {
    for (std::uint32_t& v : tet.vertices) v += static_cast<std::uint32_t>(other.points.size());
    mesh.tets.push_back(tet);
  }
  mesh.tets.push_back(mesh.tets[5]);
  write_mesh(folder / "a.mesh", mesh);
  Document document;
  document.open(folder / "a.mesh");
  REQUIRE(document.notes().size() == 2);
  CHECK(document.notes()[0].ends_with("is tet 6 again: dropped"));
  CHECK(document.notes()[1].starts_with("9 of 54 points lie on others and are not joined"));
}

TEST_CASE("what has given vertices is found, and what the mesh has not is not") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  const TetMesh& mesh = s.document.mesh();
  const TetVertices tet = mesh.vertices(TetHandle(5));
  const Document& document = s.document;
  CHECK(document.selection_of(tet) == viewer::Selection(TetHandle(5)));
  const std::array edge = {tet[2], tet[0]};
  const viewer::Selection found = document.selection_of(edge);
  REQUIRE(std::holds_alternative<TetEdge>(found));
  const auto vertices = document.pointed_selection(found).vertices;
  CHECK(std::is_permutation(vertices.begin(), vertices.end(), edge.begin()));
  const std::array face = {tet[3], tet[1], tet[0]};
  REQUIRE(std::holds_alternative<HalfFace>(document.selection_of(face)));
  const std::array twice = {tet[1], tet[1]};
  CHECK(document.selection_of(twice) == viewer::Selection());
  const std::array vertex = {tet[1]};
  CHECK(document.selection_of(vertex) == viewer::Selection(tet[1]));
  const std::array far = {VertexHandle(0), VertexHandle(26)};  // opposite corners of two cells
  CHECK(document.selection_of(far) == viewer::Selection());
  const std::array gone = {VertexHandle(999)};
  CHECK(document.selection_of(gone) == viewer::Selection());
  CHECK(document.selection_of({}) == viewer::Selection());
}

TEST_CASE("a window reads a file in the background, and what cannot be read is told") {
  TestSession s(test::one_tet());
  const test::TempFolder folder;
  Document& document = s.document;
  document.opens_in_background = true;
  write_mesh(folder / "large.meshb", test::kuhn_cube(24, 0.3, 1));
  document.begin_to_open(folder / "large.meshb");
  if (document.opening() != nullptr) {  // it takes longer than nobody minds
    CHECK(document.opening()->file() == folder / "large.meshb");
    CHECK_FALSE(document.opening()->stage().empty());
    CHECK(document.mesh().tet_count() == 1);
    CHECK_THROWS_AS(document.begin_to_open(folder / "large.meshb"), Error);
    document.follow_opening(600);
  }
  CHECK(document.opening() == nullptr);
  CHECK(document.mesh().tet_count() == 6 * 24 * 24 * 24);
  const auto open_missing = [&] {
    document.begin_to_open(folder / "missing.mesh");
    document.follow_opening(600);
  };
  CHECK_THROWS_WITH_AS(open_missing(), doctest::Contains("missing.mesh"), Error);
  CHECK(document.mesh().tet_count() == 6 * 24 * 24 * 24);
  CHECK(document.opening() == nullptr);
}
