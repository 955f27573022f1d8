// SPDX-License-Identifier: MIT
#include "viewer/debugger/call_highlight.h"

#include <algorithm>
#include <optional>

#include "kernel/workspace.h"
#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

namespace {

std::optional<glm::dvec3> corner_of(const std::vector<LocalTet>& tets, VertexHandle v) {
  for (const LocalTet& tet : tets) {
    for (unsigned i = 0; i < 4; ++i) {
      if (tet.vertices[i] == v) return to_glm(tet.corners[i]);
    }
  }
  return std::nullopt;
}

bool contains_all(const TetVertices& tet, std::span<const VertexHandle> vertices) {
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](VertexHandle v) { return contains(tet, v); });
}

}  // namespace

Highlight highlight_covering(const CallStudy& study, const glm::dvec3& origin) {
  Highlight highlight;
  if (!study.picture || !study.covering) return highlight;
  const auto& ring = study.picture->ring;
  const auto line = [&](unsigned i, unsigned j, const Colour& colour, float width) {
    const auto from = corner_of(study.before, ring[i]);
    const auto to = corner_of(study.before, ring[j]);
    if (!from || !to) return;
    highlight.lines.push_back({glm::vec3(*from - origin), glm::vec3(*to - origin), colour, width});
  };
  for (const FlatCovering::Triangle& t : study.covering->triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      line(t.corners[i], t.corners[(i + 1) % 3], kChordColour, 3);
    }
  }
  for (const FlatCovering::Side& side : study.covering->core) {
    line(side.from, side.to, kCoreColour, 5);
  }
  return highlight;
}

Selection target_in(const TetMesh& mesh, const Call& call) {
  const auto target = call.target();
  for (const VertexHandle v : target) {
    const bool is_there = v.index() < mesh.vertex_slots() && !mesh.is_deleted(v);
    if (!is_there || !mesh.tet_of(v).is_valid()) return {};
  }
  if (target.empty()) return {};
  if (target.size() == 1) return target[0];
  // A star may be large and touch itself: looking at all tets is as good.
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !contains_all(mesh.vertices(t), target)) continue;
    if (target.size() == 2) return *edge_in(mesh, t, target[0], target[1]);
    return t;
  }
  return {};
}

std::vector<std::uint8_t> tets_of(const TetMesh& mesh, const CallStudy& study) {
  std::vector<std::uint8_t> mask(mesh.tet_slots());
  for (const auto* tets : {&study.before, &study.after}) {
    for (const LocalTet& tet : *tets) {
      const std::uint32_t slot = tet.tet.index();
      if (slot < mask.size() && !mesh.is_deleted(tet.tet)) mask[slot] = 1;
    }
  }
  return mask;
}

}  // namespace tetmend::viewer
