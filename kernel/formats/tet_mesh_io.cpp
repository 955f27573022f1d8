// SPDX-License-Identifier: MIT
// From a file to a TetMesh: what is wrong with the topology is told with its place in the file.
#include "kernel/formats/tet_mesh_io.h"

#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"

namespace tetmend {

TetMesh read_tet_mesh(const std::filesystem::path& file, MeshOrder order, BuildReport* report,
                      InteriorConstraints interior) {
  return build_tet_mesh(file, read_mesh(file), order, report, interior);
}

TetMesh build_tet_mesh(const std::filesystem::path& file, MeshData data, MeshOrder order,
                       BuildReport* report, InteriorConstraints interior) {
  try {
    return order == MeshOrder::spatial ? TetMesh::sorted(std::move(data), report, interior)
                                       : TetMesh(std::move(data), report, interior);
  } catch (const BuildError& error) {
    throw Error(fmt::format("{}: {}", locate_tet(file, error.tet()), error.what()));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace tetmend
