// SPDX-License-Identifier: MIT
// Bowyer-Watson inside a huge tet, with exact predicates.
//
//   for each point: cavity = tets whose circumsphere holds it; replace them by tets from the point
//                   to each face of the cavity
//   in the end: drop the tets at the corners of the huge tet
#include "contract/delaunay.h"

#include <algorithm>
#include <map>

#include "kernel/exact_orientation.h"
#include "kernel/exact_sphere.h"
#include "kernel/handles.h"

namespace tetmend::contract {

std::vector<std::array<std::uint32_t, 4>> delaunay(std::span<const Point> points) {
  using Tet = std::array<std::uint32_t, 4>;
  using Face = std::array<std::uint32_t, 3>;
  std::vector<Point> p(points.begin(), points.end());
  const auto n = static_cast<std::uint32_t>(points.size());
  // So far away that every face of the convex hull gets its tet, short of nearly flat corners.
  constexpr double kFar = 0x1p40;
  p.emplace_back(kFar, kFar, kFar);
  p.emplace_back(-kFar, -kFar, kFar);
  p.emplace_back(-kFar, kFar, -kFar);
  p.emplace_back(kFar, -kFar, -kFar);
  Tet huge = {n, n + 1, n + 2, n + 3};
  if (exact_orientation(p[n], p[n + 1], p[n + 2], p[n + 3]) < 0) std::swap(huge[2], huge[3]);

  std::vector<Tet> tets = {huge};
  for (std::uint32_t i = 0; i < n; ++i) {
    std::vector<Tet> kept;
    // By sorted vertices: the face counterclockwise as seen from outside.
    std::map<Face, Face> open;
    for (const Tet& t : tets) {
      if (side_of_sphere(p[t[0]], p[t[1]], p[t[2]], p[t[3]], p[i]) <= 0) {
        kept.push_back(t);
        continue;
      }
      for (const auto& local : kFaceVertices) {
        const Face face = {t[local[0]], t[local[1]], t[local[2]]};
        Face key = face;
        std::sort(key.begin(), key.end());
        if (!open.emplace(key, face).second) open.erase(key);
      }
    }
    // The point lies inside of each face: swapped, face and point form a positive tet.
    for (const auto& [key, face] : open) kept.push_back({face[0], face[2], face[1], i});
    tets = std::move(kept);
  }
  std::erase_if(tets, [n](const Tet& t) {
    return std::any_of(t.begin(), t.end(), [n](std::uint32_t v) { return v >= n; });
  });
  return tets;
}

}  // namespace tetmend::contract
