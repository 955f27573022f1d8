// SPDX-License-Identifier: MIT
// What the tests of pieces work on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "contract/zoo.h"
#include "kernel/formats/mesh_io.h"
#include "pieces/divided_mesh.h"
#include "pieces/piece_run.h"
#include "pieces/piece_task.h"
#include "tests/support/assets.h"

namespace tetmend::test {

/// n x n x n cubes of edge 1 in six tets each, in two regions; vertices inside are moved, so that
/// some tets are bad. Names a triangle, an edge and two vertices.
inline MeshData lattice(std::uint32_t n) {
  MeshData data = contract::kuhn_cube(n, 0.3, 1);
  for (Point& p : data.points) p *= n;
  for (MeshData::Tet& tet : data.tets) {
    double height = 0;
    for (const std::uint32_t v : tet.vertices) height += data.points[v].z();
    tet.label = height < 2.0 * n ? 1 : 2;
  }
  const std::uint32_t up = (n + 1) * (n + 1);
  const std::uint32_t inside = up + n + 2;  // at (1, 1, 1)
  data.triangles.push_back({{0, 1, n + 2}, 5});
  data.edges.push_back({{inside, inside + inside}, 6});
  data.required_vertices = {inside, inside + n - 2};
  return data;
}

inline pieces::Division in_pieces(std::size_t count) {
  pieces::Division division;
  division.pieces = count;
  return division;
}

/// Stores the pieces of a division again, without work.
inline void store_idly(pieces::DividedMesh& mesh) {
  for (std::uint32_t part = 0; part < mesh.parts(); ++part) {
    mesh.store(part, pieces::own_part(mesh.gathered(part), mesh.state().parting, part));
    mesh.remove_gathered(part);
  }
  mesh.number_added(std::vector<std::uint64_t>(mesh.parts(), 0));
}

/// A new folder that goes with its maker.
class Folder {
 public:
  Folder() : folder_(std::filesystem::temp_directory_path()) {}
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  pieces::ScratchFolder folder_;
};

}  // namespace tetmend::test
