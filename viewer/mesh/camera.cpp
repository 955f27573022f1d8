// SPDX-License-Identifier: MIT
#include "viewer/mesh/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "kernel/error.h"

namespace tetmend::viewer {

namespace {

constexpr double kDegreesPerPixel = 180.0 / 500.0;
constexpr double kMostPitch = 90;
constexpr double kRoomAround = 1.06;
constexpr double kTiny = 1e-12;

/// Pixel to [-1, 1] x [-1, 1], y upwards.
glm::dvec2 to_clip(double x, double y, const Canvas& canvas) {
  return {2 * x / canvas.width - 1, 1 - 2 * y / canvas.height};
}

double aspect(const Canvas& canvas) {
  return static_cast<double>(std::max(canvas.width, 1)) / std::max(canvas.height, 1);
}

}  // namespace

glm::dvec3 Camera::forward() const {
  const double y = glm::radians(yaw);
  const double p = glm::radians(pitch);
  return -glm::dvec3(std::cos(p) * std::cos(y), std::cos(p) * std::sin(y), std::sin(p));
}

glm::dvec3 Camera::right() const {
  const double y = glm::radians(yaw);
  return {-std::sin(y), std::cos(y), 0};
}

glm::dvec3 Camera::up() const {
  return glm::cross(right(), forward());
}

double Camera::height_at_target() const {
  return 2 * distance * std::tan(glm::radians(kFieldOfView / 2));
}

glm::dmat4 Camera::view(const glm::dvec3& origin) const {
  const glm::dvec3 from = eye() - origin;
  const glm::dvec3 r = right();
  const glm::dvec3 u = up();
  const glm::dvec3 f = forward();
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) {
    m[i][0] = r[i];
    m[i][1] = u[i];
    m[i][2] = -f[i];
  }
  m[3] = glm::dvec4(-glm::dot(r, from), -glm::dot(u, from), glm::dot(f, from), 1);
  return m;
}

glm::dmat4 Camera::projection(const Canvas& canvas, const Ball& scene) const {
  const double depth = glm::dot(scene.centre - eye(), forward());
  const double reach = 1.05 * scene.radius;
  if (orthographic) {
    const double h = height_at_target() / 2;
    const double w = h * aspect(canvas);
    return glm::ortho(-w, w, -h, h, depth - reach, depth + reach);
  }
  const double far = std::max(depth + reach, 1e-3 * reach);
  const double near = std::max(depth - reach, 1e-3 * far);
  return glm::perspective(glm::radians(kFieldOfView), aspect(canvas), near, far);
}

void Camera::orbit(double dx, double dy) {
  yaw = std::remainder(yaw - dx * kDegreesPerPixel, 360.0);
  pitch = std::clamp(pitch + dy * kDegreesPerPixel, -kMostPitch, kMostPitch);
}

void Camera::pan(double dx, double dy, const Canvas& canvas) {
  const double unit = height_at_target() / std::max(canvas.height, 1);
  target += unit * (dy * up() - dx * right());
}

void Camera::zoom(double factor, double x, double y, const Canvas& canvas) {
  const glm::dvec2 at = to_clip(x, y, canvas);
  const double before = height_at_target() / 2;
  distance = std::clamp(distance / factor, 1e-12, 1e12);
  const double gain = before - height_at_target() / 2;
  target += gain * (at.y * up() + at.x * aspect(canvas) * right());
}

void Camera::fit(const Ball& ball, const Canvas& canvas) {
  target = ball.centre;
  const double narrow = std::min(1.0, aspect(canvas));
  const double half = std::atan(narrow * std::tan(glm::radians(kFieldOfView / 2)));
  distance = kRoomAround * std::max(ball.radius, kTiny) / std::sin(half);
}

void Camera::fit(std::span<const glm::dvec3> points, const Canvas& canvas) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high = -low;
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  target = low / 2.0 + high / 2.0;
  const double slope = std::tan(glm::radians(kFieldOfView / 2));
  distance = kTiny;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - target;
    const double across =
        std::max(std::abs(glm::dot(d, up())), std::abs(glm::dot(d, right())) / aspect(canvas));
    const double nearer = orthographic ? 0 : -glm::dot(d, forward());
    distance = std::max(distance, kRoomAround * across / slope + nearer);
  }
}

void Camera::look_from(std::string_view side) {
  struct Side {
    std::string_view name;
    double yaw;
    double pitch;
  };
  constexpr std::array<Side, 7> kSides = {{{"+x", 0, 0},
                                           {"-x", 180, 0},
                                           {"+y", 90, 0},
                                           {"-y", -90, 0},
                                           {"+z", -90, 90},
                                           {"-z", -90, -90},
                                           {"home", kHomeYaw, kHomePitch}}};
  for (const Side& s : kSides) {
    if (s.name != side) continue;
    yaw = s.yaw;
    pitch = s.pitch;
    return;
  }
  throw Error(
      fmt::format("there is no standard view '{}': expected +x, -x, +y, -y, +z, -z or home", side));
}

Ray Camera::ray(double x, double y, const Canvas& canvas) const {
  const glm::dvec2 at = to_clip(x, y, canvas);
  const double half = height_at_target() / 2;
  const glm::dvec3 seen = target + half * (at.y * up() + at.x * aspect(canvas) * right());
  if (orthographic) return {seen - 1e3 * distance * forward(), forward()};
  return {eye(), glm::normalize(seen - eye())};
}

std::optional<glm::dvec2> Camera::project(const glm::dvec3& point, const Canvas& canvas) const {
  const glm::dvec3 d = point - eye();
  const double depth = glm::dot(d, forward());
  if (!orthographic && depth <= 0) return std::nullopt;
  const double half = (orthographic ? 1 : depth / distance) * height_at_target() / 2;
  const double u = glm::dot(d, right()) / (half * aspect(canvas));
  const double v = glm::dot(d, up()) / half;
  return glm::dvec2((u + 1) / 2 * canvas.width, (1 - v) / 2 * canvas.height);
}

}  // namespace tetmend::viewer
