// SPDX-License-Identifier: MIT
// Prepares a mesh for other improvers: every boundary triangle is named in the output file.
//
//   prepare INPUT OUTPUT [--unique]
//
// --unique gives each triangle a label of its own. TetGen merges coplanar boundary triangles of one
// label and then changes the surface.
#include <algorithm>
#include <exception>
#include <string_view>

#include <fmt/core.h>

#include "bench/boundary.h"
#include "kernel/formats/mesh_io.h"

namespace {

using namespace tetmend;

void name_boundary(MeshData& mesh) {
  std::vector<bench::Face> named;
  named.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) named.push_back(bench::face_key(triangle.vertices));
  std::ranges::sort(named);
  for (const bench::Face& face : bench::boundary_faces(mesh)) {
    if (std::ranges::binary_search(named, bench::face_key(face))) continue;
    mesh.triangles.push_back({.vertices = face, .label = 1});
  }
}

}  // namespace

int main(int count, char** arguments) {
  const bool unique = count == 4 && std::string_view(arguments[3]) == "--unique";
  if (count != 3 && !unique) {
    fmt::print(stderr, "usage: prepare INPUT OUTPUT [--unique]\n");
    return 2;
  }
  try {
    MeshData mesh = read_mesh(arguments[1]);
    name_boundary(mesh);
    if (unique) {
      Label label = 0;
      for (auto& triangle : mesh.triangles) triangle.label = ++label;
    }
    write_mesh(arguments[2], mesh);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "prepare: {}\n", error.what());
    return 1;
  }
}
