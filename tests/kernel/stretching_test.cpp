// SPDX-License-Identifier: MIT
// A mesh that is stretched throughout is told from one with slivers.
#include "kernel/stretching.h"

#include <doctest/doctest.h>

#include "tests/support/layered_mesh.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

TetMesh lattice(double height, double jitter) {
  const std::vector<double> unit = axis_of(std::vector<double>(6, 1));
  return TetMesh(make_lattice(unit, unit, axis_of(std::vector<double>(6, height)), jitter));
}

}  // namespace

TEST_CASE("a mesh is stretched throughout when most of its tets are flat and lie alike") {
  for (const double height : {0.02, 0.1}) {
    const Stretching flat = measure_stretching(lattice(height, 0));
    CHECK(flat.tets == 1296);
    CHECK(flat.flat == 1296);
    CHECK(flat.alignment > 0.99);
    CHECK(flat.is_throughout());
  }
  CHECK(measure_stretching(lattice(10, 0)).is_throughout());  // needles are flat, too
  MeshData ball = delaunay_ball(300, 1);
  for (Point& p : ball.points) p.z() /= 20;
  CHECK(measure_stretching(TetMesh(ball)).is_throughout());
}

TEST_CASE("slivers here and there are no stretching") {
  CHECK(measure_stretching(lattice(1, 0)).flat == 0);
  CHECK(!measure_stretching(lattice(1, 0.35)).is_throughout());
  const Stretching ball = measure_stretching(TetMesh(delaunay_ball(300, 2)));
  CHECK(ball.flat > 0);
  CHECK(!ball.is_throughout());
}

TEST_CASE("frozen tets do not count as stretched") {
  TetMesh mesh = lattice(0.1, 0);
  mesh.freeze([](TetHandle t) { return t.index() >= 96; });
  CHECK(measure_stretching(mesh).tets == 96);
  mesh.freeze([](TetHandle) { return true; });
  CHECK(!measure_stretching(mesh).is_throughout());
}
