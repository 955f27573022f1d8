// SPDX-License-Identifier: MIT
// The surface of a mesh and its bad tets, packed for a page.
//
//   65,536 places along the longest side of the box; vertices along a Hilbert curve, all lists
//   sorted; differences as numbers of 7 bits; zlib; base64
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "face/portrait.h"

namespace tetmend::report {

/// Tets that a report names one by one.
inline constexpr std::size_t kMostWorst = 12;

struct ShapeLimits {
  std::size_t triangles = 100'000;  ///< of a larger surface only the sharpest edges are shown
  std::size_t edges = 40'000;
  std::size_t tets = 25'000;    ///< of each mesh; the worst
  std::size_t bytes = 800'000;  ///< of base64
};

struct Shape {
  /// What is in the data, in its order: "origin" and "step" of the places, the "bytes" when
  /// unpacked, then how many "vertices", "triangles", "walls", "edges", "bad_before", "bad_after".
  /// And "all_triangles", "all_walls", "all_edges", "all_bad_before", "all_bad_after": how many there
  /// are. "triangles" is 0 where the surface is too large, and so are "walls", the triangles between
  /// regions. "labels" has label and colour of each region. Behind the triangles the data have for
  /// each its place in that list, if there is more than one, and behind the walls two: of the region
  /// behind, and of that in front. "worst" has centre and radius of the first kMostWorst tets of
  /// bad_after, in steps.
  nlohmann::json about;
  std::string data;
};

/// Shows fewer tets, then fewer edges, until all is within the limits.
Shape pack_shape(const face::Portrait& portrait, const ShapeLimits& limits = {});

}  // namespace tetmend::report
