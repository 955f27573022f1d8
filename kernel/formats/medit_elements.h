// SPDX-License-Identifier: MIT
// Sections of MEDIT files with elements that become MeshData::other_elements. Their vertices stand
// in VTK's order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

struct MeditElements {
  std::string_view section;
  std::int32_t keyword;  ///< in binary files
  int vtk_type;
  std::size_t width;  ///< vertices of one
};

inline constexpr std::array<MeditElements, 7> kMeditElements = {{{"EdgesP2", 25, 21, 3},
                                                                 {"TrianglesP2", 24, 22, 6},
                                                                 {"TetrahedraP2", 30, 24, 10},
                                                                 {"Quadrilaterals", 7, 9, 4},
                                                                 {"Hexahedra", 10, 12, 8},
                                                                 {"Prisms", 9, 13, 6},
                                                                 {"Pyramids", 49, 14, 5}}};

/// Null for a section of another name.
inline const MeditElements* find_medit_elements(std::string_view section) {
  if (section == "Hexaedra") section = "Hexahedra";  // some programs spell it so
  const auto* found = std::find_if(kMeditElements.begin(), kMeditElements.end(),
                                   [&](const auto& kind) { return kind.section == section; });
  return found == kMeditElements.end() ? nullptr : found;
}
inline const MeditElements* find_medit_elements(std::int32_t keyword) {
  const auto* found = std::find_if(kMeditElements.begin(), kMeditElements.end(),
                                   [&](const auto& kind) { return kind.keyword == keyword; });
  return found == kMeditElements.end() ? nullptr : found;
}

inline bool medit_holds(int vtk_type) {
  return std::any_of(kMeditElements.begin(), kMeditElements.end(),
                     [&](const auto& kind) { return kind.vtk_type == vtk_type; });
}

/// The elements of this kind, `count` of them, with room for their vertices.
inline OtherElements medit_elements(const MeditElements& kind, std::size_t count) {
  OtherElements others;
  others.vtk_type = kind.vtk_type;
  others.vertex_count = kind.width;
  others.vertices.resize(count * kind.width);
  others.labels.resize(count);
  return others;
}

/// True if the mesh has tets in a section of second order, and so may lack one of first.
inline bool has_second_order_tets(const MeshData& mesh) {
  return std::any_of(mesh.other_elements.begin(), mesh.other_elements.end(),
                     [](const OtherElements& others) { return others.vtk_type == 24; });
}

/// Calls act(kind, elements) for all that have a section.
template <class Action>
void for_medit_elements(const MeshView& mesh, Action act) {
  if (mesh.data() == nullptr) return;
  for (const MeditElements& kind : kMeditElements) {
    for (const OtherElements& others : mesh.data()->other_elements) {
      if (kind.vtk_type == others.vtk_type && kind.width == others.vertex_count) act(kind, others);
    }
  }
}

}  // namespace tetmend::formats
