// SPDX-License-Identifier: MIT
// Surfaces through OpenMesh, and their files.
// clang-format off
#include <OpenMesh/Core/IO/MeshIO.hh>  // before the mesh type, as OpenMesh asks
#include "kernel/surface.h"
// clang-format on

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <unistd.h>

#include "kernel/error.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Point corner(const SurfaceMesh& surface, OpenMesh::VertexHandle v) {
  const auto& p = surface.mesh.point(v);
  return {p[0], p[1], p[2]};
}

struct Measures {
  double volume = 0;
  Point area = Point::Zero();  // sum of the area vectors: 0 for a closed surface
};

Measures measure(const SurfaceMesh& surface) {
  Measures sum;
  for (const auto f : surface.mesh.faces()) {
    std::vector<Point> p;
    for (const auto v : surface.mesh.fv_range(f)) p.push_back(corner(surface, v));
    sum.volume += p[0].dot(p[1].cross(p[2])) / 6;
    sum.area += (p[1] - p[0]).cross(p[2] - p[0]) / 2;
  }
  return sum;
}

bool is_closed(const SurfaceMesh& surface) {
  for (const auto e : surface.mesh.edges()) {
    if (surface.mesh.is_boundary(e)) return false;
  }
  return true;
}

/// The vertices of a surface lie where those of the mesh do, none is without a face, and each
/// triangle has a label.
void check_ties(const TetMesh& mesh, const SurfaceMesh& surface) {
  REQUIRE(surface.vertices.size() == surface.mesh.n_vertices());
  CHECK(surface.labels.size() == surface.mesh.n_faces());
  for (const auto v : surface.mesh.vertices()) {
    CHECK(corner(surface, v) == mesh.point(surface.vertices[static_cast<std::size_t>(v.idx())]));
    CHECK_FALSE(surface.mesh.is_isolated(v));
  }
}

std::size_t boundary_faces(const TetMesh& mesh) {
  std::size_t count = 0;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) count += mesh.is_boundary(HalfFace(t, f));
  }
  return count;
}

/// A folder that vanishes with its contents.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("tetmend_surface_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the boundary of every mesh of the zoo is closed and encloses the mesh's volume") {
  for (const NamedMesh& named : zoo()) {
    CAPTURE(named.name);
    const TetMesh mesh(named.data);
    const SurfaceMesh surface = extract_boundary(mesh);
    CHECK(surface.mesh.n_faces() == boundary_faces(mesh));
    check_ties(mesh, surface);
    CHECK(is_closed(surface));
    const Measures measures = measure(surface);
    CHECK(measures.volume == doctest::Approx(total_volume(mesh)).epsilon(1e-12));
    CHECK(measures.area.norm() < 1e-12);
  }
}

TEST_CASE("vertices are doubled only where the boundary touches itself") {
  const auto doubled = [](const MeshData& data) {
    const TetMesh mesh(data);
    std::size_t vertices = 0;
    for (const VertexHandle v : live_vertices(mesh)) vertices += mesh.is_boundary(v);
    return extract_boundary(mesh).mesh.n_vertices() - vertices;
  };
  CHECK(doubled(touching_at_vertex()) == 1);
  CHECK(doubled(touching_at_edge()) == 2);
  CHECK(doubled(zoo_data("ball_200")) == 0);
  CHECK(doubled(zoo_data("cube_5")) == 0);
}

//     Seen along the edge ab: two wedges of tets with two gaps between them. Three tets below a and
//     three above b join the wedges around one gap without closing it. The boundary then has a
//     single sheet at a and at b, but runs along ab twice: OpenMesh cannot hold that.
TEST_CASE("a sheet that meets itself along an edge loses no triangle") {
  MeshData data = shell_mesh({.degree = 8});
  std::vector<MeshData::Tet> kept;
  for (std::size_t i = 0; i < 8; ++i) {
    if (i % 4 != 0) kept.push_back(data.tets[i]);
  }
  data.tets = kept;
  data.points.push_back({0.9, 0.4, -2});
  data.points.push_back({0.9, 0.4, 2});
  for (const std::uint32_t end : {0u, 1u}) {
    for (const auto& [p, q] : {std::pair(3u, 4u), std::pair(2u, 9u), std::pair(2u, 3u)}) {
      data.tets.push_back({{end, p, q, 10 + end}, 0});
    }
  }
  BuildReport report;
  const TetMesh mesh(data, &report);
  REQUIRE(report.inverted_tets == 0);
  const SurfaceMesh surface = extract_boundary(mesh);
  CHECK(surface.mesh.n_faces() == boundary_faces(mesh));
  CHECK(measure(surface).volume == doctest::Approx(total_volume(mesh)));
  check_ties(mesh, surface);
}

TEST_CASE("labels of named boundary triangles arrive at the surface") {
  MeshData data = one_tet();
  data.triangles.push_back({{0, 1, 2}, 11});
  const SurfaceMesh surface = extract_boundary(make_mesh(data));
  CHECK(std::count(surface.labels.begin(), surface.labels.end(), 11) == 1);
  CHECK(std::count(surface.labels.begin(), surface.labels.end(), 0) == 3);
}

TEST_CASE("the surface between two regions is one sheet, seen from the larger label") {
  const TetMesh mesh = make_mesh(two_regions());
  const SurfaceMesh surface = extract_constraints(mesh);
  CHECK(surface.mesh.n_faces() == 8);
  CHECK(surface.mesh.n_vertices() == 9);
  check_ties(mesh, surface);
  const Point area = measure(surface).area;
  CHECK(area.x() == doctest::Approx(0));
  CHECK(area.y() == doctest::Approx(0));
  CHECK(area.z() == doctest::Approx(1));  // label 2 lies above
}

TEST_CASE("a constraint surface with three sheets at an edge loses no triangle") {
  MeshData data = shell_mesh({.degree = 6});
  for (const std::uint32_t p : {2u, 4u, 6u}) data.triangles.push_back({{0, 1, p}, Label(p)});
  const TetMesh mesh(data);
  const SurfaceMesh surface = extract_constraints(mesh);
  CHECK(surface.mesh.n_faces() == 3);
  CHECK(surface.labels == std::vector<Label>{2, 4, 6});
  check_ties(mesh, surface);
}

TEST_CASE("bad tets are handed out with four outward faces and vertices of their own") {
  const TetMesh mesh = make_mesh(zoo_data("ball_60"));
  const SurfaceMesh surface = extract_bad_faces(mesh, 0.3f);
  std::size_t bad = 0;
  double volume = 0;
  for (const TetHandle t : live_tets(mesh)) {
    if (mesh.quality(t) >= 0.3f) continue;
    ++bad;
    const auto& v = mesh.vertices(t);
    volume += volume6(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])) / 6;
  }
  REQUIRE(bad > 0);
  CHECK(surface.mesh.n_faces() == 4 * bad);
  CHECK(surface.mesh.n_vertices() == 4 * bad);
  CHECK(is_closed(surface));
  CHECK(measure(surface).volume == doctest::Approx(volume));
  check_ties(mesh, surface);
  CHECK(extract_bad_faces(make_mesh(one_tet())).mesh.n_faces() == 0);
}

TEST_CASE("surface files of every format are read back by OpenMesh") {
  const Folder folder;
  const TetMesh mesh = make_mesh(zoo_data("ball_60"));
  const SurfaceMesh surface = extract_boundary(mesh);
  for (const char* extension : {"off", "obj", "ply", "stl", "PLY"}) {
    CAPTURE(extension);
    const auto file = folder / (std::string("ball.") + extension);
    write_surface(file, surface);
    SurfaceMesh read;
    REQUIRE(OpenMesh::IO::read_mesh(read.mesh, file.string()));
    CHECK(read.mesh.n_faces() == surface.mesh.n_faces());
    CHECK(read.mesh.n_vertices() == surface.mesh.n_vertices());
    CHECK(is_closed(read));
    CHECK(measure(read).volume == doctest::Approx(total_volume(mesh)).epsilon(1e-5));
  }
  CHECK(folder.files() == 5);  // no temporary file is left
}

TEST_CASE("coordinates in text formats read back as the same floats") {
  const Folder folder;
  const SurfaceMesh surface = extract_boundary(make_mesh(zoo_data("ball_20")));
  for (const char* name : {"ball.off", "ball.obj", "ball.ply"}) {
    CAPTURE(name);
    write_surface(folder / name, surface);
    SurfaceMesh read;
    REQUIRE(OpenMesh::IO::read_mesh(read.mesh, (folder / name).string()));
    REQUIRE(read.mesh.n_vertices() == surface.mesh.n_vertices());
    for (const auto v : surface.mesh.vertices()) {
      const OpenMesh::Vec3d& written = surface.mesh.point(v);
      const OpenMesh::Vec3d& back = read.mesh.point(v);
      for (unsigned i = 0; i < 3; ++i) {
        CHECK(static_cast<float>(back[i]) == static_cast<float>(written[i]));
      }
    }
  }
}

TEST_CASE("an unknown extension is an error that lists the valid ones, and writes nothing") {
  const Folder folder;
  const SurfaceMesh surface = extract_boundary(make_mesh(one_tet()));
  for (const char* name : {"tet.xyz", "tet", "tet.om"}) {
    try {
      write_surface(folder / name, surface);
      FAIL("written");
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find("valid: .off, .obj, .ply, .stl") != std::string::npos);
    }
  }
  CHECK(folder.files() == 0);
}

TEST_CASE("a surface that cannot be written is an error, and an older file stays") {
  const Folder folder;
  const SurfaceMesh surface = extract_boundary(make_mesh(one_tet()));
  CHECK_THROWS_AS(write_surface(folder / "no_such_folder/tet.off", surface), Error);
  std::filesystem::create_directory(folder / "folder.off");
  CHECK_THROWS_AS(write_surface(folder / "folder.off", surface), Error);
  write_surface(folder / "old.off", surface);
  const std::string old = contents(folder / "old.off");
  write_surface(folder / "old.off", surface);
  CHECK(contents(folder / "old.off") == old);
}

TEST_CASE("extracting and writing prints nothing") {
  std::ostringstream captured;
  std::streambuf* const err = std::cerr.rdbuf(captured.rdbuf());
  std::streambuf* const log = std::clog.rdbuf(captured.rdbuf());
  const Folder folder;
  const SurfaceMesh surface = extract_boundary(make_mesh(touching_at_edge()));
  write_surface(folder / "touching.stl", surface);
  std::cerr.rdbuf(err);
  std::clog.rdbuf(log);
  CHECK(captured.str() == "");
}
