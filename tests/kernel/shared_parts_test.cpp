// SPDX-License-Identifier: MIT
#include "kernel/shared_parts.h"

#include <numeric>

#include <doctest/doctest.h>

#include "tests/support/mixed_mesh.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::vector<std::uint32_t> unchanged(const MeshData& data) {
  std::vector<std::uint32_t> map(data.points.size());
  std::iota(map.begin(), map.end(), 0U);
  return map;
}

OtherElements element(int type, std::vector<std::uint32_t> vertices) {
  OtherElements others;
  others.vtk_type = type;
  others.vertex_count = vertices.size();
  others.vertices = std::move(vertices);
  others.labels = {0};
  return others;
}

/// Two tets on either side of the triangle 0, 1, 2.
MeshData two_tets_at_prism() {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {5, 5, 5}};
  data.tets = {{{0, 1, 2, 3}, 0}, {{0, 2, 1, 4}, 0}};
  return data;
}

}  // namespace

TEST_CASE("tets share with a bed of other elements all faces, edges and points that lie on it") {
  for (const Bed bed : {Bed::wedges, Bed::pyramids, Bed::hexahedra, Bed::quads}) {
    CAPTURE(static_cast<int>(bed));
    const MeshData data = tets_on(bed, 3, 1);
    const SharedParts shared = find_shared_parts(data);
    CHECK(shared.faces == faces_on_bed(data));
    CHECK(shared.faces.size() == 18);
    CHECK(shared.edges.size() == 33);
    CHECK(shared.points.size() == 16);
    const SharedParts inside = find_shared_inside(data, shared);
    CHECK(inside.size() == 0);
    CHECK(count_lost_parts(data, unchanged(data), data) == 0);
  }
}

TEST_CASE("points share themselves alone, and a chain its edges") {
  MeshData data = two_tets_at_prism();
  data.other_elements = {element(1, {0}), element(2, {1, 2, 3, 4})};
  CHECK(find_shared_parts(data).points == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  CHECK(find_shared_parts(data).edges.empty());
  data.other_elements = {element(4, {1, 3, 2})};
  CHECK(find_shared_parts(data).edges == std::vector<std::array<std::uint32_t, 2>>{{1, 3}, {2, 3}});
  CHECK(find_shared_parts(data).faces.empty());
}

TEST_CASE("what lies between tets of one region is held, and walls are not named anew") {
  MeshData data = two_tets_at_prism();
  data.other_elements = {element(13, {0, 1, 2, 5, 5, 5})};  // only its triangle counts
  MeshData held = data;
  hold_shared_inside(held);
  REQUIRE(held.triangles.size() == 1);
  CHECK(held.triangles[0].vertices == std::array<std::uint32_t, 3>{0, 1, 2});
  CHECK(held.edges.empty());  // all lie on the boundary
  hold_shared_inside(held);
  CHECK(held.triangles.size() == 1);
  data.tets[1].label = 1;
  hold_shared_inside(data);
  CHECK(data.triangles.empty());
}

TEST_CASE("a shared face that no tet has any more, and a point that moved, are counted") {
  const MeshData data = tets_on(Bed::wedges, 3, 1);
  MeshData torn = data;
  const auto at_bed = [&](const MeshData::Tet& tet) {
    return std::count_if(tet.vertices.begin(), tet.vertices.end(),
                         [&](std::uint32_t v) { return data.points[v].z() == 0.1; });
  };
  const auto found = std::find_if(torn.tets.begin(), torn.tets.end(),
                                  [&](const MeshData::Tet& tet) { return at_bed(tet) == 3; });
  torn.tets.erase(found);
  CHECK(count_lost_parts(data, unchanged(data), torn) == 1);
  MeshData moved = data;
  moved.points[0].x() += 1e-9;
  CHECK(count_lost_parts(data, unchanged(data), moved) == 1);
}
