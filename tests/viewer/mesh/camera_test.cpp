// SPDX-License-Identifier: MIT
#include "viewer/mesh/camera.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernel/error.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

constexpr Canvas kCanvas = {800, 600};

Camera some_camera(bool orthographic) {
  Camera camera;
  camera.target = {10, -3, 2};
  camera.distance = 7;
  camera.yaw = 33;
  camera.pitch = -20;
  camera.orthographic = orthographic;
  return camera;
}

}  // namespace

TEST_CASE("the ray through the pixel of a point meets the point") {
  for (const bool orthographic : {false, true}) {
    const Camera camera = some_camera(orthographic);
    const glm::dvec3 point(10.5, -2.25, 2.125);
    const auto pixel = camera.project(point, kCanvas);
    REQUIRE(pixel);
    const Ray ray = camera.ray(pixel->x, pixel->y, kCanvas);
    const glm::dvec3 d = point - ray.origin;
    CHECK(glm::length(glm::cross(d, ray.direction)) < 1e-9);
  }
}

TEST_CASE("matrices and project() put a point on the same pixel") {
  for (const bool orthographic : {false, true}) {
    const Camera camera = some_camera(orthographic);
    const glm::dvec3 point(10.5, -2.25, 2.125);
    const glm::dvec3 origin(9, -4, 1);
    const Ball scene = {{10, -3, 2}, 3};
    const glm::dvec4 clip =
        camera.projection(kCanvas, scene) * camera.view(origin) * glm::dvec4(point - origin, 1);
    const auto pixel = camera.project(point, kCanvas);
    REQUIRE(pixel);
    CHECK(pixel->x == doctest::Approx((clip.x / clip.w + 1) / 2 * kCanvas.width));
    CHECK(pixel->y == doctest::Approx((1 - clip.y / clip.w) / 2 * kCanvas.height));
    CHECK(std::abs(clip.z) <= std::abs(clip.w));
  }
}

TEST_CASE("zooming keeps what is under the mouse in its place") {
  Camera camera = some_camera(true);
  const Ray before = camera.ray(650, 120, kCanvas);
  camera.zoom(3, 650, 120, kCanvas);
  const Ray after = camera.ray(650, 120, kCanvas);
  CHECK(glm::length(glm::cross(after.origin - before.origin, before.direction)) < 1e-9);
  CHECK(camera.distance == doctest::Approx(7.0 / 3));
}

TEST_CASE("panning moves the target with the mouse") {
  Camera camera = some_camera(false);
  const glm::dvec3 target = camera.target;
  camera.pan(50, -20, kCanvas);
  const auto pixel = camera.project(target, kCanvas);
  REQUIRE(pixel);
  CHECK(pixel->x == doctest::Approx(450));
  CHECK(pixel->y == doctest::Approx(280));
}

TEST_CASE("points that were fitted lie in the picture and touch its border") {
  for (const bool orthographic : {false, true}) {
    for (const Canvas canvas : {kCanvas, Canvas{200, 900}}) {
      Camera camera = some_camera(orthographic);
      const std::array<glm::dvec3, 4> points = {
          {{100, 0, 0}, {120, 3, 0}, {110, 1, 9}, {104, -8, 2}}};
      camera.fit(points, canvas);
      double nearest = 1e9;
      for (const glm::dvec3& p : points) {
        const auto pixel = camera.project(p, canvas);
        REQUIRE(pixel);
        nearest = std::min({nearest, pixel->x / canvas.width, 1 - pixel->x / canvas.width,
                            pixel->y / canvas.height, 1 - pixel->y / canvas.height});
      }
      CHECK(nearest > 0);
      CHECK(nearest < 0.1);
    }
  }
}

TEST_CASE("an unknown standard view is refused with the valid ones") {
  Camera camera;
  camera.look_from("+z");
  CHECK(camera.pitch == 90);
  CHECK_THROWS_WITH_AS(camera.look_from("up"), doctest::Contains("-z or home"), Error);
}
