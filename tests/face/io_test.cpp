// SPDX-License-Identifier: MIT
// Meshes from files and to files.
#include <algorithm>

#include <doctest/doctest.h>

#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("a mesh is saved and loaded with all that it has, for any number of threads") {
  const TempFolder folder;
  const auto file = folder / "a.meshb";
  for (const int threads : {1, 3}) {
    save(file, Mesh(two_tet_arrays()), threads);
    const Mesh mesh = load(file, threads);
    CHECK(mesh.file() == file);
    CHECK(mesh.arrays().points == two_tet_arrays().points);
    CHECK(mesh.arrays().point_labels == two_tet_arrays().point_labels);
    CHECK(mesh.arrays().tets == two_tet_arrays().tets);
    CHECK(mesh.arrays().tet_labels == two_tet_arrays().tet_labels);
    CHECK(mesh.arrays().triangles == two_tet_arrays().triangles);
    CHECK(mesh.arrays().triangle_labels == two_tet_arrays().triangle_labels);
    CHECK(mesh.arrays().edges == two_tet_arrays().edges);
    CHECK(mesh.arrays().edge_labels == two_tet_arrays().edge_labels);
    CHECK(mesh.arrays().required_vertices == two_tet_arrays().required_vertices);
  }
}

TEST_CASE("what is wrong with a file is told with its line") {
  const TempFolder folder;
  const auto file = folder / "a.mesh";
  write_text(file, "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 nan 0 0\n");
  CHECK(message_of([&] { load(file); }).starts_with(file.string() + ":5: "));
  CHECK(message_of([&] { load(folder / "b.mesh"); }).starts_with((folder / "b.mesh").string()));
  CHECK(message_of([&] { load(folder / "a.stl"); }).find(".meshb") != std::string::npos);
  CHECK(message_of([&] { save(folder / "no/a.mesh", Mesh(two_tet_arrays())); }) != "");
  CHECK_THROWS_AS(load(file, 0), OptionError);
}

TEST_CASE("each format that is listed can be written and read") {
  const TempFolder folder;
  CHECK(file_formats().size() >= 5);
  for (const FileFormat& format : file_formats()) {
    const auto file = folder / ("mesh" + std::string(format.extension));
    save(file, Mesh(two_tet_arrays()));
    CHECK(load(file).arrays().tets == two_tet_arrays().tets);
  }
}
