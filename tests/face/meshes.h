// SPDX-License-Identifier: MIT
// What the tests of the public face work on.
#pragma once

#include <string>

#include <tetmend/io.h>
#include <tetmend/mesh.h>

namespace tetmend::test {

inline std::string asset(const std::string& name) {
  return std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/" + name;
}

/// The message of the Error that the call throws; empty when it throws none.
template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Two tets that share a face, every kind of entity, every label.
inline MeshArrays two_tet_arrays() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
          .point_labels = {0, 0, 3, 0, 0},
          .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
          .tet_labels = {7, 8},
          .triangles = {{1, 2, 3}, {0, 2, 1}},
          .triangle_labels = {5, -6},
          .edges = {{0, 1}},
          .edge_labels = {9},
          .required_vertices = {2}};
}

}  // namespace tetmend::test
