// SPDX-License-Identifier: MIT
// What is behind a user's mesh.
#pragma once

#include <filesystem>
#include <mutex>
#include <utility>

#include <tetmend/mesh.h>

#include "kernel/mesh_data.h"
#include "kernel/statistics.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

struct Mesh::Content {
  MeshData data;
  std::filesystem::path file;
  mutable std::once_flag elements_unpacked, rest_unpacked;
  mutable MeshArrays arrays;  // of `data`, once they were asked for

  Content() = default;
  explicit Content(MeshData contents, std::filesystem::path from = {})
      : data(std::move(contents)), file(std::move(from)) {}
};

/// The way of the library into a Mesh.
struct MeshAccess {
  static const MeshData& data(const Mesh& mesh) { return mesh.content().data; }
  static Mesh make(MeshData data, std::filesystem::path file = {});
  /// Into a mesh that was made and not looked at.
  static void fill(Mesh& mesh, MeshData&& data) noexcept { mesh.content_->data = std::move(data); }
  /// Leaves an empty mesh.
  static MeshData take(Mesh& mesh);
};

namespace face {

/// TetMesh::build(); an Error has the line or byte of the tet in `file`. Where that is empty, numbers
/// count from 0, as in arrays.
TetMesh build_located(const std::filesystem::path& file, MeshData& data, BuildDetails details);

}  // namespace face

}  // namespace tetmend
