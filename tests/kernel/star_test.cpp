// SPDX-License-Identifier: MIT
// Star, link and one-ring against a search through the whole mesh.
#include "kernel/star.h"

#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/shell.h"
#include "kernel/workspace.h"
#include "tests/support/hub.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::set<TetHandle> tets_with(const TetMesh& mesh, VertexHandle v) {
  std::set<TetHandle> found;
  for (const TetHandle t : live_tets(mesh)) {
    if (mesh.local_index(t, v) != 4) found.insert(t);
  }
  return found;
}

}  // namespace

TEST_CASE("star, link and one-ring of every vertex are what a search of the whole mesh finds") {
  for (const char* name : {"ball_60", "cube_3", "two_regions", "tangled_ball_60", "one_tet"}) {
    CAPTURE(name);
    const TetMesh mesh = make_mesh(zoo_data(name));
    Workspace workspace(mesh);
    for (const VertexHandle v : live_vertices(mesh)) {
      const std::set<TetHandle> expected = tets_with(mesh, v);
      const auto tets = star(mesh, v);
      CHECK(tets.size() == expected.size());
      CHECK(std::set<TetHandle>(tets.begin(), tets.end()) == expected);

      const auto faces = link(mesh, v);
      REQUIRE(faces.size() == expected.size());
      for (const HalfFace f : faces) CHECK(mesh.vertices(f.tet())[f.face()] == v);

      std::set<VertexHandle> others;
      for (const TetHandle t : expected) {
        for (const VertexHandle w : mesh.vertices(t)) {
          if (w != v) others.insert(w);
        }
      }
      const auto ring = one_ring(mesh, v);
      CHECK(ring.size() == others.size());
      CHECK(std::set<VertexHandle>(ring.begin(), ring.end()) == others);
    }
  }
}

TEST_CASE("a ring lists its vertices as the faces of the link bring them") {
  for (const char* name : {"ball_60", "two_regions", "tangled_ball_60"}) {
    CAPTURE(name);
    const TetMesh mesh = make_mesh(zoo_data(name));
    Workspace workspace(mesh);
    for (const VertexHandle v : live_vertices(mesh)) {
      std::vector<VertexHandle> expected;
      for (const HalfFace f : link(mesh, v)) {
        for (const VertexHandle w : mesh.vertices(f)) {
          if (std::find(expected.begin(), expected.end(), w) == expected.end()) {
            expected.push_back(w);
          }
        }
      }
      const auto ring = one_ring(mesh, v);
      CHECK(std::vector<VertexHandle>(ring.begin(), ring.end()) == expected);
    }
  }
}

TEST_CASE("a vertex of no tet has an empty star") {
  MeshData data = one_tet();
  data.points.push_back({5, 5, 5});
  const TetMesh mesh = make_mesh(data);
  Workspace workspace(mesh);
  CHECK(star(mesh, VertexHandle(4)).empty());
  CHECK(one_ring(mesh, VertexHandle(4)).empty());
  CHECK_FALSE(find_in_star(mesh, VertexHandle(4), VertexHandle(0), workspace));
}

TEST_CASE("where two balls touch, the star is the fan of the stored tet") {
  const TetMesh mesh = make_mesh(touching_at_vertex());
  Workspace workspace(mesh);
  std::size_t pinched = 0;
  for (const VertexHandle v : live_vertices(mesh)) {
    const std::size_t all = tets_with(mesh, v).size();
    const std::size_t fan = star(mesh, v).size();
    if (fan != all) ++pinched;
    CHECK((fan == all || 2 * fan == all));
  }
  CHECK(pinched == 1);
}

TEST_CASE("an edge is found in the star of its first vertex exactly if it exists") {
  const TetMesh mesh = make_mesh(zoo_data("ball_20"));
  Workspace workspace(mesh);
  for (const VertexHandle a : live_vertices(mesh)) {
    const auto tets = tets_with(mesh, a);
    for (const VertexHandle b : live_vertices(mesh)) {
      const bool exists = a != b && std::any_of(tets.begin(), tets.end(), [&](TetHandle t) {
                            return mesh.local_index(t, b) != 4;
                          });
      const auto edge = find_in_star(mesh, a, b, workspace);
      REQUIRE(edge.has_value() == exists);
      if (!edge) continue;
      const auto [c, d] = mesh.vertices(*edge);
      CHECK(std::minmax(a, b) == std::minmax(c, d));
    }
  }
}

TEST_CASE("a star is found whole up to a size, and given up there") {
  for (const std::uint32_t n : {3u, 100u, std::uint32_t{kMaxStar / 2}, 2500u}) {
    CAPTURE(n);
    const TetMesh mesh = make_mesh(hub(n));
    Workspace workspace(mesh);
    std::vector<HalfFace> found;
    const StarKind kind = find_star(mesh, VertexHandle(0), workspace, found);
    CHECK(kind == (2 * n <= kMaxStar ? StarKind::whole : StarKind::too_large));
    CHECK(found.size() == std::min<std::size_t>(2 * n, kMaxStar));
    CHECK(link(mesh, VertexHandle(0)).size() == 2 * n);
  }
}

TEST_CASE("an edge at a vertex of 5,000 tets is found in the star of its other end") {
  const TetMesh mesh = make_mesh(hub(2500));
  Workspace workspace(mesh);
  for (std::uint32_t i = 3; i < 2503; i += 100) {
    REQUIRE(find_in_star(mesh, VertexHandle(0), VertexHandle(i), workspace));
    CHECK(workspace.search_buffer.size() <= kMaxStar);
  }
  // Both ends have more than the walk looks at first.
  CHECK(find_in_star(mesh, VertexHandle(0), VertexHandle(1), workspace));
  CHECK_FALSE(find_in_star(mesh, VertexHandle(1), VertexHandle(2), workspace));
}
