// SPDX-License-Identifier: MIT
// What every reader asks of elements and labels, whatever the format.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Vertex numbers are 32 bits wide, and the greatest value is left free for "none".
inline constexpr std::size_t kMostVertices = UINT32_MAX - 1;

template <std::size_t N>
bool has_repeated_vertex(const std::array<std::uint32_t, N>& vertices) {
  bool repeated = false;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = i + 1; j < N; ++j) repeated |= vertices[i] == vertices[j];
  }
  return repeated;
}

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

/// For an element of the file that names a vertex twice; the file counts vertices from `base`.
template <class Element>
std::string repeated_vertex_message(const Element& element, std::uint32_t base) {
  std::array<std::uint64_t, std::tuple_size_v<decltype(Element::vertices)>> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = std::uint64_t{element.vertices[i]} + base;
  }
  return fmt::format("a vertex is repeated in the {} '{}': expected different vertices",
                     element_name(element), fmt::join(numbers, " "));
}

/// MeshData asks for no point labels at all when all are 0.
inline void drop_zero_point_labels(MeshData& mesh) {
  auto& labels = mesh.point_labels;
  if (std::all_of(labels.begin(), labels.end(), [](Label label) { return label == 0; })) {
    std::vector<Label>().swap(labels);
  }
}

}  // namespace tetmend::formats
