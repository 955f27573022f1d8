// SPDX-License-Identifier: MIT
// Lengths by place: against a search of all vertices.
#include "kernel/size_field.h"

#include <algorithm>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "kernel/tet_mesh.h"

using namespace tetmend;
using namespace tetmend::contract;

namespace {

double nearest_length(const TetMesh& mesh, const std::vector<double>& lengths, const Point& p) {
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double distance = (mesh.point(VertexHandle(static_cast<std::uint32_t>(i))) - p).norm();
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return lengths[best];
}

}  // namespace

TEST_CASE("the local length of a place is that of the nearest vertex") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  for (const MeshData& data : {delaunay_ball(300, 5), kuhn_cube(4, 0, 1)}) {
    const TetMesh mesh(data);
    const UsualLengths field(mesh);
    const std::vector<double> lengths = local_lengths(mesh);
    for (int i = 0; i < 2000; ++i) {
      const Point p(coordinate(random), coordinate(random), coordinate(random));
      CHECK(field.length(p) == nearest_length(mesh, lengths, p));
    }
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
      CHECK(field.length(mesh.point(VertexHandle(v))) == lengths[v]);
    }
  }
}

TEST_CASE("the local length of a vertex is the mean over the edges of its tets") {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  data.tets = {{{0, 1, 2, 3}, 0}};
  CHECK(local_lengths(TetMesh(data))[0] == doctest::Approx(2));
}

TEST_CASE("an edge is admitted from half to twice the local length at its midpoint") {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.75 / 0.8660254037844386, 0}, {0.5, 0.3, 0.8}};
  data.tets = {{{0, 1, 2, 3}, 0}};
  const TetMesh mesh(data);
  const UsualLengths field(mesh);
  const double usual = field.length({0, 0, 0});
  const auto admits = [&](double length) {
    const std::vector<EdgePlaces> now = {{Point(-length / 2, 0, 0), Point(length / 2, 0, 0)}};
    return field.admits({}, now);
  };
  CHECK(admits(usual));
  CHECK(admits(0.501 * usual));
  CHECK_FALSE(admits(0.499 * usual));
  CHECK_FALSE(admits(2.001 * usual));
}
