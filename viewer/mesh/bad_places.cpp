// SPDX-License-Identifier: MIT
#include "viewer/mesh/bad_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

namespace {

/// The box around the vertices of tets, divided into cubes.
class Grid {
 public:
  explicit Grid(const TetMesh& mesh) {
    glm::dvec3 high(-1e300);
    low_ = glm::dvec3(1e300);
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i))) continue;
      for (const VertexHandle v : mesh.vertices(TetHandle(i))) {
        const glm::dvec3 p = to_glm(mesh.point(v));
        low_ = glm::min(low_, p);
        high = glm::max(high, p);
      }
    }
    const glm::dvec3 size = high - low_;
    side_ = std::max({size.x, size.y, size.z}) / kPlacesAlong;
    if (!(side_ > 0)) side_ = 1;
    for (int k = 0; k < 3; ++k) {
      along_[static_cast<std::size_t>(k)] =
          std::clamp(static_cast<unsigned>(std::ceil(size[k] / side_)), 1U, kPlacesAlong);
    }
  }
  std::size_t size() const { return std::size_t{along_[0]} * along_[1] * along_[2]; }
  std::size_t place_of(const glm::dvec3& point) const {
    std::size_t place = 0;
    for (int k = 2; k >= 0; --k) {
      const unsigned count = along_[static_cast<std::size_t>(k)];
      const double step = std::clamp((point[k] - low_[k]) / side_, 0.0, count - 1.0);
      place = place * count + static_cast<std::size_t>(step);
    }
    return place;
  }
  Ball ball(std::size_t place) const {
    glm::dvec3 middle(0);
    for (int k = 0; k < 3; ++k) {
      const unsigned count = along_[static_cast<std::size_t>(k)];
      middle[k] = low_[k] + (static_cast<double>(place % count) + 0.5) * side_;
      place /= count;
    }
    return {middle, 0.5 * std::sqrt(3.0) * side_};
  }

 private:
  glm::dvec3 low_;
  double side_ = 1;
  std::array<unsigned, 3> along_{};
};

}  // namespace

std::vector<BadPlace> bad_places(const TetMesh& mesh, double below, std::size_t most) {
  if (mesh.tet_count() == 0) return {};
  const Standard& angles = mesh.standard().of_angles();
  const Grid grid(mesh);
  std::vector<BadPlace> places(grid.size());
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& v = mesh.vertices(t);
    glm::dvec3 centre(0);
    for (const VertexHandle corner : v) centre += 0.25 * to_glm(mesh.point(corner));
    BadPlace& place = places[grid.place_of(centre)];
    ++place.tets;
    if (static_cast<double>(mesh.quality(t)) >= below) continue;
    const auto q = static_cast<Quality>(
        angles.quality(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])));
    if (static_cast<double>(q) >= below) continue;
    if (place.bad == 0 || q < place.q_worst) {
      place.worst = t;
      place.q_worst = q;
    }
    ++place.bad;
  }
  for (std::size_t i = 0; i < places.size(); ++i) places[i].ball = grid.ball(i);
  std::erase_if(places, [](const BadPlace& place) { return place.bad == 0; });
  std::stable_sort(places.begin(), places.end(),
                   [](const BadPlace& a, const BadPlace& b) { return a.bad > b.bad; });
  if (places.size() > most) places.resize(most);
  return places;
}

}  // namespace tetmend::viewer
