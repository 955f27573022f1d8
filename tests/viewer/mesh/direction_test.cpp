// SPDX-License-Identifier: MIT
#include "viewer/mesh/direction.h"

#include <doctest/doctest.h>

using namespace tetmend::viewer;

namespace {

/// Flat, in the plane x = 0, and a little thick.
const std::array<glm::dvec3, 4> kSliver = {{{0, 0, 0}, {0.01, 1, 1}, {-0.01, 1, 0}, {0, 0, 1}}};

}  // namespace

TEST_CASE("the shadow of a sliver is its square from the front and nearly nothing from the side") {
  CHECK(shadow_of(kSliver, {1, 0, 0}) == doctest::Approx(1).epsilon(0.02));
  CHECK(shadow_of(kSliver, {0, 1, 0}) < 0.03);
}

TEST_CASE("a sliver that is seen from its edge is turned to, one that is seen well is left") {
  Camera camera;
  camera.look_from("-y");
  turn_to(camera, kSliver);
  CHECK(shadow_of(kSliver, camera.forward()) > 0.8);
  const Camera turned = camera;
  turn_to(camera, kSliver);
  CHECK(camera == turned);
}

TEST_CASE("a tet without any area is no reason to turn") {
  Camera camera;
  const Camera before = camera;
  turn_to(camera, {{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}}});
  CHECK(camera == before);
}
