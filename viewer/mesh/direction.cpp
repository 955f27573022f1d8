// SPDX-License-Identifier: MIT
#include "viewer/mesh/direction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/handles.h"

namespace tetmend::viewer {

double shadow_of(const std::array<glm::dvec3, 4>& tet, const glm::dvec3& direction) {
  double twice = 0;  // each point of the shadow is under two faces
  for (const auto& f : kFaceVertices) {
    const glm::dvec3 normal = glm::cross(tet[f[1]] - tet[f[0]], tet[f[2]] - tet[f[0]]);
    twice += std::abs(glm::dot(normal, direction)) / 2;
  }
  return twice / 2;
}

namespace {

/// Calls visit(camera) for directions all around, evenly enough; none from straight above.
template <class Visit>
void for_each_direction(Camera camera, Visit visit) {
  constexpr int kStep = 10;  // degrees
  constexpr int kSteepest = 70;
  for (int yaw = -180; yaw < 180; yaw += kStep) {
    for (int pitch = -kSteepest; pitch <= kSteepest; pitch += kStep) {
      camera.yaw = yaw;
      camera.pitch = pitch;
      visit(camera);
    }
  }
}

}  // namespace

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 d = b - a;
  const double length2 = glm::dot(d, d);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + t * d);
}

void turn_to(Camera& camera, const std::array<glm::dvec3, 4>& tet) {
  constexpr double kNearly = 0.85;
  double largest = 0;
  for_each_direction(camera, [&](const Camera& turned) {
    largest = std::max(largest, shadow_of(tet, turned.forward()));
  });
  const glm::dvec3 now = camera.forward();
  if (shadow_of(tet, now) >= kNearly * largest) return;
  double least_turn = -2;  // as a cosine
  for_each_direction(camera, [&](const Camera& turned) {
    const double along = glm::dot(now, turned.forward());
    if (along <= least_turn || shadow_of(tet, turned.forward()) < kNearly * largest) return;
    least_turn = along;
    camera.yaw = turned.yaw;
    camera.pitch = turned.pitch;
  });
}

}  // namespace tetmend::viewer
