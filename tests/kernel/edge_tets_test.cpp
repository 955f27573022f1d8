// SPDX-License-Identifier: MIT
// Tets at edges against a look at every tet.
#include "kernel/edge_tets.h"

#include <algorithm>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("every tet at each given edge is found once, in the order of the tets") {
  for (const char* name : {"ball_200", "touching_at_vertex", "touching_at_edge", "cube_5"}) {
    CAPTURE(name);
    const TetMesh mesh(zoo_data(name));
    std::set<EdgeEnds> chosen;
    for (const TetHandle t : live_tets(mesh)) {
      if (t.index() % 5 != 0) continue;
      for (const unsigned e : {0u, 3u}) {
        const auto ends = mesh.vertices(TetEdge(t, e));
        chosen.insert(edge_ends(ends[0], ends[1]));
      }
    }
    chosen.insert({VertexHandle(0), VertexHandle(0)});  // no edge
    const std::vector<EdgeEnds> edges(chosen.begin(), chosen.end());
    std::vector<std::pair<std::uint32_t, TetEdge>> expected;
    for (const TetHandle t : live_tets(mesh)) {
      for (unsigned e = 0; e < 6; ++e) {
        const auto ends = mesh.vertices(TetEdge(t, e));
        const auto n = std::find(edges.begin(), edges.end(), edge_ends(ends[0], ends[1]));
        if (n == edges.end()) continue;
        expected.emplace_back(static_cast<std::uint32_t>(n - edges.begin()), TetEdge(t, e));
      }
    }
    REQUIRE(expected.size() > edges.size() - 1);
    std::vector<std::pair<std::uint32_t, TetEdge>> found;
    on_threads(2, [&] {
      for (const TetAtEdge& at : find_tets_at(mesh, edges)) found.emplace_back(at.number, at.edge);
    });
    CHECK(found == expected);
  }
}
