// SPDX-License-Identifier: MIT
// Cavities on an octahedron of four tets: what is taken, what stops them, which place is kept. That
// they are the best is shown by cavity_oracle_test.cpp.
#include "ops/cavity.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Cavities of the tet 0 1 2 3.
struct Site {
  explicit Site(const MeshData& data, const VertexCavity::Limits& limits = {}, double least = 0)
      : worker(data) {
    target = worker.tet({0, 1, 2, 3}).tet();
    cavity.begin(target, least, limits);
  }
  Verdict offer(double x, double y, double z) {
    return cavity.offer(worker.mesh, worker.workspace, Point(x, y, z));
  }

  LoneWorker worker;
  TetHandle target;
  VertexCavity cavity;
};

std::vector<HalfFace> boundary(const TetMesh& mesh) {
  std::vector<HalfFace> faces;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (mesh.is_boundary(HalfFace(t, f))) faces.push_back(HalfFace(t, f));
    }
  }
  return faces;
}

}  // namespace

TEST_CASE("a vertex in the middle of an octahedron takes all tets, the target first") {
  Site site(octahedron(1, 1, 1));
  REQUIRE(site.offer(0, 0, 0) == Verdict::accepted);
  CHECK(site.cavity.tets().size() == 4);
  CHECK(site.cavity.tets()[0] == site.target);
  CHECK(site.cavity.faces().size() == 8);
  // Each new tet is a corner of a cube: three right angles and three of 54.7 degrees.
  CHECK(site.cavity.worst() == doctest::Approx(2 * std::sqrt(2.0 / 3)));
  CHECK(site.cavity.point() == Point(0, 0, 0));
}

TEST_CASE("tets that would make a worse worst tet stay") {
  // The edge 0-1 is short: with a vertex in the target, the faces around it are its good ones.
  Site site(octahedron(0.4, 4, 4));
  REQUIRE(site.offer(1, 1, 0) == Verdict::accepted);
  CHECK(site.cavity.tets().size() == 1);
  CHECK(site.cavity.faces().size() == 4);
}

TEST_CASE("a vertex outside of the mesh has no cavity, and neither has one on the boundary") {
  Site site(octahedron(1, 1, 1));
  CHECK(site.offer(1, 1, 1) == Verdict::no_improvement);
  CHECK(site.offer(0.5, 0.5, 0) == Verdict::no_improvement);
  CHECK(site.cavity.tets().empty());
}

TEST_CASE("a cavity crosses neither constrained faces nor borders of regions nor frozen tets") {
  MeshData faces = octahedron(1, 1, 1);
  MeshData regions = faces;
  faces.triangles = {{{0, 1, 3}, 1}, {{0, 1, 5}, 1}};
  regions.tets[1].label = regions.tets[2].label = 8;
  Site with_faces(faces);
  Site with_regions(regions);
  Site with_frozen(octahedron(1, 1, 1));
  const TetHandle beside = with_frozen.worker.tet({0, 1, 3, 4}).tet();
  const TetHandle opposite = with_frozen.worker.tet({0, 1, 4, 5}).tet();
  with_frozen.worker.mesh.freeze([&](TetHandle t) { return t == beside || t == opposite; });
  for (Site* site : {&with_faces, &with_regions, &with_frozen}) {
    REQUIRE(site->offer(0.3, 0, 0) == Verdict::accepted);
    CHECK(site->cavity.tets().size() == 2);
    CHECK(site->cavity.faces().size() == 6);
    CHECK(site->offer(-0.3, 0, 0) == Verdict::no_improvement);
  }
}

TEST_CASE("a cavity holds no more tets than the limit") {
  for (const std::size_t most : {1u, 2u, 3u}) {
    Site site(octahedron(1, 1, 1), {.max_tets = most});
    CHECK(site.offer(0.2, 0.2, 0) == Verdict::accepted);
    CHECK(site.cavity.tets().size() <= most);
    CHECK(site.cavity.faces().size() == 2 * site.cavity.tets().size() + 2);
  }
}

TEST_CASE("growth ends when the worst new tet is good enough") {
  Site all(octahedron(1, 1, 1));
  REQUIRE(all.offer(0.2, 0.2, 0) == Verdict::accepted);
  REQUIRE(all.cavity.tets().size() == 4);
  Site one(octahedron(1, 1, 1), {.enough = 0.1});
  REQUIRE(one.offer(0.2, 0.2, 0) == Verdict::accepted);
  CHECK(one.cavity.tets().size() < 4);
  CHECK(one.cavity.worst() >= 0.1);
}

TEST_CASE("the best place is kept, in whatever order places come") {
  const Point good(0.05, 0, 0);
  const Point bad(0.4, 0.1, 0.1);
  for (const bool good_first : {true, false}) {
    Site site(octahedron(1, 1, 1));
    CHECK(site.cavity.offer(site.worker.mesh, site.worker.workspace, good_first ? good : bad) ==
          Verdict::accepted);
    CHECK(site.cavity.offer(site.worker.mesh, site.worker.workspace, good_first ? bad : good) ==
          (good_first ? Verdict::no_improvement : Verdict::accepted));
    CHECK(site.cavity.point() == good);
    CHECK(site.cavity.tets().size() == 4);
    CHECK(site.cavity.faces().size() == 8);
  }
}

TEST_CASE("a cavity that is not better than what is asked for is refused") {
  Site site(octahedron(1, 1, 1), {}, 1.64);
  CHECK(site.offer(0, 0, 0) == Verdict::no_improvement);
  CHECK(site.cavity.worst() == 1.64);
  site.cavity.begin(site.target, 1.62, {});
  CHECK(site.offer(0, 0, 0) == Verdict::accepted);
}

TEST_CASE("a cavity that meets what belongs to others is deferred") {
  Site site(octahedron(1, 1, 1));
  site.worker.give_away({4});
  CHECK(site.offer(0, 0, 0) == Verdict::deferred);
}

TEST_CASE("a closed surface is a sphere; with a hole, a pinch or a second part it is none") {
  const TetMesh whole = make_mesh(octahedron(1, 1, 1));
  auto faces = boundary(whole);
  CHECK(is_sphere(whole, faces));
  faces.pop_back();
  CHECK_FALSE(is_sphere(whole, faces));
  for (const MeshData& data : {touching_at_vertex(), touching_at_edge()}) {
    const TetMesh pinched = make_mesh(data);
    CHECK_FALSE(is_sphere(pinched, boundary(pinched)));
  }
  MeshData apart = octahedron(1, 1, 1);
  apart.points.insert(apart.points.end(), {{10, 0, 0}, {11, 0, 0}, {10, 1, 0}, {10, 0, 1}});
  apart.tets.push_back({{6, 7, 8, 9}, 7});
  const TetMesh two = make_mesh(apart);
  CHECK_FALSE(is_sphere(two, boundary(two)));
}
