// SPDX-License-Identifier: MIT
// Quality measures against formulas written a second time.
#include "kernel/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/support/tets.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

constexpr Real kDegrees = 180 / std::numbers::pi_v<Real>;

TetPoints corner_tet() {
  return {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
}

double evaluate(const QualityMeasure& measure, const TetPoints& p) {
  return measure.evaluate(p[0], p[1], p[2], p[3]);
}

std::array<double, 6> angles_of(const TetPoints& p) {
  return dihedral_angles(p[0], p[1], p[2], p[3]);
}

/// Random tets of either orientation, some of them squeezed into slivers and needles.
std::vector<TetPoints> random_tets(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<TetPoints> tets;
  for (int i = 0; i < count; ++i) {
    TetPoints p;
    for (Point& x : p) x = Point(coordinate(random), coordinate(random), coordinate(random));
    if (i % 4 == 1) {
      for (Point& x : p) x.z() *= 1e-4;
    }
    if (i % 4 == 2) {
      for (Point& x : p) x.head<2>() *= 1e-3;
    }
    tets.push_back(p);
  }
  return tets;
}

// --- The same quantities in extended precision, by other formulas than the library's. ---

std::array<RealVector, 4> extended(const TetPoints& p) {
  return {p[0].cast<Real>(), p[1].cast<Real>(), p[2].cast<Real>(), p[3].cast<Real>()};
}

Real signed_volume(const TetPoints& p) {
  const auto x = extended(p);
  Matrix edges;
  edges << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  return edges.determinant() / 6;
}

Real sign_of_volume(const TetPoints& p) {
  return signed_volume(p) < 0 ? Real{-1} : Real{1};
}

/// Angle between the two faces at edge ij in radians: between the heights of k and l over the edge.
Real dihedral(const TetPoints& p, std::size_t i, std::size_t j) {
  const auto x = extended(p);
  const RealVector axis = (x[j] - x[i]).normalized();
  std::array<RealVector, 2> height;
  std::size_t found = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == i || k == j) continue;
    const RealVector side = x[k] - x[i];
    height[found++] = (side - axis.dot(side) * axis).normalized();
  }
  // Half-angle form: accurate near 0 and near 180 degrees alike.
  return 2 * std::atan2((height[0] - height[1]).norm(), (height[0] + height[1]).norm());
}

std::array<Real, 6> dihedrals(const TetPoints& p) {
  return {dihedral(p, 0, 1), dihedral(p, 0, 2), dihedral(p, 0, 3),
          dihedral(p, 1, 2), dihedral(p, 1, 3), dihedral(p, 2, 3)};
}

Real direct_minimum_sine(const TetPoints& p) {
  Real smallest = 1;
  for (const Real angle : dihedrals(p)) smallest = std::min(smallest, std::sin(angle));
  return sign_of_volume(p) * smallest;
}

Real direct_warped_minimum_sine(const TetPoints& p) {
  Real smallest = 1;
  for (const Real angle : dihedrals(p)) {
    const Real weight = 2 * angle > std::numbers::pi_v<Real> ? Real{0.75} : Real{1};
    smallest = std::min(smallest, weight * std::sin(angle));
  }
  return sign_of_volume(p) * smallest;
}

Real direct_largest_angle_sine(const TetPoints& p) {
  const auto angles = dihedrals(p);
  const Real largest = *std::max_element(angles.begin(), angles.end());
  return sign_of_volume(p) * (2 * largest > std::numbers::pi_v<Real> ? std::sin(largest) : Real{1});
}

Real direct_minimum_angle(const TetPoints& p) {
  const auto angles = dihedrals(p);
  return sign_of_volume(p) * *std::min_element(angles.begin(), angles.end()) * kDegrees;
}

Real direct_volume_length(const TetPoints& p) {
  const auto x = extended(p);
  Real squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) squares += (x[i] - x[j]).squaredNorm();
  }
  return 6 * std::numbers::sqrt2_v<Real> * signed_volume(p) / std::pow(squares / 6, Real{1.5});
}

/// Solves for the point of equal distance to the corners, and takes the inradius from the areas.
Real direct_radius_ratio(const TetPoints& p) {
  const auto x = extended(p);
  Matrix rows;
  RealVector right;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const RealVector& corner = x[static_cast<std::size_t>(i) + 1];
    rows.row(i) = 2 * (corner - x[0]).transpose();
    right(i) = (corner - x[0]).squaredNorm();
  }
  const Real circumradius = rows.fullPivLu().solve(right).norm();
  Real area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const RealVector& a = x[(i + 1) % 4];
    const RealVector& b = x[(i + 2) % 4];
    const RealVector& c = x[(i + 3) % 4];
    area += (b - a).cross(c - a).norm() / 2;
  }
  const Real inradius = 3 * std::abs(signed_volume(p)) / area;
  return sign_of_volume(p) * 3 * inradius / circumradius;
}

/// 3 det(S)^(2/3) / |S|_F^2, S the linear map from the regular tet of unit edges to this one.
Real direct_mean_ratio(const TetPoints& p) {
  const auto x = extended(p);
  const Real root3 = std::sqrt(Real{3});
  Matrix regular;
  regular << 1, Real{0.5}, Real{0.5},  //
      0, root3 / 2, root3 / 6,         //
      0, 0, std::sqrt(Real{2} / 3);
  Matrix edges;
  edges << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  const Matrix map = edges * regular.inverse();
  const Real root = std::cbrt(std::abs(map.determinant()));
  return sign_of_volume(p) * 3 * root * root / map.squaredNorm();
}

struct ReferenceMeasure {
  const char* name;
  Real (*evaluate)(const TetPoints& p);
};

constexpr std::array<ReferenceMeasure, 7> kReferences = {{
    {"min_sine", &direct_minimum_sine},
    {"min_angle", &direct_minimum_angle},
    {"volume_length", &direct_volume_length},
    {"radius_ratio", &direct_radius_ratio},
    {"mean_ratio", &direct_mean_ratio},
    {"warped_min_sine", &direct_warped_minimum_sine},
    {"largest_angle_sine", &direct_largest_angle_sine},
}};

// --- Quality vectors. ---

}  // namespace

TEST_CASE("every quality measure agrees with a direct formula on random tets") {
  REQUIRE(quality_measures().size() == kReferences.size());
  for (const ReferenceMeasure& reference : kReferences) {
    const QualityMeasure& measure = find_quality_measure(reference.name);
    for (const TetPoints& p : random_tets(400)) {
      const double expected = static_cast<double>(reference.evaluate(p));
      CAPTURE(reference.name);
      // The volume of a sliver loses four digits to cancellation, a needle a few more.
      CHECK(evaluate(measure, p) == doctest::Approx(expected).epsilon(1e-9).scale(1e-7));
    }
  }
}

TEST_CASE("dihedral angles agree with the angles between the heights over each edge") {
  for (const TetPoints& p : random_tets(400)) {
    const auto angles = angles_of(p);
    const auto expected = dihedrals(p);
    for (std::size_t e = 0; e < 6; ++e) {
      CHECK(angles[e] ==
            doctest::Approx(static_cast<double>(expected[e] * kDegrees)).epsilon(1e-8));
    }
  }
}

TEST_CASE("dihedral angles come in the order of the edges") {
  // The three edges at the right corner are perpendicular to a face, the others lie on the slope.
  const auto angles = angles_of(corner_tet());
  const double slope = std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi;
  for (const std::size_t e : {0u, 1u, 2u}) CHECK(angles[e] == doctest::Approx(90));
  for (const std::size_t e : {3u, 4u, 5u}) CHECK(angles[e] == doctest::Approx(slope));
  // Only edge 01 is long: the angle at edge 01 of this wedge is 20 degrees.
  const double turn = 20 * std::numbers::pi / 180;
  const auto wedge = dihedral_angles(Point(0, 0, -9), Point(0, 0, 9), Point(1, 0, 0),
                                     Point(std::cos(turn), std::sin(turn), 0));
  CHECK(wedge[0] == doctest::Approx(20));
}

TEST_CASE("the regular tet has the value named best, and no random tet has a better one") {
  for (const QualityMeasure& measure : quality_measures()) {
    CAPTURE(measure.name);
    CHECK(evaluate(measure, regular_tet()) == doctest::Approx(measure.best).epsilon(1e-14));
    for (const TetPoints& p : random_tets(400)) {
      CHECK(std::abs(evaluate(measure, p)) <= measure.best * (1 + 1e-14));
    }
  }
  for (const double angle : angles_of(regular_tet())) {
    CHECK(angle == doctest::Approx(70.528779365509308630).epsilon(1e-14));
  }
}

TEST_CASE("quality measures ignore translation, rotation and scale") {
  const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized()) *
                                    Eigen::AngleAxisd(-1.9, Point::UnitX()))
                                       .toRotationMatrix();
  for (const QualityMeasure& measure : quality_measures()) {
    for (const TetPoints& p : random_tets(100)) {
      const double expected = evaluate(measure, p);
      TetPoints moved = p;
      for (Point& x : moved) x = rotation * x + Point(3, -2, 1);
      CAPTURE(measure.name);
      CHECK(evaluate(measure, moved) == doctest::Approx(expected).epsilon(1e-7).scale(1e-5));
      for (const double scale : {1e-12, 1e-3, 1e3, 1e12}) {
        TetPoints scaled = p;
        for (Point& x : scaled) x *= scale;
        CHECK(evaluate(measure, scaled) == doctest::Approx(expected).epsilon(1e-9).scale(1e-7));
      }
    }
  }
}

TEST_CASE("even permutations of the vertices keep a quality, odd ones change its sign") {
  for (const QualityMeasure& measure : quality_measures()) {
    for (const TetPoints& p : random_tets(100)) {
      const double expected = evaluate(measure, p);
      std::array<std::size_t, 4> order = {0, 1, 2, 3};
      do {
        int inversions = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t j = 0; j < i; ++j) inversions += order[j] > order[i] ? 1 : 0;
        }
        const TetPoints q = {p[order[0]], p[order[1]], p[order[2]], p[order[3]]};
        const double sign = inversions % 2 == 0 ? 1 : -1;
        CAPTURE(measure.name);
        CHECK(evaluate(measure, q) == doctest::Approx(sign * expected).epsilon(1e-9).scale(1e-7));
      } while (std::next_permutation(order.begin(), order.end()));
    }
  }
}

TEST_CASE("degenerate tets have quality 0") {
  const std::vector<TetPoints> degenerate = {
      {Point(0, 0, 0), Point(0, 0, 0), Point(0, 0, 0), Point(0, 0, 0)},  // one point
      {Point(0, 0, 0), Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)},  // an edge of length 0
      {Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0), Point(0, 0, 1)},  // a face without area
      {Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0), Point(3, 0, 0)},  // a line
      {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)},  // a flat quadrilateral
      {Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0), Point(1, 1, 0)},  // a flat triangle
  };
  for (const QualityMeasure& measure : quality_measures()) {
    for (std::size_t i = 0; i < degenerate.size(); ++i) {
      CAPTURE(measure.name);
      CAPTURE(i);
      CHECK(evaluate(measure, degenerate[i]) == 0);
    }
  }
}

TEST_CASE("flat tets have angles of exactly 0 and 180, degenerate faces angles of 0") {
  // Sliver seen along its flat side: the two diagonals have angles of 180, the four sides 0.
  const TetPoints square = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)};
  const std::array<double, 6> expected = {0, 180, 0, 0, 180, 0};
  CHECK(angles_of(square) == expected);
  const auto needle = angles_of({Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0), Point(0, 0, 1)});
  for (const std::size_t edge_of_collapsed_face : {0u, 1u, 3u}) {
    CHECK(needle[edge_of_collapsed_face] == 0);
  }
}

TEST_CASE("the angles of a sliver are exact to all digits near 0 and 180 degrees") {
  for (const double height : {1e-3, 1e-7, 1e-11}) {
    const TetPoints p = {Point(-1, 0, -height), Point(1, 0, -height), Point(0, -1, height),
                         Point(0, 1, height)};
    const auto angles = angles_of(p);
    // Seen along a long edge, the other one ends 1 to either side and 2 height away.
    const double blunt = 2 * std::atan2(1, 2 * height) * 180 / std::numbers::pi;
    CHECK(angles[0] == doctest::Approx(blunt).epsilon(1e-15));
    CHECK(angles[5] == doctest::Approx(blunt).epsilon(1e-15));
    const Real sharp = dihedral(p, 0, 2);
    const double expected = static_cast<double>(sharp * kDegrees);
    CHECK(angles[1] == doctest::Approx(expected).epsilon(1e-13).scale(0));
    const double sine = minimum_sine(p[0], p[1], p[2], p[3]);
    const double expected_sine = static_cast<double>(std::sin(sharp));
    CHECK(std::abs(sine) == doctest::Approx(expected_sine).epsilon(1e-13).scale(0));
  }
}

TEST_CASE("an inverted tet has the dihedral angles of its mirror image") {
  for (const TetPoints& p : random_tets(20)) {
    TetPoints mirrored = p;
    for (Point& x : mirrored) x.z() = -x.z();
    const auto angles = angles_of(p);
    const auto expected = angles_of(mirrored);
    for (std::size_t e = 0; e < 6; ++e) CHECK(angles[e] == doctest::Approx(expected[e]));
  }
}

TEST_CASE("the minimum sine cannot tell 30 from 150 degrees, the warped one can") {
  const double turn = 30 * std::numbers::pi / 180;
  const auto wedge = [](double angle) {
    return TetPoints{Point(0, 0, -0.5), Point(0, 0, 0.5), Point(1, 0, 0),
                     Point(std::cos(angle), std::sin(angle), 0)};
  };
  const auto& sine = find_quality_measure("min_sine");
  const auto& warped = find_quality_measure("warped_min_sine");
  CHECK(evaluate(sine, wedge(turn)) == doctest::Approx(0.5));
  CHECK(evaluate(warped, wedge(turn)) == doctest::Approx(0.5));
  CHECK(evaluate(warped, wedge(5 * turn)) == doctest::Approx(0.75 * std::sin(5 * turn)));
  const auto largest_sine = [](const TetPoints& p) {
    return largest_angle_sine(p[0], p[1], p[2], p[3]);
  };
  CHECK(largest_sine(wedge(turn)) == 1);  // no angle is obtuse
  CHECK(largest_sine(wedge(5 * turn)) == doctest::Approx(std::sin(5 * turn)));
}

TEST_CASE("the default quality measure is the minimum sine") {
  CHECK(quality_measures().front().name == "min_sine");
  for (const QualityMeasure& measure : quality_measures()) {
    CHECK(&find_quality_measure(measure.name) == &measure);
    CHECK(!measure.help.empty());
  }
}

TEST_CASE("an unknown quality measure is an error that names the word and the valid ones") {
  std::string message;
  try {
    find_quality_measure("min_sin");
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message.find("'min_sin'") != std::string::npos);
  for (const QualityMeasure& measure : quality_measures()) {
    CHECK(message.find(measure.name) != std::string::npos);
  }
  CHECK_THROWS_AS(find_quality_measure(""), Error);
}

TEST_CASE("quality is 1 where the goal is just met, whichever side of it is missed") {
  const auto wedge = [](double degrees) {
    const double turn = degrees * std::numbers::pi / 180;
    return TetPoints{Point(0, 0, -0.5), Point(0, 0, 0.5), Point(1, 0, 0),
                     Point(std::cos(turn), std::sin(turn), 0)};
  };
  for (const Goal goal : {Goal{}, Goal{35, 140}, Goal{20, 160}, Goal{40, 138}}) {
    CAPTURE(goal.min_angle);
    const Standard standard(goal);
    const auto quality = [&](double degrees) {
      const TetPoints p = wedge(degrees);
      return standard.quality(p[0], p[1], p[2], p[3]);
    };
    for (const double angle : {goal.min_angle, goal.max_angle}) {
      CHECK(quality(angle) == doctest::Approx(1));
      CHECK(standard.quality_of_angle(angle) == doctest::Approx(1));
    }
    CHECK(quality(goal.min_angle - 0.1) < 1);
    CHECK(quality(goal.min_angle + 0.1) > 1);
    CHECK(quality(goal.max_angle + 0.1) < 1);
    CHECK(quality(goal.max_angle - 0.1) > 1);
  }
}

TEST_CASE("the default goal takes sines of exactly a half, so qualities are twice the sine") {
  const Standard standard(Goal{}, Standard::Terms::sine);
  for (const TetPoints& p : random_tets(200)) {
    CHECK(standard.quality(p[0], p[1], p[2], p[3]) == 2 * minimum_sine(p[0], p[1], p[2], p[3]));
  }
}

TEST_CASE("a needle is bad though its angles are good, but never worse than a share of the goal") {
  const auto needle = [](double length) {
    const double turn = 2 * std::numbers::pi / 3;
    const double radius = 1 / std::sqrt(3.0);
    TetPoints p;
    for (int i = 0; i < 3; ++i) {
      p[static_cast<std::size_t>(i)] =
          Point(radius * std::cos(turn * i), radius * std::sin(turn * i), 0);
    }
    p[3] = Point(0, 0, -std::sqrt(length * length - 1.0 / 3));
    std::swap(p[0], p[1]);
    if (volume6(p[0], p[1], p[2], p[3]) < 0) std::swap(p[0], p[1]);
    return p;
  };
  const Standard both(Goal{});
  const Standard sine(Goal{}, Standard::Terms::sine);
  const auto of = [](const Standard& standard, const TetPoints& p) {
    return standard.quality(p[0], p[1], p[2], p[3]);
  };
  CHECK(of(both, needle(4)) == doctest::Approx(1));
  CHECK(of(sine, needle(4)) > 1.5);
  double last = 2;
  for (const double length : {5.0, 8.0, 20.0, 100.0}) {
    const double quality = of(both, needle(length));
    CHECK(quality < last);
    CHECK(quality > 0.4);
    last = quality;
  }
  CHECK(last == doctest::Approx(0.4).epsilon(0.01));
}

TEST_CASE("quality follows from sines and the volume-length measure") {
  const Standard standard(Goal{35, 140});
  const double flat = std::sqrt(standard.flat2());
  for (const TetPoints& p : random_tets(500)) {
    const auto angles = angles_of(p);
    double sines = 1e9;
    for (const double angle : angles) sines = std::min(sines, standard.quality_of_angle(angle));
    const double vl = volume_length(p[0], p[1], p[2], p[3]);
    const double needle2 = 432 * (1 - flat * flat) / standard.length();
    const double length = std::sqrt(flat * flat + (1 - flat * flat) * vl * vl / needle2);
    const double expected = std::copysign(std::min(sines, length), vl);
    CHECK(standard.quality(p[0], p[1], p[2], p[3]) == doctest::Approx(expected).epsilon(1e-6));
  }
}
