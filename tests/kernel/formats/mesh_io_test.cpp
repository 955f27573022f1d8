// SPDX-License-Identifier: MIT
// What all mesh formats promise: round trips, errors for files that are not there, and no crash on
// any damage.
#include "kernel/formats/mesh_io.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernel/geometry.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

bool keeps_required_vertices(std::string_view extension) {
  return extension == ".mesh" || extension == ".meshb";
}

/// Elements, too, and labels count from 1.
bool is_sorted_by_labels(std::string_view extension) {
  return extension == ".e" || extension == ".exo" || extension == ".g" || extension == ".cgns";
}

/// Tets have positive volumes, or none that can be computed.
void turn_round(MeshData& mesh) {
  for (MeshData::Tet& tet : mesh.tets) {
    auto& v = tet.vertices;
    const auto& points = mesh.points;
    if (volume6(points[v[0]], points[v[1]], points[v[2]], points[v[3]]) < 0) std::swap(v[0], v[1]);
  }
}

/// The awkward mesh as the format can hold it.
MeshData mesh_for(std::string_view extension) {
  MeshData mesh = awkward_mesh();
  if (!keeps_required_vertices(extension)) mesh.required_vertices.clear();
  if (extension == ".su2") {
    mesh.edges.clear();
    for (MeshData::Tet& tet : mesh.tets) tet.label = 0;
  }
  if (extension == ".feb") mesh.edges.clear();
  if (extension == ".bdf" || extension == ".nas" || extension == ".mfem") {
    mesh.edges.clear();
    mesh.tets[1].label = 5;
    mesh.triangles[1].label = 7;
    mesh.triangles[2].label = 1;
  }
  if (extension == ".k" || extension == ".key") {  // sixteen characters a coordinate
    mesh.edges.clear();
    mesh.points = {
        {0.1, 0.25, 0}, {5e-24, 1, 1}, {-1.25e-30, 2, 3}, {1, -4e-7, 1e10}, {0, 0, -1e10}};
    mesh.tets[0].label = 99999999;
    mesh.tets[1].label = 5;
    mesh.triangles[1].label = 7;
    mesh.triangles[2].label = 1;
  }
  if (is_sorted_by_labels(extension)) {
    mesh.tets[0].label = 3;
    mesh.tets[1].label = 5;
    mesh.triangles[0].label = mesh.triangles[1].label = 7;
    mesh.triangles[2].label = 8;
    for (MeshData::Edge& edge : mesh.edges) edge.label = 9;
  }
  const auto has_no_point_labels = {".su2", ".vol",  ".bdf", ".nas",  ".header",
                                    ".unv", ".mfem", ".feb", ".k",    ".key",
                                    ".e",   ".exo",  ".g",   ".cgns", ".xdmf"};
  if (std::find(has_no_point_labels.begin(), has_no_point_labels.end(), extension) !=
      has_no_point_labels.end()) {
    mesh.point_labels.clear();
  }
  if (extension == ".vol") turn_round(mesh);
  return mesh;
}

constexpr std::string_view kVtkAscii =
    "# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n"
    "0 0 0 1 0 0 0 1 0\n0 0 1 1 1 1\nMETADATA\nINFORMATION 0\n\nCELLS 4 10\nOFFSETS vtktypeint64\n"
    "0 4 7 10\nCONNECTIVITY vtktypeint64\n0 1 2 3 0 1 2 1 2 3\nCELL_TYPES 3\n10\n5\n5\n"
    "CELL_DATA 3\nFIELD f 2\nlabel 1 3 int\n1 2 3\nname 1 3 string\na\nb\nc\nPOINT_DATA 5\n"
    "SCALARS s double\nLOOKUP_TABLE default\n1 2 3 4 5\n";

}  // namespace

TEST_CASE("a mesh written in any format is read back bit for bit") {
  const TempFolder folder;
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.extension);
    if (format.extension == ".inp") continue;  // a deck lists faces, not triangles: inp_test.cpp
    // Their surfaces pin points, and one rounds: lsdyna_test.cpp, febio_test.cpp.
    if (format.name == "LS-DYNA" || format.name == "FEBio") continue;
    if (format.name == "Exodus II") continue;  // sides turn triangles: exodus_test.cpp
    const auto file = folder / ("mesh" + std::string(format.extension));
    const MeshData mesh = mesh_for(format.extension);
    write_mesh(file, mesh);
    CHECK(same_mesh(read_mesh(file), mesh));
  }
}

TEST_CASE("a mesh without labels, triangles and edges is read back without them") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{{0, 1, 2, 3}, 0}};
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.extension);
    const auto file = folder / ("mesh" + std::string(format.extension));
    // Properties, attributes, parts count from 1.
    const bool is_from_one = format.name == "Nastran" || format.name == "MFEM" ||
                             format.name == "LS-DYNA" || format.name == "Exodus II";
    mesh.tets[0].label = is_from_one ? 1 : 0;
    write_mesh(file, mesh);
    CHECK(same_mesh(read_mesh(file), mesh));
  }
}

TEST_CASE("an empty mesh is written and read in every format") {
  const TempFolder folder;
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.extension);
    const auto file = folder / ("empty" + std::string(format.extension));
    write_mesh(file, {});
    CHECK(same_mesh(read_mesh(file), {}));
  }
}

TEST_CASE("an extension is matched in any case") {
  const TempFolder folder;
  for (const std::string name : {"A.MESH", "A.MeshB", "A.NODE", "A.Ele", "A.VTK", "A.Msh"}) {
    CAPTURE(name);
    const auto file = folder / name;
    MeshData mesh = awkward_mesh();
    mesh.required_vertices.clear();
    write_mesh(file, mesh);
    CHECK(same_mesh(read_mesh(file), mesh));
  }
}

TEST_CASE("an unknown extension is an error with the valid ones") {
  const TempFolder folder;
  CHECK(error_of_reading(folder / "a.stl") ==
        "a.stl: the extension '.stl' is not that of a mesh format: expected one of .mesh, .meshb, "
        ".node, .ele, .vtk, .vtu, .msh, .inp, .su2, .vol, .bdf, .nas, .header, .unv, .mfem, .k, "
        ".key, "
        ".feb, .e, .exo, .g, .med, .cgns, .xdmf");
  CHECK_THROWS_AS(write_mesh(folder / "a", {}), Error);
  CHECK(folder.entries() == 0);
}

TEST_CASE("a file that is missing, a folder, a device or empty is an error with the reason") {
  const TempFolder folder;
  for (const MeshFormat& format : mesh_formats()) {
    const std::string extension(format.extension);
    CAPTURE(extension);
    CHECK(error_of_reading(folder / ("no" + extension)).ends_with(": No such file or directory"));

    const TempFolder other;
    write_text(other / ("a" + extension), "");
    write_text(other / "a.node", "");
    const std::string empty = error_of_reading(other / ("a" + extension));
    CHECK(empty.find("the file is empty") != std::string::npos);
    const bool is_binary =
        extension == ".meshb" || extension == ".med" || is_sorted_by_labels(extension);
    CHECK(empty.find(is_binary ? ": byte 0: " : ":1: ") != std::string::npos);

    std::filesystem::create_directory(folder / ("d" + extension));
  }
  CHECK(error_of_reading(folder / "d.mesh") == "d.mesh: cannot be read: Is a directory");
  CHECK(error_of_reading(folder / "d.node") == "d.node: cannot be read: Is a directory");
  std::filesystem::create_symlink("/dev/null", folder / "null.mesh");
  CHECK(error_of_reading(folder / "null.mesh") == "null.mesh: cannot be read: not a regular file");
}

TEST_CASE("a file cut at any byte is an error or gives the full mesh") {
  const TempFolder folder;
  for (const MeshFormat& format : mesh_formats()) {
    const std::string extension(format.extension);
    if (extension == ".inp") continue;  // no counts: a cut between lines goes unseen
    // Sets pin vertices, sides turn triangles: febio_test.cpp, lsdyna_test.cpp, exodus_test.cpp.
    if (extension == ".feb" || format.name == "LS-DYNA" || format.name == "Exodus II") continue;
    const auto file = folder / ("mesh" + extension);
    const MeshData mesh = mesh_for(extension);
    write_mesh(file, mesh);
    std::vector<std::filesystem::path> parts = {file};
    if (extension == ".node") {
      parts = {file, folder / "mesh.ele", folder / "mesh.face", folder / "mesh.edge"};
    }
    if (extension == ".header") {
      parts = {file, folder / "mesh.nodes", folder / "mesh.elements", folder / "mesh.boundary"};
    }
    for (const auto& part : parts) {
      CAPTURE(part);
      const std::string content = read_text(part);
      for (std::size_t size = content.size(); size-- > 0;) {
        std::filesystem::resize_file(part, size);
        try {
          MeshData got = read_mesh(file);
          const auto tells = [](const std::string& note) {
            return note.find("is the file complete?") != std::string::npos;
          };
          // People have decks without their end: a note takes the place of the error.
          if (std::any_of(got.notes.begin(), got.notes.end(), tells)) continue;
          // No end mark: a cut exactly before the labels of points goes unseen.
          if (extension == ".vtk" || extension == ".msh") {
            REQUIRE(got.tets.size() == mesh.tets.size());
            REQUIRE(same_points(got, mesh));
          } else {
            REQUIRE(same_mesh(got, mesh));
          }
        } catch (const Error&) {
        }
      }
      write_text(part, content);
    }
  }
}

TEST_CASE("an ASCII VTK file of version 5.1 cut at any byte is an error or gives a sound mesh") {
  const TempFolder folder;
  write_text(folder / "a.vtk", kVtkAscii);
  CHECK(read_mesh(folder / "a.vtk").triangles.size() == 2);
  cut_at_each_byte(folder / "a.vtk");
}

TEST_CASE("a file with any byte changed is an error or gives a sound mesh") {
  const TempFolder folder;
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.extension);
    // HDF5 itself does not stand that.
    if (format.extension == ".med" || format.extension == ".cgns") continue;
    const auto file = folder / ("mesh" + std::string(format.extension));
    write_mesh(file, mesh_for(format.extension));
    change_each_byte(file, file);
  }
  change_each_byte(folder / "mesh.node", folder / "mesh.face");
  change_each_byte(folder / "mesh.node", folder / "mesh.edge");
  change_each_byte(folder / "mesh.header", folder / "mesh.nodes");
  change_each_byte(folder / "mesh.header", folder / "mesh.elements");
  change_each_byte(folder / "mesh.header", folder / "mesh.boundary");
  write_text(folder / "ascii.vtk", kVtkAscii);
  change_each_byte(folder / "ascii.vtk", folder / "ascii.vtk");
}
