// SPDX-License-Identifier: MIT
// Finds vertices and faces of a mesh that a test speaks of.
#pragma once

#include <algorithm>
#include <cstdint>

#include <doctest/doctest.h>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"
#include "tests/support/zoo.h"

namespace tetmend::test {

/// The vertex at a place, of which there must be one.
inline std::uint32_t vertex_at(const MeshData& data, const Point& place) {
  const auto found = std::find_if(data.points.begin(), data.points.end(),
                                  [&](const Point& p) { return (p - place).norm() < 1e-9; });
  REQUIRE(found != data.points.end());
  return static_cast<std::uint32_t>(found - data.points.begin());
}

/// The live vertex at a place; invalid if there is none.
inline VertexHandle vertex_at(const TetMesh& mesh, const Point& place) {
  for (const VertexHandle v : live_vertices(mesh)) {
    if ((mesh.point(v) - place).norm() < 1e-9) return v;
  }
  return {};
}

/// A half-face with a tet on its other side.
inline HalfFace inner_face(const TetMesh& mesh) {
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned f = 0; f < 4; ++f) {
      if (!mesh.is_boundary(HalfFace(t, f))) return HalfFace(t, f);
    }
  }
  FAIL("no inner face");
  return {};
}

}  // namespace tetmend::test
