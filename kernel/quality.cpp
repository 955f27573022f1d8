// SPDX-License-Identifier: MIT
// Quality measures of a tet.
#include "kernel/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "kernel/error.h"
#include "kernel/nearest_word.h"
#include "kernel/quality_of_points.h"

namespace tetmend {

namespace {

/// Edges, face normals and volume of a tet: what every measure below starts from.
struct Frame {
  std::array<Point, 4> p;
  std::array<Point, 4> normal;  // outward for a positive tet, length twice the area
  double v6;

  Frame(const Point& a, const Point& b, const Point& c, const Point& d)
      : p{a, b, c, d}, v6(volume6(a, b, c, d)) {
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [i, j, k] = kFaceVertices[f];
      normal[f] = (p[j] - p[i]).cross(p[k] - p[i]);
    }
  }
  Point edge(std::size_t e) const { return p[kEdgeVertices[e][1]] - p[kEdgeVertices[e][0]]; }
  double squared_edges() const {
    double sum = 0;
    for (std::size_t e = 0; e < 6; ++e) sum += edge(e).squaredNorm();
    return sum;
  }
  /// |sine| and cosine of the dihedral angle at edge e, both times the product of the two normals.
  std::array<double, 2> sine_cosine(std::size_t e) const {
    const auto& [k, l] = kEdgeVertices[5 - e];  // the faces at edge ij lie opposite k and l
    // 0 - x, not -x: a negative zero would turn the angle at a degenerate face from 0 into 180.
    return {std::abs(v6) * edge(e).norm(), 0.0 - normal[k].dot(normal[l])};
  }
};

}  // namespace

namespace {

/// 0.5 for 30 and 150 degrees, to the last bit.
double sine_of(double degrees) {
  constexpr double kDigits = 1e15;
  return std::round(std::sin(degrees * std::numbers::pi / 180) * kDigits) / kDigits;
}

/// Square of the volume-length measure of a needle: an equilateral triangle with an apex above its
/// middle, and edges to it that are `ratio` times as long as its sides.
double needle_volume_length2(double ratio) {
  const double height2 = ratio * ratio - 1.0 / 3;
  const double sum = 3 + 3 * ratio * ratio;
  return 432 * (0.75 * height2) / (sum * sum * sum);
}

/// Users take edges of a tet for similar up to this ratio.
constexpr double kNeedleRatio = 4;
/// Quality of a needle without volume.
constexpr double kFlat = 0.4;

}  // namespace

Standard::Standard(const Goal& goal, Terms terms, double price)
    : goal_(goal),
      terms_(terms),
      price_(price),
      acute2_(1 / (sine_of(goal.min_angle) * sine_of(goal.min_angle))),
      obtuse2_(1 / (sine_of(goal.max_angle) * sine_of(goal.max_angle))) {
  if (terms == Terms::sine) return;
  flat2_ = kFlat * kFlat;
  // VL^2 = 432 V6^2 / S^3.
  length_ = (1 - flat2_) * 432 / needle_volume_length2(kNeedleRatio);
}

Standard Standard::of(OwnMeasure measure, const Goal& goal, double price) {
  if (!is_name(measure.name)) {
    throw Error("measure '" + measure.name + "': the name is not made of a-z, 0-9 and _");
  }
  for (const std::string_view taken : {"sine", "sine_and_length", "own"}) {
    if (measure.name == taken) throw Error("measure '" + measure.name + "': the name is taken");
  }
  if (!(measure.good > 0) || !std::isfinite(measure.good)) {
    throw Error("measure '" + measure.name + "': the value of a good tet must be above 0");
  }
  Standard standard(goal, Terms::sine, price);
  standard.terms_ = Terms::own;
  standard.own_ = std::make_shared<const OwnMeasure>(std::move(measure));
  return standard;
}

Standard Standard::with_goal(const Goal& goal) const {
  Standard standard(goal, own_ ? Terms::sine : terms_, price_);
  standard.terms_ = terms_;
  standard.own_ = own_;
  return standard;
}

Standard Standard::with_price(double price) const {
  Standard standard = *this;
  standard.price_ = price;
  return standard;
}

std::string_view Standard::measure_name() const {
  return own_ ? std::string_view(own_->name) : to_string(terms_);
}

bool Standard::is_same(const Standard& a, const Standard& b) {
  if (a.own_ == b.own_) return true;
  return a.own_ && b.own_ && !a.own_->evaluate && !b.own_->evaluate &&
         a.own_->name == b.own_->name && a.own_->good == b.own_->good;
}

double Standard::quality(const Point& p0, const Point& p1, const Point& p2, const Point& p3) const {
  if (own_ != nullptr) return own_quality(p0, p1, p2, p3);
  return quality_of_points(*this, p0, p1, p2, p3);
}

double Standard::own_quality(const Point& p0, const Point& p1, const Point& p2,
                             const Point& p3) const {
  if (!own_->evaluate) return of_angles().quality(p0, p1, p2, p3);
  constexpr double kLeast = 1e-6;  // a tet that is turned over is told from a flat one
  constexpr double kMost = 1e6;
  const double v6 = volume6(p0, p1, p2, p3);
  if (!(v6 > 0) && !(v6 < 0)) return 0;
  const double value = own_->evaluate(p0, p1, p2, p3) / own_->good;
  if (v6 < 0) return -std::clamp(std::isnan(value) ? kMost : std::abs(value), kLeast, kMost);
  return value > 0 ? std::min(value, kMost) : 0;
}

double minimum_sine(const Point& p0, const Point& p1, const Point& p2, const Point& p3) {
  return Standard().quality(p0, p1, p2, p3);
}

double Standard::quality_of_angle(double degrees) const {
  return sine_of(degrees) * std::sqrt(degrees > 90 ? obtuse2_ : acute2_);
}

Standard::Terms to_terms(std::string_view name, std::string_view valid) {
  for (const auto terms : {Standard::Terms::sine, Standard::Terms::sine_and_length}) {
    if (name == to_string(terms)) return terms;
  }
  throw Error("unknown measure '" + std::string(name) + "'; valid: " + std::string(valid) +
              guess_of(name, valid));
}

std::string_view to_string(Standard::Terms terms) {
  switch (terms) {
    case Standard::Terms::sine:
      return "sine";
    case Standard::Terms::sine_and_length:
      return "sine_and_length";
    case Standard::Terms::own:
      return "own";
  }
  return "";
}

bool is_sound(const Goal& goal) {
  return goal.min_angle > 0 && goal.min_angle <= 70 && goal.max_angle >= 71 && goal.max_angle < 180;
}

std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c,
                                      const Point& d) {
  const Frame frame(a, b, c, d);
  std::array<double, 6> angles{};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [sine, cosine] = frame.sine_cosine(e);
    angles[e] = std::atan2(sine, cosine) * 180.0 / std::numbers::pi;
  }
  return angles;
}

double minimum_dihedral_angle(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto angles = dihedral_angles(a, b, c, d);
  const double smallest = *std::min_element(angles.begin(), angles.end());
  const double v6 = volume6(a, b, c, d);
  return v6 > 0 ? smallest : v6 < 0 ? -smallest : 0.0;
}

double volume_length(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Frame frame(a, b, c, d);
  const double mean_square = frame.squared_edges() / 6.0;
  if (!(mean_square > 0)) return 0;
  return std::numbers::sqrt2 * frame.v6 / (mean_square * std::sqrt(mean_square));
}

double radius_ratio(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Frame frame(a, b, c, d);
  double area2 = 0;  // twice the surface area
  for (const Point& n : frame.normal) area2 += n.norm();
  // R = |alpha| / (2 V6) with alpha = |u|^2 (v x w) + |v|^2 (w x u) + |w|^2 (u x v);  r = V6 / (sum
  // of |normals|).
  const Point u = b - a;
  const Point v = c - a;
  const Point w = d - a;
  const double alpha =
      (u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v))
          .norm();
  if (!(area2 > 0) || !(alpha > 0)) return 0;
  return 6.0 * frame.v6 * std::abs(frame.v6) / (area2 * alpha);
}

double mean_ratio(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Frame frame(a, b, c, d);
  const double squares = frame.squared_edges();
  if (!(squares > 0)) return 0;
  constexpr double kLeastNormal = std::numeric_limits<double>::min();
  const double half = 0.5 * std::abs(frame.v6);
  if (!(half >= kLeastNormal)) return 0;
  const double root = cube_root(half);
  return std::copysign(12.0 * root * root / squares, frame.v6);
}

namespace {

/// Smallest sine of the six angles, each times the factor of its kind, at most 1; 0 if a face is
/// degenerate.
double smallest_sine(const Frame& frame, double acute_factor, double obtuse_factor) {
  double smallest = 1;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [sine, cosine] = frame.sine_cosine(e);
    const auto& [k, l] = kEdgeVertices[5 - e];
    const double scale = frame.normal[k].norm() * frame.normal[l].norm();
    if (!(scale > 0)) return 0;
    smallest = std::min(smallest, sine / scale * (cosine < 0 ? obtuse_factor : acute_factor));
  }
  return smallest;
}

}  // namespace

double warped_minimum_sine(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Frame frame(a, b, c, d);
  const double smallest = smallest_sine(frame, 1, 0.75);
  return frame.v6 < 0 ? -smallest : smallest;
}

double largest_angle_sine(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Frame frame(a, b, c, d);
  const double smallest = smallest_sine(frame, std::numeric_limits<double>::infinity(), 1);
  return frame.v6 < 0 ? -smallest : smallest;
}

std::span<const QualityMeasure> quality_measures() {
  static constexpr double kRegularSine = 0.94280904158206336587;
  static constexpr std::array<QualityMeasure, 7> kMeasures = {{
      {"min_sine", "smallest sine of the six dihedral angles, signed (regular tet 0.9428)",
       &minimum_sine, kRegularSine},
      {"min_angle", "smallest dihedral angle in degrees, signed (regular tet 70.53)",
       &minimum_dihedral_angle, 70.528779365509308630},
      {"volume_length", "6 sqrt(2) V / l_rms^3 (regular tet 1)", &volume_length, 1},
      {"radius_ratio", "3 inradius / circumradius, signed (regular tet 1)", &radius_ratio, 1},
      {"mean_ratio", "12 (3 V)^(2/3) / sum of squared edges, signed (regular tet 1)", &mean_ratio,
       1},
      {"warped_min_sine", "minimum sine, obtuse angles times 0.75, signed (regular tet 0.9428)",
       &warped_minimum_sine, kRegularSine},
      {"largest_angle_sine", "sine of the largest dihedral angle if it is obtuse, else 1, signed",
       &largest_angle_sine, 1},
  }};
  return kMeasures;
}

const QualityMeasure& find_quality_measure(std::string_view name) {
  std::string valid;
  for (const QualityMeasure& measure : quality_measures()) {
    if (measure.name == name) return measure;
    valid += valid.empty() ? "" : ", ";
    valid += measure.name;
  }
  throw Error("unknown quality measure '" + std::string(name) + "'; valid: " + valid +
              guess_of(name, valid));
}

}  // namespace tetmend
