// SPDX-License-Identifier: MIT
// Tets on a bed of other elements, with slivers where they are free.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::test {

/// What lies below the tets, by the numbers of VTK.
enum class Bed { wedges = 13, pyramids = 14, hexahedra = 12, quads = 9 };

/// `side` x `side` x (`side` + 1) unit cubes. Those above the lowest layer are six tets each; their points
/// inside and on the upper side are moved at random. Under hexahedra the bed has squares whose diagonals
/// the tets choose; the tips of the pyramids are vertices of no tet.
inline MeshData tets_on(Bed bed, std::uint32_t side, std::uint32_t seed) {
  MeshData data;
  std::mt19937 random(seed);
  const auto shift = [&random] {
    return (static_cast<double>(random() % 1000) / 999.0 - 0.5) * 0.66;
  };
  const std::uint32_t row = side + 1;
  for (std::uint32_t k = 0; k < side + 2; ++k) {
    for (std::uint32_t j = 0; j < row; ++j) {
      for (std::uint32_t i = 0; i < row; ++i) {
        Point p(i, j, k == 1 ? 0.1 : k);
        const bool is_within = i > 0 && i < side && j > 0 && j < side;
        if (is_within && k > 1) p += Point(shift(), shift(), k == side + 1 ? 0 : shift());
        data.points.push_back(p);
      }
    }
  }
  const std::uint32_t up = row * row;
  OtherElements others;
  others.vtk_type = static_cast<int>(bed);
  const auto add = [&](std::vector<std::uint32_t> vertices) {
    others.vertex_count = vertices.size();
    others.vertices.insert(others.vertices.end(), vertices.begin(), vertices.end());
    others.labels.push_back(0);
  };
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t a = j * row + i;
      const std::array<std::uint32_t, 4> low = {a, a + 1, a + row + 1, a + row};
      const std::array<std::uint32_t, 4> top = {a + up, a + up + 1, a + up + row + 1, a + up + row};
      if (bed == Bed::wedges) {
        add({low[0], low[1], low[2], top[0], top[1], top[2]});
        add({low[0], low[2], low[3], top[0], top[2], top[3]});
      } else if (bed == Bed::hexahedra) {
        add({low[0], low[1], low[2], low[3], top[0], top[1], top[2], top[3]});
      } else if (bed == Bed::quads) {
        add({top[0], top[1], top[2], top[3]});
      } else {  // two that have the diagonal of the square in common
        const auto tip = static_cast<std::uint32_t>(data.points.size());
        data.points.push_back((data.points[low[0]] + data.points[low[2]]) / 2);
        add({top[0], top[1], low[1], low[0], top[2]});
        add({top[0], low[0], low[3], top[3], top[2]});
        add({low[0], low[1], low[2], low[3], tip});
      }
      for (std::uint32_t k = 1; k <= side; ++k) {
        std::array<std::uint32_t, 8> q{};
        for (std::uint32_t s = 0; s < 8; ++s) {
          q[s] = a + k * up + (s & 1) + (s >> 1 & 1) * row + (s >> 2) * up;
        }
        constexpr std::array<std::array<std::uint8_t, 2>, 6> kBetween = {
            {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
        for (const auto& [x, y] : kBetween) data.tets.push_back({{q[0], q[x], q[y], q[7]}, 0});
      }
    }
  }
  data.other_elements.push_back(others);
  return data;
}

/// Triangles of a bed that are faces of tets, by number; of quads and hexahedra both halves that the tets
/// have chosen. What others share, told without find_shared_parts().
inline std::vector<std::array<std::uint32_t, 3>> faces_on_bed(const MeshData& data) {
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (const MeshData::Tet& tet : data.tets) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) face[k] = tet.vertices[k < left_out ? k : k + 1];
      if (std::all_of(face.begin(), face.end(),
                      [&](std::uint32_t v) { return data.points[v].z() == 0.1; })) {
        std::sort(face.begin(), face.end());
        faces.push_back(face);
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace tetmend::test
