// SPDX-License-Identifier: MIT
// Sections of MEDIT files that mark vertices, edges or triangles by their numbers. In MeshData they
// are groups of these names.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

struct MeditMark {
  std::string_view section;
  std::int32_t keyword;  ///< in binary files
  int dimension;         ///< of what is marked, as in Group
};

inline constexpr std::array<MeditMark, 4> kMeditMarks = {{{"Corners", 13, 0},
                                                          {"Ridges", 14, 1},
                                                          {"RequiredEdges", 16, 1},
                                                          {"RequiredTriangles", 17, 2}}};

/// May be lost: no vertex, edge or triangle is kept for it, whatever may move.
inline bool is_optional(const MeditMark& mark) {
  return mark.section == "Ridges";
}

inline std::size_t count_of_dimension(const MeshData& mesh, int dimension) {
  return dimension == 0   ? mesh.points.size()
         : dimension == 1 ? mesh.edges.size()
                          : mesh.triangles.size();
}

/// The marked entities of `mesh`; null if there are none.
inline const Group* find_marks(const MeshView& mesh, const MeditMark& mark) {
  if (mesh.data() == nullptr) return nullptr;
  for (const Group& group : mesh.data()->groups) {
    if (group.name == mark.section && group.dimension == mark.dimension && !group.members.empty()) {
      return &group;
    }
  }
  return nullptr;
}

}  // namespace tetmend::formats
