// SPDX-License-Identifier: MIT
// Whether a point lies in the circumsphere of a tet, without rounding.
#pragma once

#include "kernel/mesh_data.h"

namespace tetmend {

/// 1 if p lies inside the sphere through the vertices of the positive tet (a, b, c, d), 0 if on it,
/// -1 if outside; of a negative tet the opposite sign. Of a flat one the sphere is a plane.
/// Precondition: finite coordinates; exact for all of them. Cost: floating-point operations decide
/// nearly always [shewchuk_predicates], integers the rest (ExactSum), about ten microseconds.
int side_of_sphere(const Point& a, const Point& b, const Point& c, const Point& d, const Point& p);

}  // namespace tetmend
