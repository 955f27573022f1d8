// SPDX-License-Identifier: MIT
// Whether the surface of a mesh is within a tolerance of another, by samples alone: shares no code with
// envelope/.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/tet_faces.h"
#include "tests/support/surface_distance.h"

namespace tetmend::test {

/// By the labels of both sides, the smaller first; outside is the smallest number.
using Surfaces = std::map<std::pair<Label, Label>, std::vector<Triangle>>;

inline Surfaces surfaces_of(const MeshData& data) {
  constexpr Label kOutside = std::numeric_limits<Label>::min();
  Surfaces all;
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    const Label here = data.tets[face.tet].label;
    const Label there = other == nullptr ? kOutside : data.tets[other->tet].label;
    if (here == there) return;
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = data.points[face.vertices[k]];
    all[std::minmax(here, there)].push_back(t);
  });
  return all;
}

inline double mean_edge(const Triangle& t) {
  return ((t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm()) / 3;
}

/// What a run with this surface may do at most, of each triangle.
inline double tolerance_of(const std::string& surface, const Triangle& t) {
  if (surface == "flat") return 1e-11;  // solids are some units large
  const double value = std::atof(surface.c_str());
  return surface.back() == '%' ? value / 100 * mean_edge(t) : value;
}

/// What is wrong; empty if nothing.
inline std::string complaint(const Surfaces& before, const Surfaces& now,
                             const std::string& surface) {
  if (before.size() != now.size()) return "a surface between two labels came or went";
  for (const auto& [sides, was] : before) {
    if (!now.contains(sides)) return "a surface between two labels is gone";
    const std::vector<Triangle>& is = now.at(sides);
    double most = 0;
    const TriangleGrid grid(is);
    for (const Triangle& t : was) {
      const double tolerance = tolerance_of(surface, t);
      most = std::max(most, tolerance);
      for (int a = 0; a <= 13; ++a) {
        for (int b = 0; a + b <= 13; ++b) {
          const Point p = t[0] + (t[1] - t[0]) * a / 13 + (t[2] - t[0]) * b / 13;
          if (grid.distance(p) > tolerance) return "a part of the old surface is lost";
        }
      }
    }
    if (sampled_distance(is, was) > most) return "the new surface is too far away";
  }
  return {};
}

}  // namespace tetmend::test
