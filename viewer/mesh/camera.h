// SPDX-License-Identifier: MIT
// A camera that orbits a target, z upwards: plain arithmetic, no OpenGL.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace tetmend::viewer {

struct Ray {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0, 0, -1};  ///< unit length
};

/// A ball around what is to be seen.
struct Ball {
  glm::dvec3 centre{0};
  double radius = 1;
};

/// Size of a picture in pixels.
struct Canvas {
  int width = 1280;
  int height = 720;
  friend bool operator==(const Canvas&, const Canvas&) = default;
};

/// Turntable camera. Angles in degrees: yaw around z, from x towards y; pitch above the xy plane.
struct Camera {
  glm::dvec3 target{0};
  double distance = 4;  ///< of the eye from the target
  double yaw = kHomeYaw;
  double pitch = kHomePitch;
  bool orthographic = false;

  static constexpr double kHomeYaw = -55;
  static constexpr double kHomePitch = 25;
  static constexpr double kFieldOfView = 30;  ///< degrees, vertical

  glm::dvec3 forward() const;  ///< unit vector from the eye to the target
  glm::dvec3 right() const;
  glm::dvec3 up() const;
  glm::dvec3 eye() const { return target - distance * forward(); }
  /// Height of the picture at the target, in units of the mesh.
  double height_at_target() const;

  /// World to camera, where the world's origin is moved to `origin` first, so that single precision
  /// is enough for the result.
  glm::dmat4 view(const glm::dvec3& origin) const;
  /// Camera to clip space; the planes in front and behind enclose the ball.
  glm::dmat4 projection(const Canvas& canvas, const Ball& scene) const;

  /// Turns by pixels of the mouse: half a turn for 500 pixels.
  void orbit(double dx, double dy);
  /// Moves so that what is at the target follows the mouse.
  void pan(double dx, double dy, const Canvas& canvas);
  /// Divides the distance by `factor`, keeping what is under the pixel in place.
  void zoom(double factor, double x, double y, const Canvas& canvas);
  /// Moves until the ball, or the points, just fill the picture. The direction stays.
  void fit(const Ball& ball, const Canvas& canvas);
  void fit(std::span<const glm::dvec3> points, const Canvas& canvas);
  /// Direction of a standard view: "+x", "-x", "+y", "-y", "+z", "-z" (the side of the mesh that
  /// is seen) or "home". @throws Error for another name.
  void look_from(std::string_view side);

  /// The ray through a pixel; y counts downwards from the top.
  Ray ray(double x, double y, const Canvas& canvas) const;
  /// The pixel of a point; nothing when it lies behind the eye.
  std::optional<glm::dvec2> project(const glm::dvec3& point, const Canvas& canvas) const;

  friend bool operator==(const Camera&, const Camera&) = default;
};

}  // namespace tetmend::viewer
