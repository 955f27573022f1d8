// SPDX-License-Identifier: MIT
// Signs of tet volumes without rounding: the last word on whether a mesh is valid.
#pragma once

#include <cstddef>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// How many tets have a volume of each sign.
struct ExactOrientation {
  std::size_t positive = 0;
  std::size_t zero = 0;
  std::size_t negative = 0;
  friend bool operator==(const ExactOrientation&, const ExactOrientation&) = default;
};

/// Sign of volume6(a, b, c, d) in exact arithmetic: -1, 0 or 1. Precondition: finite coordinates.
/// Exact for all of them, from denormal numbers to the largest doubles, in any mixture. Cost:
/// floating-point operations decide nearly always (certified_sign), integers the rest (ExactSum).
int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// True if volume6() of the tet is negative; the exact one where the products leave the doubles.
bool is_turned_over(const Point& a, const Point& b, const Point& c, const Point& d);

/// Exact signs of all live tets. Cost: linear.
ExactOrientation count_orientations(const TetMesh& mesh);

}  // namespace tetmend
