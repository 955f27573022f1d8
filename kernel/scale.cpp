// SPDX-License-Identifier: MIT
#include "kernel/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "kernel/chunks.h"
#include "kernel/error.h"
#include "kernel/geometry.h"

namespace tetmend {

namespace {

/// What the coordinates of some points lie between.
struct Extent {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  double least = std::numeric_limits<double>::infinity();  // magnitude that is not 0

  void add(const Point& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    for (const double x : p) {
      if (x != 0) least = std::min(least, std::abs(x));
    }
  }
  void add(const Extent& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    least = std::min(least, other.least);
  }
  double width() const { return (high - low).maxCoeff(); }
  double greatest() const {
    return std::max(high.cwiseAbs().maxCoeff(), low.cwiseAbs().maxCoeff());
  }
};

Extent extent_of(std::span<const Point> points) {
  const auto parts = map_chunks<Extent>(points.size(), [&](std::size_t begin, std::size_t end) {
    Extent part;
    for (std::size_t i = begin; i < end; ++i) part.add(points[i]);
    return part;
  });
  Extent all;
  for (const Extent& part : parts) all.add(part);
  return all;
}

void multiply(std::vector<Point>& points, double factor) {
  for_chunks(points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) points[i] *= factor;
  });
}

}  // namespace

Scale::Scale(int exponent)
    : exponent_(exponent),
      to_file_(std::ldexp(1.0, exponent)),
      to_work_(std::ldexp(1.0, -exponent)) {}

Scale Scale::of(std::span<const Point> points) {
  if (points.empty()) return {};
  const Extent extent = extent_of(points);
  const double width = std::min(extent.width(), std::numeric_limits<double>::max());
  if (!(width > 0)) return {};
  const double most = std::ldexp(1.0, kLargest);
  if (width > most || width < 1 / most) {
    throw Error(fmt::format(
        "the mesh is {:.3g} wide, which is too {}: its width must be from {:.1g} to {:.1g}", width,
        width > most ? "large" : "small", 1 / most, most));
  }
  const int exponent = std::ilogb(width);
  if (exponent >= kLeastOrdinary && exponent < kMostOrdinary) return {};
  const Scale scale(exponent + 1);
  constexpr double kLeastNormal = std::numeric_limits<double>::min();
  if (extent.least < kLeastNormal || scale.to_work(extent.least) < kLeastNormal ||
      !std::isfinite(scale.to_work(extent.greatest()))) {
    throw Error(
        fmt::format("coordinates from {:.3g} to {:.3g} are too far apart to be worked with exactly",
                    extent.least, extent.greatest()));
  }
  return scale;
}

void Scale::to_file(std::vector<Point>& points) const {
  if (!is_one()) multiply(points, to_file_);
}

void Scale::to_work(std::vector<Point>& points) const {
  if (!is_one()) multiply(points, to_work_);
}

bool is_lost(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = b - a;
  const Point v = c - a;
  const Point w = d - a;
  const double size =
      std::max({u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff()});
  if (size >= Scale::kShortestTet || size == 0) return false;
  const auto enlarged = [&](const Point& p) {
    const int exponent = -std::ilogb(size);
    return Point(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent),
                 std::ldexp(p.z(), exponent));
  };
  return certified_sign(Point::Zero(), enlarged(u), enlarged(v), enlarged(w)) != 0;
}

}  // namespace tetmend
