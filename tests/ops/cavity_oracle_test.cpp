// SPDX-License-Identifier: MIT
// The growth of a cavity against all sets of tets that hold the target, on small random meshes.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "ops/cavity.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Which tets a set holds, by bits; tets are numbered as in the mesh.
using Mask = std::uint32_t;
constexpr std::size_t kMostTets = 17;

/// The tets that each face makes with a vertex at one point.
struct Surroundings {
  Surroundings(const TetMesh& mesh, const Point& point) : count(mesh.tet_slots()) {
    for (std::uint32_t t = 0; t < count; ++t) {
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace face(TetHandle(t), f);
        const auto [a, b, c] = mesh.vertices(face);
        quality[t][f] = mesh.standard().quality(point, mesh.point(a), mesh.point(b), mesh.point(c));
        behind[t][f] = mesh.is_free(face) ? Mask{1} << mesh.twin(face).tet().index() : 0;
      }
    }
  }
  /// The worst outer face; a face that cannot be crossed always is one.
  double worst(Mask cavity) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < count; ++t) {
      for (unsigned f = 0; f < 4 && (cavity >> t & 1u) != 0; ++f) {
        if ((cavity & behind[t][f]) == 0) least = std::min(least, quality[t][f]);
      }
    }
    return least;
  }
  double best_worst(std::uint32_t target) const {
    double best = -1;
    for (Mask rest = 0; rest < Mask{1} << (count - 1); ++rest) {
      const Mask low = rest & ((Mask{1} << target) - 1);
      best = std::max(best, worst(low | Mask{1} << target | (rest ^ low) << 1));
    }
    return best;
  }

  std::size_t count;
  std::array<std::array<double, 4>, kMostTets> quality{};
  std::array<std::array<Mask, 4>, kMostTets> behind{};
};

Mask mask_of(const VertexCavity& cavity) {
  Mask mask = 0;
  for (const TetHandle t : cavity.tets()) mask |= Mask{1} << t.index();
  return mask;
}

/// A few random points with a Delaunay mesh, with one face named inside for every other seed.
TetMesh random_mesh(std::uint64_t seed, Random& random) {
  MeshData data = delaunay_ball(8, seed);
  if (seed % 2 == 0) {
    const auto& corners = data.tets[random.index(data.tets.size())].vertices;
    data.triangles.push_back({{corners[0], corners[1], corners[2]}, 1});
  }
  return TetMesh(data);
}

}  // namespace

TEST_CASE("no set of tets has a better worst new tet than the cavity that was grown") {
  Random random(7);
  std::size_t none = 0;
  std::array<std::size_t, kMostTets + 1> by_size{};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const TetMesh mesh = random_mesh(seed, random);
    if (mesh.tet_slots() > kMostTets) continue;
    Workspace workspace(mesh);
    for (int round = 0; round < 4; ++round) {
      const auto target = static_cast<std::uint32_t>(random.index(mesh.tet_slots()));
      const Point point = random.in_ball(0.7);
      const Surroundings around(mesh, point);
      const double best = around.best_worst(target);
      VertexCavity cavity;
      cavity.begin(TetHandle(target), 0, {});
      CAPTURE(seed);
      CAPTURE(round);
      if (best <= 0) {
        ++none;
        CHECK(cavity.offer(mesh, workspace, point) == Verdict::no_improvement);
        continue;
      }
      REQUIRE(cavity.offer(mesh, workspace, point) == Verdict::accepted);
      CHECK(cavity.worst() == best);
      CHECK(around.worst(mask_of(cavity)) == best);
      ++by_size[cavity.tets().size()];
    }
  }
  // All kinds of cases have come up.
  CHECK(none > 10);
  CHECK(by_size[1] > 0);
  CHECK(std::count_if(by_size.begin(), by_size.end(), [](std::size_t n) { return n > 0; }) > 6);
}
