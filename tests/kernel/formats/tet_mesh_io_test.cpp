// SPDX-License-Identifier: MIT
#include "kernel/formats/tet_mesh_io.h"

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Three tets at one face.
constexpr std::string_view kFolded =
    "MeshVersionFormatted 2\nDimension 3\nVertices 6\n"
    "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n0 0 2 0\n"
    "Tetrahedra 3\n1 2 3 4 7\n2 1 3 5 7\n1 2 3 6 8\nEnd\n";

}  // namespace

TEST_CASE("a file becomes a mesh in the order of the file or along a curve") {
  const std::filesystem::path file = TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh";
  const MeshData data = read_mesh(file);
  BuildReport report;
  CHECK(read_tet_mesh(file) == TetMesh(data));
  CHECK(read_tet_mesh(file, MeshOrder::spatial, &report) == TetMesh::sorted(data));
  CHECK(build_tet_mesh(file, data, MeshOrder::spatial) == TetMesh::sorted(data));
  BuildReport expected;
  const TetMesh same(data, &expected);
  CHECK(report.constrained_faces == expected.constrained_faces);
}

TEST_CASE(
    "tets that share a face with two others are an error that begins with the line of the third") {
  const TempFolder folder;
  write_text(folder / "a.mesh", kFolded);
  for (const MeshOrder order : {MeshOrder::of_file, MeshOrder::spatial}) {
    CHECK_THROWS_WITH_AS(read_tet_mesh(folder / "a.mesh", order),
                         doctest::Contains("a.mesh:13: tet 3 (vertices 1 2 3 6)"), Error);
  }
}

TEST_CASE("a mesh without tets is an error that begins with the file") {
  const TempFolder folder;
  write_text(folder / "a.mesh",
             "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nTetrahedra 0\nEnd\n");
  CHECK_THROWS_WITH_AS(read_tet_mesh(folder / "a.mesh"), doctest::Contains("a.mesh: "), Error);
}
