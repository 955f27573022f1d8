// SPDX-License-Identifier: MIT
// How a polyhedron grows in a mesh: which tets it takes, what it does not cross, what its surface
// is.
#include "ops/polyhedron.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "kernel/star.h"
#include "kernel/workspace.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The corners of the surface as vertices of the mesh, each triangle from its lowest vertex on.
std::set<std::array<std::uint32_t, 3>> surface_vertices(const Polyhedron& polyhedron) {
  std::set<std::array<std::uint32_t, 3>> all;
  for (const auto& triangle : polyhedron.surface()) {
    std::array<std::uint32_t, 3> corners{};
    for (unsigned i = 0; i < 3; ++i) corners[i] = polyhedron.vertices()[triangle[i]].index();
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.insert(corners);
  }
  return all;
}

/// The same from the tets alone.
std::set<std::array<std::uint32_t, 3>> faces_without_twin(const TetMesh& mesh,
                                                          std::span<const TetHandle> tets) {
  std::set<std::array<std::uint32_t, 3>> open;
  for (const TetHandle t : tets) {
    for (unsigned f = 0; f < 4; ++f) {
      const auto v = mesh.vertices(HalfFace(t, f));
      std::array<std::uint32_t, 3> corners = {v[0].index(), v[1].index(), v[2].index()};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      if (open.erase({corners[0], corners[2], corners[1]}) == 0) open.insert(corners);
    }
  }
  return open;
}

std::set<std::uint32_t> indices(std::span<const VertexHandle> vertices) {
  std::set<std::uint32_t> all;
  for (const VertexHandle v : vertices) all.insert(v.index());
  return all;
}

}  // namespace

TEST_CASE("a polyhedron starts as one tet and takes in the tets around it vertex by vertex") {
  LoneWorker worker(octahedron(1, 1, 1));
  Polyhedron polyhedron;
  polyhedron.start(worker.mesh, worker.tet({0, 1, 2, 3}).tet());
  CHECK(polyhedron.tets().size() == 1);
  CHECK(indices(polyhedron.vertices()) == std::set<std::uint32_t>{0, 1, 2, 3});
  CHECK(polyhedron.surface().size() == 4);
  CHECK(polyhedron.inside() == 0);

  REQUIRE(polyhedron.grow(worker.mesh, worker.workspace, 32));
  CHECK(polyhedron.tets().size() == 2);
  CHECK(polyhedron.vertices().size() == 5);
  REQUIRE(polyhedron.grow(worker.mesh, worker.workspace, 32));  // the last vertex makes two tets
  CHECK(polyhedron.tets().size() == 4);
  CHECK(polyhedron.surface().size() == 8);
  CHECK(polyhedron.inside() == 0);
  CHECK_FALSE(polyhedron.grow(worker.mesh, worker.workspace, 32));
}

TEST_CASE("growth ends at the limit") {
  LoneWorker worker(octahedron(1, 1, 1));
  Polyhedron polyhedron;
  polyhedron.start(worker.mesh, worker.tet({0, 1, 2, 3}).tet());
  CHECK(polyhedron.grow(worker.mesh, worker.workspace, 5));
  CHECK_FALSE(polyhedron.grow(worker.mesh, worker.workspace, 5));
  CHECK(polyhedron.vertices().size() == 5);
}

TEST_CASE("the surface is what has no twin, and vertices off it are inside") {
  LoneWorker worker(delaunay_ball(200, 3));
  std::size_t with_inside = 0;
  for (const TetHandle t : live_tets(worker.mesh)) {
    Polyhedron polyhedron;
    polyhedron.start(worker.mesh, t);
    while (polyhedron.grow(worker.mesh, worker.workspace, Polyhedron::kMaxVertices)) {
    }
    REQUIRE(polyhedron.vertices().size() == Polyhedron::kMaxVertices);
    REQUIRE(surface_vertices(polyhedron) == faces_without_twin(worker.mesh, polyhedron.tets()));
    std::set<std::uint32_t> corners;
    for (const TetHandle member : polyhedron.tets()) {
      for (const VertexHandle v : worker.mesh.vertices(member)) corners.insert(v.index());
    }
    REQUIRE(corners == indices(polyhedron.vertices()));
    for (std::size_t n = 0; n < polyhedron.vertices().size(); ++n) {
      const auto ball = star(worker.mesh, polyhedron.vertices()[n]);
      const bool whole = std::all_of(ball.begin(), ball.end(), [&](TetHandle member) {
        const auto tets = polyhedron.tets();
        return std::find(tets.begin(), tets.end(), member) != tets.end();
      });
      const bool inside = whole && !worker.mesh.is_boundary(polyhedron.vertices()[n]);
      REQUIRE((polyhedron.inside() >> n & 1u) == inside);
      with_inside += inside;
    }
  }
  CHECK(with_inside > 100);
}

TEST_CASE("a polyhedron does not cross constrained faces, nor go around them") {
  MeshData faces = octahedron(1, 1, 1);
  faces.triangles = {{{0, 1, 3}, 1}};
  LoneWorker worker(faces);
  Polyhedron polyhedron;
  polyhedron.start(worker.mesh, worker.tet({0, 1, 2, 3}).tet());
  while (polyhedron.grow(worker.mesh, worker.workspace, 32)) {
  }
  // The tet behind the face is reached from the other side, but would enclose it.
  CHECK(polyhedron.tets().size() == 3);
}

TEST_CASE("a polyhedron keeps to its region and leaves frozen tets out") {
  MeshData regions = octahedron(1, 1, 1);
  regions.tets[1].label = regions.tets[2].label = 8;
  LoneWorker worker(regions);
  Polyhedron polyhedron;
  polyhedron.start(worker.mesh, worker.tet({0, 1, 2, 3}).tet());
  while (polyhedron.grow(worker.mesh, worker.workspace, 32)) {
  }
  CHECK(polyhedron.tets().size() == 2);

  LoneWorker frozen(octahedron(1, 1, 1));
  const TetHandle cold = frozen.tet({0, 1, 3, 4}).tet();
  frozen.mesh.freeze([&](TetHandle t) { return t == cold; });
  polyhedron.start(frozen.mesh, frozen.tet({0, 1, 2, 3}).tet());
  while (polyhedron.grow(frozen.mesh, frozen.workspace, 32)) {
  }
  CHECK(polyhedron.tets().size() == 3);
}

TEST_CASE("growth stops before a vertex that belongs to others, and that is noted") {
  LoneWorker worker(octahedron(1, 1, 1));
  worker.give_away({4, 5});
  worker.workspace.forget_border();
  Polyhedron polyhedron;
  polyhedron.start(worker.mesh, worker.tet({0, 1, 2, 3}).tet());
  CHECK_FALSE(polyhedron.grow(worker.mesh, worker.workspace, 32));
  CHECK(worker.workspace.met_border());
}

TEST_CASE("the ball of a vertex is a polyhedron without that vertex, unless it is too large") {
  LoneWorker worker(delaunay_ball(200, 3));
  std::size_t balls = 0;
  for (const VertexHandle v : live_vertices(worker.mesh)) {
    if (worker.mesh.is_boundary(v)) continue;
    const auto around = link(worker.mesh, v);
    Polyhedron polyhedron;
    REQUIRE(polyhedron.start_at_ball(worker.mesh, around));
    CHECK(polyhedron.tets().size() == around.size());
    CHECK(polyhedron.surface().size() == around.size());
    CHECK(surface_vertices(polyhedron) == faces_without_twin(worker.mesh, polyhedron.tets()));
    CHECK(indices(polyhedron.vertices()).count(v.index()) == 0);
    CHECK(polyhedron.inside() == 0);
    ++balls;
  }
  CHECK(balls > 20);
  // A shell of 40 tets, split at its edge: that vertex has 42 neighbours.
  MeshData large = shell_mesh({.degree = 40});
  const std::uint32_t middle = static_cast<std::uint32_t>(large.points.size());
  large.points.push_back({0, 0, 0});
  const auto old_tets = large.tets;
  large.tets.clear();
  for (auto tet : old_tets) {
    for (const std::uint32_t end : {0u, 1u}) {
      auto half = tet;
      std::replace(half.vertices.begin(), half.vertices.end(), end, middle);
      large.tets.push_back(half);
    }
  }
  LoneWorker crowded(large);
  Polyhedron polyhedron;
  CHECK_FALSE(polyhedron.start_at_ball(crowded.mesh, link(crowded.mesh, VertexHandle(middle))));
}

TEST_CASE("tets that overlap in a folded mesh are not embedded") {
  for (const double lift : {0.2, -0.2}) {
    LoneWorker worker(middle_tet(lift));
    SideTable table;
    Polyhedron polyhedron;
    polyhedron.start(worker.mesh, live_tets(worker.mesh)[0]);
    while (polyhedron.grow(worker.mesh, worker.workspace, 32)) {
    }
    for (const VertexHandle v : polyhedron.vertices()) table.add(worker.mesh.point(v));
    CHECK(polyhedron.is_embedded(worker.mesh, table) == (lift > 0));
  }
}
