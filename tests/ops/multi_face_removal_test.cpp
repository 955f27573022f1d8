// SPDX-License-Identifier: MIT
// Multi-face removal and the 2-3 flip on sandwiches whose best covering is known.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "ops/registry.h"
#include "tests/support/lone_worker.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct FaceRemovalWorker : LoneWorker {
  using LoneWorker::LoneWorker;
  Verdict attempt(const std::vector<std::uint32_t>& corners, const ParameterSettings& settings = {},
                  std::string_view name = "multi_face_removal") {
    return LoneWorker::attempt(name, face(corners), settings);
  }
};

}  // namespace

TEST_CASE("the face between two low tets gives way to three tets around the edge of their apexes") {
  for (const char* name : {"multi_face_removal", "flip_2_3"}) {
    FaceRemovalWorker worker(sandwich(3, 0.25));
    REQUIRE(worker.mesh.tet_count() == 2);
    const Quality before = worker.worst();
    CHECK(worker.attempt({2, 3, 4}, {}, name) == Verdict::accepted);
    CHECK(worker.mesh.tet_count() == 3);
    CHECK(worker.has_edge(0, 1));
    CHECK(worker.worst() > before);
  }
}

TEST_CASE("the face between two regular tets stays") {
  for (const char* name : {"multi_face_removal", "flip_2_3"}) {
    FaceRemovalWorker worker(sandwich(3, 1.4142135623730951));
    CHECK(worker.attempt({2, 3, 4}, {}, name) == Verdict::no_improvement);
    CHECK(worker.mesh.tet_count() == 2);
  }
}

TEST_CASE("all faces of a sandwich vanish at once, whichever is named") {
  for (unsigned m = 4; m <= 8; ++m) {
    CAPTURE(m);
    for (std::uint32_t third = 4; third < m + 2; ++third) {
      // The fan starts at vertex 2.
      FaceRemovalWorker worker(sandwich(m, 0.3));
      REQUIRE(worker.mesh.tet_count() == 2 * (m - 2));
      CHECK(worker.attempt({2, third - 1, third}) == Verdict::accepted);
      CHECK(worker.mesh.tet_count() == m);
      CHECK(worker.has_edge(0, 1));
    }
  }
}

TEST_CASE("a 2-3 flip fails where the whole sandwich must go") {
  FaceRemovalWorker worker(sandwich(5, 0.3));
  CHECK(worker.attempt({2, 3, 4}, {}, "flip_2_3") != Verdict::accepted);
  CHECK(worker.attempt({2, 3, 4}) == Verdict::accepted);
}

TEST_CASE("the polygon stops growing at its largest size") {
  FaceRemovalWorker three(sandwich(6, 0.3));
  three.attempt({2, 4, 5}, {{"max_polygon", 3}});
  CHECK_FALSE((three.mesh.tet_count() == 6 && three.has_edge(0, 1)));
  FaceRemovalWorker six(sandwich(6, 0.3));
  CHECK(six.attempt({2, 4, 5}, {{"max_polygon", 6}}) == Verdict::accepted);
  CHECK(six.mesh.tet_count() == 6);
}

TEST_CASE("a sandwich whose faces are cut badly is cut again without an edge between the apexes") {
  // A long rhombus, cut along its long diagonal, with apexes too far away for an edge between them.
  MeshData data;
  data.points = {{0, 0, -1.1}, {0, 0, 1.1}, {1.1, 0, 0}, {0, 0.8, 0}, {-1.1, 0, 0}, {0, -0.8, 0}};
  data.tets = {{{1, 2, 4, 3}}, {{1, 2, 5, 4}}, {{0, 2, 3, 4}}, {{0, 2, 4, 5}}};
  FaceRemovalWorker worker(data);
  REQUIRE(count_not_positive(worker.mesh) == 0);
  CHECK(worker.attempt({2, 3, 4}) == Verdict::accepted);
  CHECK(worker.mesh.tet_count() == 4);
  CHECK(worker.has_edge(3, 5));
  CHECK_FALSE(worker.has_edge(2, 4));
  CHECK_FALSE(worker.has_edge(0, 1));
}

TEST_CASE("boundary faces and constrained faces are refused") {
  FaceRemovalWorker boundary(sandwich(3, 0.25));
  CHECK(boundary.attempt({0, 2, 3}) == Verdict::constrained);
  CHECK(boundary.attempt({0, 2, 3}, {}, "flip_2_3") == Verdict::constrained);
  MeshData face = sandwich(3, 0.25);
  face.triangles.push_back({{2, 4, 3}, 1});
  MeshData regions = sandwich(3, 0.25);
  regions.tets[0].label = 1;
  for (const MeshData& data : {face, regions}) {
    FaceRemovalWorker worker(data);
    CHECK(worker.attempt({2, 3, 4}) == Verdict::constrained);
    CHECK(worker.attempt({2, 3, 4}, {}, "flip_2_3") == Verdict::constrained);
  }
}

TEST_CASE("a constraint within the sandwich survives") {
  MeshData face = sandwich(5, 0.3);
  face.triangles.push_back({{2, 3, 4}, 1});
  FaceRemovalWorker worker(face);
  worker.attempt({2, 5, 6});
  CHECK(worker.mesh.is_constrained(worker.face({2, 3, 4}).face()));

  MeshData edge = sandwich(5, 0.3);
  edge.edges.push_back({{2, 4}, 1});
  FaceRemovalWorker other(edge);
  other.attempt({2, 3, 4});
  CHECK(other.has_edge(2, 4));
}
