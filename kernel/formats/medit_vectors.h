// SPDX-License-Identifier: MIT
// Normals and tangents at vertices in MEDIT files: a section of vectors, and one of pairs of a vertex
// and a vector. In MeshData they are an array of the points and the group of the points that have
// one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/medit_marks.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

struct MeditVectors {
  std::string_view vectors;  ///< section, and name of the array
  std::int32_t vectors_keyword;
  std::string_view at;  ///< section, and name of the group
  std::int32_t at_keyword;
};

inline constexpr std::array<MeditVectors, 2> kMeditVectors = {
    {{"Normals", 60, "NormalAtVertices", 20}, {"Tangents", 59, "TangentAtVertices", 61}}};

/// What the two sections hold, numbers from 0.
struct VectorsAtVertices {
  std::vector<std::array<double, 3>> vectors;
  std::vector<std::array<std::uint32_t, 2>> at;  ///< {vertex, vector}

  /// Precondition: the numbers are in range. A vertex keeps its first vector.
  void add_to(MeshData& mesh, const MeditVectors& kind) const {
    if (at.empty()) return;
    std::vector<double> values(3 * mesh.points.size(), 0);
    std::vector<bool> has_one(mesh.points.size(), false);
    std::size_t lost = 0;
    Group group{0, 0, std::string(kind.at), {}, {}};
    for (const auto& [vertex, vector] : at) {
      if (has_one[vertex]) {
        ++lost;
        continue;
      }
      has_one[vertex] = true;
      group.members.push_back(vertex);
      for (std::size_t k = 0; k < 3; ++k) values[3 * vertex + k] = vectors[vector][k];
    }
    mesh.point_data.push_back({std::string(kind.vectors), 3, std::move(values)});
    mesh.groups.push_back(std::move(group));
    if (lost > 0) {
      mesh.notes.push_back(fmt::format("{} further {} at vertices that have one are not kept", lost,
                                       kind.vectors == "Normals" ? "normals" : "tangents"));
    }
  }

  /// What the mesh has of this kind.
  static VectorsAtVertices of(const MeshView& mesh, const MeditVectors& kind) {
    VectorsAtVertices found;
    if (mesh.data() == nullptr) return found;
    const std::vector<double>* values = nullptr;
    for (const DataArray& array : mesh.data()->point_data) {
      if (array.name == kind.vectors && array.components == 3) {
        values = std::get_if<std::vector<double>>(&array.values);
      }
    }
    for (const Group& group : mesh.data()->groups) {
      if (values == nullptr || group.name != kind.at || group.dimension != 0) continue;
      for (const std::uint32_t v : group.members) {
        found.at.push_back({v, static_cast<std::uint32_t>(found.vectors.size())});
        found.vectors.push_back({(*values)[3 * v], (*values)[3 * v + 1], (*values)[3 * v + 2]});
      }
    }
    return found;
  }
};

/// True if `name` is that of an array or a group that a MEDIT file has a section for.
inline bool is_medit_vectors(std::string_view name) {
  for (const MeditVectors& kind : kMeditVectors) {
    if (name == kind.vectors || name == kind.at) return true;
  }
  return false;
}

/// True if `name` is that of a group that a MEDIT file has a section for.
inline bool is_medit_mark(std::string_view name) {
  return is_medit_vectors(name) ||
         std::any_of(kMeditMarks.begin(), kMeditMarks.end(),
                     [&](const MeditMark& mark) { return mark.section == name; });
}

}  // namespace tetmend::formats
