// SPDX-License-Identifier: MIT
// Insertion at the centroid on meshes with small whole coordinates: what gives way, and what does
// not.
#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "tests/ops/insertions.h"
#include "tests/support/lone_worker.h"
#include "tests/support/octahedron.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Verdict insert_at_centroid(LoneWorker& worker, const Corners& tet,
                           const ParameterSettings& settings = {}) {
  return worker.attempt("centroid_insertion", worker.tet(tet), settings);
}

// 2 ------------- 01 ------------- 3     A short edge 0-1 near the middle of a long edge 2-3, which
//                                        it nearly touches: one of the few tets that four pieces
//                                        beat.
MeshData needle() {
  MeshData data;
  data.points = {{-2, 0, 0}, {-2, 0, -1}, {-32, -1, -1}, {40, 1, 0}};
  data.tets = {{{0, 1, 2, 3}, 7}};
  return data;
}

}  // namespace

TEST_CASE("a lone needle is replaced by four tets around its centroid") {
  LoneWorker worker(needle());
  const Quality before = worker.worst();
  REQUIRE(insert_at_centroid(worker, {0, 1, 2, 3}, kUnsmoothed) == Verdict::accepted);
  CHECK(worker.tets() == std::set<Corners>{{0, 1, 2, 4}, {0, 1, 3, 4}, {0, 2, 3, 4}, {1, 2, 3, 4}});
  CHECK(worker.mesh.point(VertexHandle(4)) == Point(1, 0, -0.5));
  CHECK(worker.worst() > before);
  CHECK_FALSE(worker.mesh.is_fixed(VertexHandle(4)));
  for (const TetHandle t : live_tets(worker.mesh)) CHECK(worker.mesh.label(t) == 7);
}

TEST_CASE("all tets whose circumspheres hold the centroid give way") {
  LoneWorker worker(octahedron(3, 1, 1));
  worker.mesh.set_standard(kSine);
  const Quality before = worker.worst();
  REQUIRE(insert_at_centroid(worker, {0, 1, 2, 3}, kUnsmoothed) == Verdict::accepted);
  CHECK(worker.tets() == kAround6);
  CHECK(worker.mesh.point(VertexHandle(6)) == Point(0.25, 0.25, 0));
  CHECK(worker.worst() > before);
}

TEST_CASE("smoothing moves the new vertex to a better place before it is judged") {
  LoneWorker plain(octahedron(3, 1, 1));
  LoneWorker smoothed(octahedron(3, 1, 1));
  for (LoneWorker* worker : {&plain, &smoothed}) worker->mesh.set_standard(kSine);
  REQUIRE(insert_at_centroid(plain, {0, 1, 2, 3}, kUnsmoothed) == Verdict::accepted);
  REQUIRE(insert_at_centroid(smoothed, {0, 1, 2, 3}) == Verdict::accepted);
  CHECK(smoothed.tets() == kAround6);
  CHECK(smoothed.mesh.point(VertexHandle(6)).norm() < 0.05);  // the best place is the middle
  CHECK(smoothed.worst() > plain.worst());
}

TEST_CASE("a tet stays when the new vertex does not see the face behind it") {
  // The circumsphere of 0 2 3 4 holds the centroid, but 4 lies far to the left, behind the face.
  MeshData data = needle();
  data.points.push_back({-45, -9, -9});
  data.tets.push_back({{0, 2, 3, 4}, 7});
  LoneWorker worker(data);
  REQUIRE(insert_at_centroid(worker, {0, 1, 2, 3}, kUnsmoothed) == Verdict::accepted);
  CHECK(worker.tets() ==
        std::set<Corners>{{0, 2, 3, 4}, {0, 1, 2, 5}, {0, 1, 3, 5}, {0, 2, 3, 5}, {1, 2, 3, 5}});
}

TEST_CASE("no more than max_tets give way") {
  for (const int most : {1, 2, 3}) {
    CAPTURE(most);
    LoneWorker worker(octahedron(3, 1, 1));
    const bool taken =
        insert_at_centroid(worker, {0, 1, 2, 3}, {{"max_tets", most}}) == Verdict::accepted;
    std::size_t old_tets = 0;
    for (const Corners& tet : worker.tets()) old_tets += tet[3] < 6 ? 1 : 0;
    CHECK(old_tets == static_cast<std::size_t>(taken ? 4 - most : 4));
  }
  LoneWorker worker(octahedron(3, 1, 1));
  REQUIRE(insert_at_centroid(worker, {0, 1, 2, 3}, {{"max_tets", 4}}) == Verdict::accepted);
  CHECK(worker.tets() == kAround6);
}

TEST_CASE("a better worst tet is not worth many new bad ones, unless it is desperate") {
  MeshData faces = octahedron(2, 3, 1);
  faces.points[5].y() = -2;
  faces.triangles = {{{0, 1, 3}, 1}, {{0, 1, 5}, 1}};
  LoneWorker worker(faces);
  CHECK(worker.worst() > kDesperate);
  CHECK(insert_at_centroid(worker, {0, 1, 2, 3}) == Verdict::no_improvement);
  CHECK(insert_at_centroid(worker, {0, 1, 2, 3}, {{"desperate", 2}}) == Verdict::accepted);
}

TEST_CASE("the cavity ends at constrained faces and at other regions") {
  MeshData faces = octahedron(2, 3, 1);
  faces.points[5].y() = -2;
  MeshData regions = faces;
  faces.triangles = {{{0, 1, 3}, 1}, {{0, 1, 5}, 1}};
  regions.tets[1].label = regions.tets[2].label = 8;
  const std::set<Corners> half = {{0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 3, 6}, {0, 1, 5, 6},
                                  {0, 2, 3, 6}, {0, 2, 5, 6}, {1, 2, 3, 6}, {1, 2, 5, 6}};
  for (const MeshData& data : {faces, regions}) {
    LoneWorker worker(data);
    REQUIRE(insert_at_centroid(worker, {0, 1, 2, 3}, {{"desperate", 2}}) == Verdict::accepted);
    CHECK(worker.tets() == half);
  }
}

TEST_CASE("a constrained edge inside the cavity is kept: the insertion is refused") {
  MeshData data = octahedron(3, 1, 1);
  data.edges.push_back({{0, 1}, 1});
  LoneWorker worker(data);
  CHECK(insert_at_centroid(worker, {0, 1, 2, 3}) == Verdict::constrained);
}

TEST_CASE("a regular tet is not divided") {
  LoneWorker worker(one_tet());
  CHECK(insert_at_centroid(worker, {0, 1, 2, 3}) == Verdict::no_improvement);
}

TEST_CASE("a flat or inverted tet has no inside to insert a vertex into") {
  for (const double lift : {0.0, -0.1}) {
    LoneWorker worker(middle_tet(lift));
    CHECK(insert_at_centroid(worker, {0, 1, 2, 3}) == Verdict::not_applicable);
  }
}

TEST_CASE("an insertion is deferred when the cavity may reach what belongs to others") {
  LoneWorker worker(octahedron(3, 1, 1));
  worker.workspace.provide(worker.mesh, 8, 1);
  worker.give_away({4});
  CHECK(insert_at_centroid(worker, {0, 1, 2, 3}) == Verdict::deferred);
}

TEST_CASE("an insertion is deferred when the territory has no free slot for a vertex") {
  LoneWorker worker(octahedron(3, 1, 1));
  worker.give_away({});
  CHECK(insert_at_centroid(worker, {0, 1, 2, 3}) == Verdict::deferred);
}
