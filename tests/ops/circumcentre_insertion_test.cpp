// SPDX-License-Identifier: MIT
// Insertion at the circumcentre on meshes with small whole coordinates: in the target, in another
// tet, behind a wall.
#include <utility>

#include <doctest/doctest.h>

#include "tests/ops/insertions.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Verdict insert_at_circumcentre(LoneWorker& worker, const Corners& tet,
                               const ParameterSettings& settings = {}) {
  return worker.attempt("circumcentre_insertion", worker.tet(tet), settings);
}

/// An octahedron of height 6 with the ring (right, 0), (0, back), (-left, 0), (0, -front).
MeshData uneven_octahedron(double right, double back, double left, double front) {
  MeshData data = octahedron(3, right, back);
  data.points[4].x() = -left;
  data.points[5].y() = -front;
  return data;
}

// The circumcentre of the target is (c(right), c(back), 0) with c(r) = (r^2 - 9) / 2 r.
const MeshData kCentreInTarget = uneven_octahedron(4, 4, 1, 1);   // 7/8, 7/8
const MeshData kCentreOpposite = uneven_octahedron(1, 2, 17, 8);  // -4, -5/4: in 0 1 4 5
const MeshData kCentreOutside = uneven_octahedron(1, 2, 3, 3);

}  // namespace

TEST_CASE("all tets whose circumspheres hold the circumcentre of the target give way to it") {
  for (const auto& [data, centre] : {std::pair(kCentreInTarget, Point(0.875, 0.875, 0)),
                                     std::pair(kCentreOpposite, Point(-4, -1.25, 0))}) {
    LoneWorker worker(data);
    worker.mesh.set_standard(kSine);
    const Quality before = worker.worst();
    REQUIRE(insert_at_circumcentre(worker, kTarget, kUnsmoothed) == Verdict::accepted);
    CHECK(worker.tets() == kAround6);
    CHECK(worker.mesh.point(VertexHandle(6)) == centre);
    CHECK(worker.worst() > before);
    CHECK_FALSE(worker.mesh.is_fixed(VertexHandle(6)));
  }
}

TEST_CASE("smoothing moves the new vertex away from the circumcentre before it is judged") {
  LoneWorker plain(kCentreOpposite);
  LoneWorker smoothed(kCentreOpposite);
  for (LoneWorker* worker : {&plain, &smoothed}) worker->mesh.set_standard(kSine);
  REQUIRE(insert_at_circumcentre(plain, kTarget, kUnsmoothed) == Verdict::accepted);
  REQUIRE(insert_at_circumcentre(smoothed, kTarget) == Verdict::accepted);
  CHECK(smoothed.tets() == kAround6);
  CHECK(smoothed.worst() > plain.worst() + 0.01f);
}

TEST_CASE("a circumcentre outside the mesh is refused") {
  LoneWorker worker(kCentreOutside);
  CHECK(insert_at_circumcentre(worker, kTarget) == Verdict::constrained);
}

TEST_CASE("a circumcentre behind a constrained face or in another region is refused") {
  MeshData faces = kCentreOpposite;
  faces.triangles = {{{0, 1, 3}, 1}, {{0, 1, 5}, 1}};
  MeshData regions = kCentreOpposite;
  regions.tets[1].label = regions.tets[2].label = 8;
  for (const MeshData& data : {faces, regions}) {
    LoneWorker worker(data);
    CHECK(insert_at_circumcentre(worker, kTarget) == Verdict::constrained);
  }
}

TEST_CASE("a target that stays is no reason to insert") {
  // Only the tet opposite may give way.
  LoneWorker worker(kCentreOpposite);
  CHECK(insert_at_circumcentre(worker, kTarget, {{"max_tets", 1}}) == Verdict::no_improvement);
  // In a mesh that is far from Delaunay, a cavity may end before it reaches the target.
  for (const char* name : {"cube_5", "folded_cube_4"}) {
    LoneWorker lattice(zoo_data(name));
    std::size_t accepted = 0;
    for (const Corners& tet : lattice.tets()) {
      if (!lattice.tets().contains(tet)) continue;
      if (insert_at_circumcentre(lattice, tet) != Verdict::accepted) continue;
      ++accepted;
      CHECK_FALSE(lattice.tets().contains(tet));
    }
    CHECK(accepted > 0);
  }
}

TEST_CASE("a flat or inverted tet has no circumcentre to go to") {
  for (const double lift : {0.0, -0.1}) {
    LoneWorker worker(middle_tet(lift));
    CHECK(insert_at_circumcentre(worker, kTarget) == Verdict::not_applicable);
  }
}

TEST_CASE("a circumcentre is not looked for in what belongs to others") {
  LoneWorker worker(kCentreOutside);  // which the walk would find out on the far side
  worker.give_away({4, 5});
  CHECK(insert_at_circumcentre(worker, kTarget) == Verdict::deferred);
}
