// SPDX-License-Identifier: MIT
// What every reader asks of elements and labels, whatever the format.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Vertex numbers are 32 bits wide, and the greatest value is left free for "none".
inline constexpr std::size_t kMostVertices = UINT32_MAX - 1;

/// What messages call an element.
inline const char* element_name(const MeshData::Tet&) {
  return "tetrahedron";
}
inline const char* element_name(const MeshData::Triangle&) {
  return "triangle";
}
inline const char* element_name(const MeshData::Edge&) {
  return "edge";
}

/// MeshData asks for no point labels at all when all are 0.
inline void drop_zero_point_labels(MeshData& mesh) {
  auto& labels = mesh.point_labels;
  if (std::all_of(labels.begin(), labels.end(), [](Label label) { return label == 0; })) {
    std::vector<Label>().swap(labels);
  }
}

}  // namespace tetmend::formats
