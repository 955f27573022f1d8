// SPDX-License-Identifier: MIT
// A mesh with what the viewer must know of it as a whole; can be made in any thread.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "kernel/statistics.h"
#include "kernel/tet_mesh.h"
#include "viewer/mesh/camera.h"

namespace tetmend::viewer {

struct MeasuredMesh {
  MeasuredMesh() = default;
  /// Cost: a few passes over the mesh, about 0.2 s for a million tets.
  explicit MeasuredMesh(TetMesh measured);

  TetMesh mesh;
  std::array<glm::dvec3, 8> box{};  ///< corners of the box around the mesh
  Ball ball;                        ///< encloses the mesh
  MeshStatistics statistics;
  std::vector<Label> regions;  ///< ascending
};

/// Where parts of the mesh touch without being joined. Cost: n log n in the vertices of its boundary.
std::vector<std::string> notes_of_parts(const TetMesh& mesh);

}  // namespace tetmend::viewer
