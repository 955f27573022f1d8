// SPDX-License-Identifier: MIT
// What changes the number of a surface, and what does not.
#include "kernel/surface_fingerprint.h"

#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("the fingerprint stays under inner edits, sorting and garbage collection") {
  TetMesh mesh = make_mesh(two_regions());
  const std::uint64_t print = surface_fingerprint(mesh);
  Workspace workspace(mesh);
  {
    Transaction tx(mesh, workspace);
    const TetHandle t(20);
    const TetVertices v = mesh.vertices(t);
    Point centre = Point::Zero();
    for (const VertexHandle w : v) centre += mesh.point(w) / 4;
    const VertexHandle m = tx.add_vertex(centre);
    std::array<TetVertices, 4> created = {v, v, v, v};
    for (unsigned i = 0; i < 4; ++i) created[i][i] = m;
    REQUIRE(tx.replace_cavity({&t, 1}, created) == EditResult::made);
    tx.keep();
  }
  CHECK(surface_fingerprint(mesh) == print);
  mesh.sort_spatially();
  CHECK(surface_fingerprint(mesh) == print);
  CHECK(surface_fingerprint(TetMesh(mesh.to_data())) == print);
}

TEST_CASE("the fingerprint changes with one bit of a boundary or constraint coordinate") {
  const MeshData data = two_regions();
  const TetMesh mesh(data);
  const std::uint64_t print = surface_fingerprint(mesh);
  for (const std::size_t v : {0u, 13u, 26u}) {  // corner, middle of the border, corner
    for (int axis = 0; axis < 3; ++axis) {
      MeshData changed = data;
      changed.points[v][axis] = std::nextafter(changed.points[v][axis], 2.0);
      CHECK(surface_fingerprint(TetMesh(changed)) != print);
    }
  }
  // Signs of zero are bits as well.
  MeshData negative_zero = data;
  negative_zero.points[0].x() = -0.0;
  CHECK(surface_fingerprint(TetMesh(negative_zero)) != print);
}

TEST_CASE("the fingerprint changes when an inner face becomes a constraint or a tet is missing") {
  CHECK(surface_fingerprint(make_mesh(two_tets())) !=
        surface_fingerprint(make_mesh(constrained_face())));
  MeshData data = zoo_data("ball_20");
  const std::uint64_t print = surface_fingerprint(TetMesh(data));
  data.tets.pop_back();
  CHECK(surface_fingerprint(TetMesh(data)) != print);
}
