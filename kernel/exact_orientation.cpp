// SPDX-License-Identifier: MIT
#include "kernel/exact_orientation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/chunks.h"
#include "kernel/exact_sum.h"
#include "kernel/geometry.h"

namespace tetmend {

namespace {

/// x - y, if that is a double: the error of a difference is one [shewchuk_predicates].
bool subtract_exactly(const Point& x, const Point& y, Point& difference) {
  for (int i = 0; i < 3; ++i) {
    const double z = x[i] - y[i];
    const double of_y = x[i] - z;
    const double of_x = z + of_y;
    if (!((x[i] - of_x) + (of_y - y[i]) == 0)) return false;
    difference[i] = z;
  }
  return true;
}

/// p . (q x r)
void add_triple(ExactSum<3>& sum, const Point& p, const Point& q, const Point& r, bool subtract) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum.add({p[i], q[j], r[k]}, subtract);
    sum.add({p[i], q[k], r[j]}, !subtract);
  }
}

template <std::size_t Points>
ExactSum<3> empty_sum(const std::array<const Point*, Points>& points) {
  std::array<double, 3 * Points> coordinates;
  auto place = coordinates.begin();
  for (const Point* p : points) place = std::copy(p->begin(), p->end(), place);
  return ExactSum<3>(coordinates);
}

/// By differences where they are exact, as on a lattice, which takes a quarter of the products.
int sign_by_integers(const Point& a, const Point& b, const Point& c, const Point& d) {
  Point u, v, w;
  if (subtract_exactly(b, a, u) && subtract_exactly(c, a, v) && subtract_exactly(d, a, w)) {
    ExactSum<3> sum = empty_sum<3>({&u, &v, &w});
    add_triple(sum, u, v, w, false);
    return sum.sign();
  }
  ExactSum<3> sum = empty_sum<4>({&a, &b, &c, &d});
  add_triple(sum, b, c, d, false);
  add_triple(sum, a, c, d, true);
  add_triple(sum, a, b, d, false);
  add_triple(sum, a, b, c, true);
  return sum.sign();
}

}  // namespace

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int sign = certified_sign(a, b, c, d);
  return sign != 0 ? sign : sign_by_integers(a, b, c, d);
}

bool is_turned_over(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double v6 = volume6(a, b, c, d);
  return std::isnormal(v6) ? v6 < 0 : exact_orientation(a, b, c, d) < 0;
}

ExactOrientation count_orientations(const TetMesh& mesh) {
  const auto parts =
      map_chunks<ExactOrientation>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        ExactOrientation count;
        for (std::size_t slot = begin; slot < end; ++slot) {
          const TetHandle t(static_cast<std::uint32_t>(slot));
          if (mesh.is_deleted(t)) continue;
          const TetVertices& v = mesh.vertices(t);
          const int sign = mesh.is_certified_positive(v)
                               ? 1
                               : exact_orientation(mesh.point(v[0]), mesh.point(v[1]),
                                                   mesh.point(v[2]), mesh.point(v[3]));
          ++(sign > 0 ? count.positive : sign < 0 ? count.negative : count.zero);
        }
        return count;
      });
  ExactOrientation sum;
  for (const ExactOrientation& part : parts) {
    sum.positive += part.positive;
    sum.zero += part.zero;
    sum.negative += part.negative;
  }
  return sum;
}

}  // namespace tetmend
