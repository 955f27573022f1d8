// SPDX-License-Identifier: MIT
#include "face/surface_marks.h"

#include <map>
#include <tuple>

namespace tetmend::face {

namespace {

using Trait = std::tuple<Label, Label, std::vector<std::uint32_t>>;  // label, part, groups

template <class Element>
std::vector<Label> marks_of(const std::vector<Element>& elements, const std::vector<Label>& parts,
                            const std::vector<Group>& groups, int dimension) {
  std::vector<Trait> traits(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    std::get<0>(traits[i]) = elements[i].label;
    std::get<1>(traits[i]) = parts.empty() ? 0 : parts[i];
  }
  bool any = !parts.empty();
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    if (groups[g].dimension != dimension) continue;
    any = any || !groups[g].members.empty();
    for (const std::uint32_t member : groups[g].members) {
      std::get<2>(traits[member]).push_back(g);
    }
  }
  std::vector<Label> marks;
  if (!any) return marks;
  std::map<Trait, Label> known;
  for (const Trait& trait : traits) {
    marks.push_back(known.try_emplace(trait, static_cast<Label>(known.size() + 1)).first->second);
  }
  return marks;
}

template <class Element>
void put(const std::vector<Label>& marks, std::vector<Element>& elements) {
  if (marks.empty()) return;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    elements[i].label = i < marks.size() ? marks[i] : 0;
  }
}

}  // namespace

SurfaceMarks mark_surface(const MeshData& data) {
  return {marks_of(data.triangles, data.triangle_parts, data.groups, 2),
          marks_of(data.edges, data.edge_parts, data.groups, 1)};
}

void put_marks(const SurfaceMarks& marks, MeshData& data) {
  put(marks.triangles, data.triangles);
  put(marks.edges, data.edges);
}

}  // namespace tetmend::face
