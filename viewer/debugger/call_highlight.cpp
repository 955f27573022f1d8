// SPDX-License-Identifier: MIT
#include "viewer/debugger/call_highlight.h"

#include <algorithm>
#include <optional>

#include "kernel/shell.h"
#include "kernel/star.h"
#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

namespace {

std::optional<glm::dvec3> place_of_corner(const std::vector<LocalTet>& tets, VertexHandle v) {
  for (const LocalTet& tet : tets) {
    for (unsigned i = 0; i < 4; ++i) {
      if (tet.vertices[i] == v) return to_glm(tet.corners[i]);
    }
  }
  return std::nullopt;
}

}  // namespace

Highlight highlight_covering(const CallStudy& study, const PolygonView& polygon,
                             const glm::dvec3& origin) {
  Highlight highlight;
  if (polygon.covering == nullptr) return highlight;
  const auto& ring = polygon.shell->ring;
  const auto line = [&](unsigned i, unsigned j, const Colour& colour, float width) {
    const auto from = place_of_corner(study.before, ring[i]);
    const auto to = place_of_corner(study.before, ring[j]);
    if (!from || !to) return;
    highlight.lines.push_back({glm::vec3(*from - origin), glm::vec3(*to - origin), colour, width});
  };
  for (const FlatCovering::Triangle& t : polygon.covering->triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      line(t.corners[i], t.corners[(i + 1) % 3], kChordColour, 3);
    }
  }
  const bool is_edge_made = polygon.covering->triangles.empty();  // in the place of faces
  for (const FlatCovering::Side& side : polygon.covering->core) {
    line(side.from, side.to, is_edge_made ? kSkirtColour : kCoreColour, 5);
  }
  return highlight;
}

Highlight highlight_cell(const CallStudy& study, const PolygonView& polygon,
                         const glm::dvec3& origin) {
  constexpr std::uint8_t kClear = 70;
  Highlight highlight;
  if (!polygon.cell) return highlight;
  const auto place = [&](unsigned i) {
    return place_of_corner(study.before, polygon.shell->ring[i]);
  };
  const auto from = place(polygon.cell->i);
  const auto to = place(polygon.cell->j);
  if (!from || !to) return highlight;
  const auto line = [&](const glm::dvec3& p, const glm::dvec3& q, float width) {
    highlight.lines.push_back({glm::vec3(p - origin), glm::vec3(q - origin), kCellColour, width});
  };
  line(*from, *to, 5);
  const unsigned k = polygon.shell->tables.k(polygon.cell->i, polygon.cell->j);
  const auto apex = k < polygon.shell->ring.size() ? place(k) : std::nullopt;
  if (!apex) return highlight;
  line(*from, *apex, 2.5F);
  line(*apex, *to, 2.5F);
  Colour fill = kCellColour;
  fill.alpha = kClear;
  add_triangle(highlight.faces, {*from, *apex, *to}, fill, origin);
  return highlight;
}

Highlight highlight_caller(const TetMesh& mesh, TetEdge edge, const glm::dvec3& origin) {
  constexpr std::uint8_t kFaint = 26;
  Highlight highlight;
  Colour fill = kGhostColour;
  fill.alpha = kFaint;
  for (const TetHandle t : ring(mesh, edge).tets) {
    const auto c = corners(mesh, t);
    for (const auto& f : kFaceVertices) {
      add_triangle(highlight.faces, {c[f[0]], c[f[1]], c[f[2]]}, fill, origin);
    }
    for (const auto& ends : kEdgeVertices) {
      highlight.lines.push_back(
          {glm::vec3(c[ends[0]] - origin), glm::vec3(c[ends[1]] - origin), kGhostColour, 1.5F});
    }
  }
  return highlight;
}

Highlight highlight_face(const TetMesh& mesh, const std::array<VertexHandle, 3>& face,
                         const glm::dvec3& origin) {
  constexpr std::uint8_t kClear = 165;  // over red, it is its own colour still
  Highlight highlight;
  std::array<glm::dvec3, 3> c;
  for (unsigned i = 0; i < 3; ++i) {
    if (face[i].index() >= mesh.vertex_slots() || mesh.is_deleted(face[i])) return {};
    c[i] = to_glm(mesh.point(face[i]));
  }
  Colour fill = kFaceToRemoveColour;
  fill.alpha = kClear;
  add_triangle(highlight.faces, c, fill, origin);
  for (unsigned i = 0; i < 3; ++i) {
    highlight.lines.push_back(
        {glm::vec3(c[i] - origin), glm::vec3(c[(i + 1) % 3] - origin), kFaceToRemoveColour, 2});
  }
  return highlight;
}

std::vector<TetHandle> tets_of(const TetMesh& mesh, const Selection& selection) {
  std::vector<TetHandle> found;
  if (const auto* t = std::get_if<TetHandle>(&selection)) {
    found.push_back(*t);
  } else if (const auto* e = std::get_if<TetEdge>(&selection)) {
    for (const TetHandle around : ring(mesh, *e).tets) found.push_back(around);
  } else if (const auto* f = std::get_if<HalfFace>(&selection)) {
    found.push_back(f->tet());
    if (!mesh.twin(*f).is_outside()) found.push_back(mesh.twin(*f).tet());
  } else if (const auto* v = std::get_if<VertexHandle>(&selection)) {
    if (!mesh.tet_of(*v).is_valid()) return found;
    for (const TetHandle around : star(mesh, *v)) found.push_back(around);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Selection target_in(const TetMesh& mesh, const Call& call, std::span<const TetHandle> around) {
  const auto target = call.target();
  if (target.empty() || around.empty()) return {};
  if (target.size() == 1) return target[0];
  if (target.size() == 2) return *edge_in(mesh, around.front(), target[0], target[1]);
  return around.front();
}

std::vector<TetHandle> tets_of(const TetMesh& mesh, const CallStudy& study) {
  std::vector<TetHandle> found;
  for (const auto* tets : {&study.before, &study.after}) {
    for (const LocalTet& tet : *tets) {
      const bool is_there = tet.tet.index() < mesh.tet_slots() && !mesh.is_deleted(tet.tet);
      if (is_there) found.push_back(tet.tet);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace tetmend::viewer
