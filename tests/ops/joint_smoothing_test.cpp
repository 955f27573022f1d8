// SPDX-License-Identifier: MIT
// Smoothing of all vertices of a tet: what moves, what does not, and that it goes on where single
// vertices are stuck.
#include <algorithm>

#include <doctest/doctest.h>

#include "tests/support/lone_worker.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Verdict smooth(LoneWorker& worker, TetHandle t, const ParameterSettings& settings = {}) {
  return worker.attempt("joint_smoothing", Target::of(t), settings);
}

/// A ball in which no vertex alone can improve its tets.
MeshData smoothed_ball() {
  LoneWorker worker(delaunay_ball(150, 3));
  const ParameterSettings thorough = {{"steps", 1000}, {"least_gain", 1e-5}, {"desperate", 1}};
  for (bool moved = true; moved;) {
    moved = false;
    for (const VertexHandle v : live_vertices(worker.mesh)) {
      moved |= worker.attempt("smoothing", Target::of(v), thorough) == Verdict::accepted;
    }
  }
  return worker.mesh.to_data();
}

}  // namespace

TEST_CASE("where no vertex alone can move, the vertices of a tet together can") {
  LoneWorker worker(smoothed_ball());
  unsigned accepted = 0;
  for (const TetHandle t : live_tets(worker.mesh)) {
    accepted += smooth(worker, t, {{"least_gain", 0.01}}) == Verdict::accepted;
  }
  MESSAGE(accepted, " accepted");
  CHECK(accepted > 3);
}

TEST_CASE("with a goal a tet becomes as good as that and no other gets bad, or nothing moves") {
  LoneWorker worker(delaunay_ball(150, 3));
  const TetMesh& mesh = worker.mesh;
  const auto bad_tets = [&] {
    std::vector<Quality> bad;
    for (const TetHandle t : live_tets(mesh)) {
      if (mesh.quality(t) < kBadThreshold) bad.push_back(mesh.quality(t));
    }
    std::sort(bad.begin(), bad.end());
    return bad;
  };
  unsigned accepted = 0;
  unsigned beyond_good = 0;
  for (const TetHandle t : live_tets(mesh)) {
    const Quality quality = mesh.quality(t);
    const std::vector<Quality> before = bad_tets();
    const MeshData data = mesh.to_data();
    CHECK(smooth(worker, t, {{"goal", 0.99 * quality}}) != Verdict::accepted);
    const Verdict verdict = smooth(worker, t, {{"goal", std::min(quality + 0.04, 1.9)}});
    if (verdict != Verdict::accepted) {
      CHECK(mesh.to_data().points == data.points);
      continue;
    }
    ++accepted;
    if (quality > kBadThreshold) ++beyond_good;
    CHECK(mesh.quality(t) > std::min(quality, kBadThreshold) - 1e-5f);
    const std::vector<Quality> now = bad_tets();
    REQUIRE(now.size() <= before.size());
    for (std::size_t i = 0; i < now.size(); ++i) CHECK(now[i] > before[i] - 1e-5f);
  }
  MESSAGE(accepted, " accepted, ", beyond_good, " of tets that were not bad");
  CHECK(accepted > 10);
  CHECK(beyond_good > 3);
}

TEST_CASE("only free vertices of the tet move, and no tet is replaced") {
  LoneWorker worker(delaunay_ball(100, 3));
  unsigned accepted = 0;
  unsigned several = 0;
  for (const TetHandle t : live_tets(worker.mesh)) {
    const TetMesh before = worker.mesh;
    if (smooth(worker, t) != Verdict::accepted) continue;
    ++accepted;
    unsigned moved = 0;
    for (const VertexHandle v : live_vertices(worker.mesh)) {
      if (worker.mesh.point(v) == before.point(v)) continue;
      ++moved;
      CHECK(worker.mesh.local_index(t, v) < 4);
      CHECK_FALSE(worker.mesh.is_fixed(v));
    }
    CHECK(moved > 0);
    several += moved > 1;
    for (const TetHandle u : live_tets(worker.mesh)) {
      CHECK(worker.mesh.vertices(u) == before.vertices(u));
    }
  }
  CHECK(accepted > 10);
  CHECK(several > 5);
}

TEST_CASE("with a ring, the vertices next to the tet move as well") {
  LoneWorker worker(delaunay_ball(100, 3));
  unsigned accepted = 0;
  unsigned others = 0;
  for (const TetHandle t : live_tets(worker.mesh)) {
    const TetMesh before = worker.mesh;
    if (smooth(worker, t, {{"rings", 1}}) != Verdict::accepted) continue;
    ++accepted;
    for (const VertexHandle v : live_vertices(worker.mesh)) {
      others += worker.mesh.point(v) != before.point(v) && worker.mesh.local_index(t, v) == 4;
    }
  }
  CHECK(accepted > 5);
  CHECK(others > 5);
}

TEST_CASE("a tet without a free vertex is refused, and one around which all is good") {
  LoneWorker lone(one_tet());
  CHECK(smooth(lone, TetHandle(0)) == Verdict::constrained);
  LoneWorker cube(kuhn_cube(2, 0, 1));
  unsigned at_the_middle = 0;
  for (const TetHandle t : live_tets(cube.mesh)) {
    const TetVertices& corners = cube.mesh.vertices(t);
    const bool all_fixed = std::all_of(corners.begin(), corners.end(),
                                       [&](VertexHandle v) { return cube.mesh.is_fixed(v); });
    at_the_middle += !all_fixed;
    CHECK(smooth(cube, t) == (all_fixed ? Verdict::constrained : Verdict::not_applicable));
  }
  CHECK(at_the_middle > 0);
}

TEST_CASE("inverted tets turn over when their vertices find the way back") {
  LoneWorker worker(tangled_ball(60, 4));
  const std::size_t inverted = count_not_positive(worker.mesh);
  REQUIRE(inverted > 0);
  for (const TetHandle t : live_tets(worker.mesh)) {
    if (worker.mesh.quality(t) <= 0) smooth(worker, t, {{"steps", 100}});
  }
  CHECK(count_not_positive(worker.mesh) < inverted);
}
