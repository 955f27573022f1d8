// SPDX-License-Identifier: MIT
// tetmend surface --features from outside.
#include <algorithm>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/tet_mesh.h"
#include "tests/apps/program.h"
#include "tests/support/text.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("the features of a cube: six patches, twelve lines, eight corners, printed and written") {
  const TempFolder folder;
  const std::string cube = (folder / "cube.mesh").string();
  const std::string out = (folder / "features.mesh").string();
  write_mesh(cube, kuhn_cube(3, 0.2, 1));
  const Outcome shown = run_program({"surface", cube, "--features"});
  CAPTURE(shown.err);
  REQUIRE(shown.status == 0);
  CHECK(contains(shown.out, "108 triangles, feature angle 40 degrees"));
  CHECK(contains(shown.out, "by angle               6          12           8          24"));
  CHECK(contains(shown.out, "exactly flat           6          12           8          24"));
  for (const bool flat : {false, true}) {
    std::vector<std::string> words = {"surface", cube, out, "--features"};
    if (flat) words.push_back("--flat");
    REQUIRE(run_program(words).status == 0);
    const MeshData data = read_mesh(out);
    CHECK(data.tets.size() == 162);
    CHECK(data.triangles.size() == 108);
    CHECK(data.edges.size() == 36);
    CHECK(data.required_vertices.size() == 8);
    const auto [least, most] =
        std::minmax_element(data.triangles.begin(), data.triangles.end(),
                            [](const auto& a, const auto& b) { return a.label < b.label; });
    CHECK(least->label == 1);
    CHECK(most->label == 6);
    // All triangles of a patch lie on one side of the cube.
    for (const auto& t : data.triangles) {
      int sides = 0;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double x = data.points[t.vertices[0]][k];
        sides += data.points[t.vertices[1]][k] == x && data.points[t.vertices[2]][k] == x;
      }
      CHECK(sides == 1);
    }
  }
}

TEST_CASE("--features is no surface to write, and its options need it") {
  const TempFolder folder;
  const std::string cube = (folder / "cube.mesh").string();
  write_mesh(cube, kuhn_cube(2, 0, 1));
  const std::string off = (folder / "out.off").string();
  CHECK(run_program({"surface", cube, off, "--features"}).status == 2);
  CHECK(run_program({"surface", cube, off, "--features", "--bad"}).status == 2);
  CHECK(run_program({"surface", cube, off, "--features", "--constraints"}).status == 2);
  CHECK(run_program({"surface", cube, off, "--flat"}).status == 2);
  CHECK(run_program({"surface", cube, "--features", "--feature-angle", "181"}).status == 2);
  CHECK(run_program({"surface", cube}).status == 2);
  CHECK_FALSE(std::filesystem::exists(off));
}
