// SPDX-License-Identifier: MIT
#include "viewer/mesh/visibility.h"

#include <algorithm>

namespace tetmend::viewer {

std::vector<Plane> planes_of(const SceneSettings& settings, const Ball& ball, bool exact) {
  std::vector<Plane> planes;
  for (const CutPlane& cut : settings.cuts) {
    if (!cut.on || cut.exact != exact) continue;
    const glm::dvec3 normal = glm::normalize(cut.normal);
    planes.push_back({normal, glm::dot(normal, ball.centre) + cut.position * ball.radius});
  }
  return planes;
}

glm::dvec3 to_glm(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

TetFilter::TetFilter(const TetMesh& mesh, const SceneSettings& settings, const TetFigures& figures,
                     const Ball& ball)
    : mesh_(mesh),
      settings_(settings),
      figures_(figures),
      planes_(planes_of(settings, ball, false)) {}

bool TetFilter::is_chosen(TetHandle t) const {
  if (mesh_.is_deleted(t)) return false;
  if (settings_.filtered) {
    const bool in_range = settings_.range.contains(static_cast<double>(figures_.values[t.index()]));
    if (in_range == settings_.outside) return false;
  }
  const auto& hidden = settings_.hidden_regions;
  return hidden.empty() || std::find(hidden.begin(), hidden.end(), mesh_.label(t)) == hidden.end();
}

bool TetFilter::is_cut_away(TetHandle t) const {
  const auto peel = static_cast<std::uint32_t>(settings_.peel);
  if (peel > 0 && figures_.layers[t.index()] < peel) return true;
  if (planes_.empty()) return false;
  const TetVertices& v = mesh_.vertices(t);
  const Point sum = mesh_.point(v[0]) + mesh_.point(v[1]) + mesh_.point(v[2]) + mesh_.point(v[3]);
  const glm::dvec3 centre = to_glm(sum) / 4.0;
  return std::any_of(planes_.begin(), planes_.end(),
                     [&](const Plane& plane) { return plane.height(centre) > 0; });
}

}  // namespace tetmend::viewer
