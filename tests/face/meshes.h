// SPDX-License-Identifier: MIT
// What the tests of the public face work on.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>

#include <tetmend/io.h>
#include <tetmend/mesh.h>

#include "tests/support/assets.h"
#include "tests/support/errors.h"

namespace tetmend::test {

/// Two tets that share a face, every kind of entity, every label.
inline MeshArrays two_tet_arrays() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
          .point_labels = {0, 0, 3, 0, 0},
          .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
          .tet_labels = {7, 8},
          .triangles = {{1, 2, 3}, {0, 2, 1}},
          .triangle_labels = {5, -6},
          .edges = {{0, 1}},
          .edge_labels = {9},
          .required_vertices = {2}};
}

/// A cube of n x n x n cells of six tets each, whose inner points are off their places by chance.
inline MeshArrays shaken_cube(unsigned n, double by, unsigned seed = 1) {
  MeshArrays cube;
  std::minstd_rand random(seed);
  const auto shift = [&] { return by * (static_cast<double>(random()) / 2147483646.0 - 0.5); };
  const auto number = [n](const std::array<unsigned, 3>& p) {
    return p[0] + (n + 1) * (p[1] + (n + 1) * p[2]);
  };
  const auto is_inner = [n](unsigned i) { return i > 0 && i < n; };
  for (unsigned z = 0; z <= n; ++z) {
    for (unsigned y = 0; y <= n; ++y) {
      for (unsigned x = 0; x <= n; ++x) {
        std::array<double, 3> p = {double(x), double(y), double(z)};
        if (is_inner(x) && is_inner(y) && is_inner(z)) {
          for (double& c : p) c += shift();
        }
        cube.points.push_back(p);
        if (x == n || y == n || z == n) continue;
        std::array<unsigned, 3> axes = {0, 1, 2};
        do {
          std::array<unsigned, 3> corner = {x, y, z};
          std::array<std::uint32_t, 4> tet{};
          for (unsigned i = 0; i < 4; ++i) {
            tet[i] = number(corner);
            if (i < 3) ++corner[axes[i]];
          }
          cube.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return cube;
}

}  // namespace tetmend::test
