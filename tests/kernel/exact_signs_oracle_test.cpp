// SPDX-License-Identifier: MIT
// Orientations and spheres against CGAL: its own numbers, exact by another way. A program of its
// own, since CGAL's rounding mode asks for -frounding-math.
//   build/release/tests/cgal_tests -tc='*ten million*' --no-skip      a minute
#include <array>
#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <doctest/doctest.h>

#include "kernel/exact_orientation.h"
#include "kernel/exact_sphere.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using tetmend::test::Random;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// Four vertices and, for spheres, a fifth point.
using Points = std::array<Point, 5>;

Kernel::Point_3 convert(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// From -most to most.
int integer(Random& random, int most) {
  return static_cast<int>(random.index(static_cast<std::size_t>(2 * most + 1))) - most;
}

template <class Make>
Points each_coordinate(const Make& make) {
  Points points;
  for (Point& p : points) {
    for (double& x : p) x = make();
  }
  return points;
}

Points at_random(Random& random) {
  return each_coordinate([&] { return random.real(-1, 1); });
}

/// On a lattice whose steps are no doubles, each coordinate a neighbouring double or the nearest.
Points near_a_lattice(Random& random) {
  const double step = random.real() < 0.5 ? 0.1 : 1;
  return each_coordinate([&] {
    const double x = integer(random, 2) * step;
    const double infinity = std::numeric_limits<double>::infinity();
    const double which = random.real();
    return which < 0.8 ? x : std::nextafter(x, which < 0.9 ? -infinity : infinity);
  });
}

/// Integers times a power of two: all in one plane.
Points in_a_plane(Random& random) {
  const auto vector = [&] {
    return Point(integer(random, 1000), integer(random, 1000), integer(random, 1000));
  };
  const Point origin = vector(), u = vector(), v = vector();
  const double size = std::ldexp(1, integer(random, 300));
  Points points;
  for (Point& p : points) p = size * (origin + integer(random, 9) * u + integer(random, 9) * v);
  return points;
}

/// In a plane as far as doubles can be.
Points nearly_in_a_plane(Random& random) {
  Points points = at_random(random);
  const Point u = points[1] - points[0], v = points[2] - points[0];
  for (std::size_t i = 3; i < 5; ++i) {
    points[i] = points[0] + random.real(-1, 2) * u + random.real(-1, 2) * v;
  }
  return points;
}

Points with_repeated_points(Random& random) {
  Points points = random.real() < 0.5 ? at_random(random) : near_a_lattice(random);
  points[random.index(5)] = points[random.index(5)];
  return points;
}

Points of_all_magnitudes(Random& random) {
  return each_coordinate([&] { return std::ldexp(integer(random, 1), integer(random, 60)); });
}

/// From denormal numbers to the largest doubles.
Points of_all_exponents(Random& random) {
  return each_coordinate([&] {
    const double digits = random.real() < 0.7 ? integer(random, 1) : random.real(-1, 1);
    return std::ldexp(digits, static_cast<int>(random.real(-1076, 1022)));
  });
}

/// A hard case, multiplied by a power of two: nothing is lost, but products leave the doubles.
Points of_extreme_size(Random& random) {
  Points points = random.real() < 0.5 ? near_a_lattice(random) : nearly_in_a_plane(random);
  const int exponent = random.real() < 0.5 ? -900 + integer(random, 60) : 960 + integer(random, 60);
  for (Point& p : points) {
    for (double& x : p) x = std::ldexp(x, exponent);
  }
  return points;
}

/// Denormal numbers alone.
Points of_denormals(Random& random) {
  const double unit = std::numeric_limits<double>::denorm_min();
  return each_coordinate([&] { return integer(random, 3) * unit; });
}

struct HardCases {
  const char* name;
  Points (*make)(Random&);
  double least_zeros;  ///< share of flat tets: the cases are hard, or this would prove nothing
};

constexpr std::array<HardCases, 9> kKinds = {{
    {"at random", at_random, 0},
    {"near a lattice", near_a_lattice, 0.01},
    {"in a plane", in_a_plane, 1},
    {"nearly in a plane", nearly_in_a_plane, 0},
    {"with repeated points", with_repeated_points, 0.1},
    {"of all magnitudes", of_all_magnitudes, 0.001},
    {"of all exponents", of_all_exponents, 0.001},
    {"of extreme size", of_extreme_size, 0.001},
    {"of denormals", of_denormals, 0.01},
}};

void compare_orientations(std::size_t count) {
  for (const HardCases& kind : kKinds) {
    CAPTURE(std::string(kind.name));
    Random random(1);
    std::size_t different = 0;
    std::size_t zeros = 0;
    const std::size_t of_kind = count / kKinds.size() + 1;
    for (std::size_t i = 0; i < of_kind; ++i) {
      const auto [a, b, c, d, p] = kind.make(random);
      const int sign = exact_orientation(a, b, c, d);
      different += sign != CGAL::orientation(convert(a), convert(b), convert(c), convert(d));
      zeros += sign == 0;
    }
    CHECK(different == 0);
    CHECK(static_cast<double>(zeros) >= kind.least_zeros * static_cast<double>(of_kind));
  }
}

}  // namespace

TEST_CASE("three hundred thousand orientations are those of CGAL") {
  compare_orientations(300000);
}

TEST_CASE("ten million orientations are those of CGAL" * doctest::skip()) {
  compare_orientations(10000000);
}

TEST_CASE("sides of spheres are those of CGAL") {
  for (const HardCases& kind : kKinds) {
    CAPTURE(std::string(kind.name));
    Random random(2);
    std::size_t different = 0;
    for (int i = 0; i < 5000; ++i) {
      const auto [a, b, c, d, p] = kind.make(random);
      const int side = side_of_sphere(a, b, c, d, p);
      different += side != CGAL::side_of_oriented_sphere(convert(a), convert(b), convert(c),
                                                         convert(d), convert(p));
    }
    CHECK(different == 0);
  }
}

TEST_CASE("corners of a cuboid lie on one sphere, and leave it by the smallest step") {
  Random random(3);
  const double infinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) {
    const double size = std::ldexp(1, integer(random, 200));
    const Point low = random.in_ball(size),
                high = low + Point::Constant(size) + random.in_ball(0.5 * size);
    const auto corner = [&](int bits) {
      return Point(bits & 1 ? high.x() : low.x(), bits & 2 ? high.y() : low.y(),
                   bits & 4 ? high.z() : low.z());
    };
    Point p = corner(7);
    CHECK(side_of_sphere(corner(0), corner(1), corner(2), corner(4), p) == 0);
    p.x() = std::nextafter(p.x(), infinity);
    CHECK(side_of_sphere(corner(0), corner(1), corner(2), corner(4), p) == -1);
  }
}
