// SPDX-License-Identifier: MIT
// Active-set ascent of the worst quality of a ball.
//
//   repeat: active = terms within a band above the worst
//           direction = shortest vector in the hull of their gradients; stop when nearly zero
//           step = halve from the last step until the worst quality rises; stop if it gains little
#include "search/ball_optimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/judge.h"
#include "kernel/quality_of_points.h"

namespace tetmend {

namespace {

/// Squares, with the signs, of the qualities of four tets with a common vertex p.
using Lanes = BallOptimiser::Lanes;
using Values = BallOptimiser::Values;

/// Computes what depends on the corners alone.
TETMEND_WIDE
void complete_triangles(Lanes* lanes, std::size_t count) {
  using B = BallOptimiser;
  for (std::size_t n = 0; n < count; ++n) {
    auto* ball = lanes[n].vectors();
    const WideVector ux = ball[B::bx] - ball[B::ax], vx = ball[B::cx] - ball[B::ax];
    const WideVector uy = ball[B::by] - ball[B::ay], vy = ball[B::cy] - ball[B::ay];
    const WideVector uz = ball[B::bz] - ball[B::az], vz = ball[B::cz] - ball[B::az];
    const WideVector wx = ball[B::cx] - ball[B::bx];
    const WideVector wy = ball[B::cy] - ball[B::by];
    const WideVector wz = ball[B::cz] - ball[B::bz];
    const WideVector nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    ball[B::nx] = nx;
    ball[B::ny] = ny;
    ball[B::nz] = nz;
    ball[B::n2] = nx * nx + ny * ny + nz * nz;
    ball[B::ab2] = ux * ux + uy * uy + uz * uz;
    ball[B::bc2] = wx * wx + wy * wy + wz * wz;
    ball[B::ca2] = vx * vx + vy * vy + vz * vz;
  }
}

/// Returns the smallest, or some value below `least_square` as soon as there is one. Begins with
/// the lanes `first`, which become those that ended the walk: they will often end the next as well.
TETMEND_WIDE
double evaluate_ball(const Lanes* lanes, std::size_t count, const Standard& standard,
                     const Point& p, Values* squares, double least_square, std::size_t& first) {
  using B = BallOptimiser;
  const WideVector zero = {};
  const bool is_even = standard.is_even();
  const WideVector acute = zero + standard.acute2(), obtuse = zero + standard.obtuse2();
  const double flat2 = standard.flat2();
  const double length = standard.length();
  const WidePoint at = {zero + p.x(), zero + p.y(), zero + p.z()};
  WideVector smallest = zero + std::numeric_limits<double>::infinity();
  std::size_t n = first;
  for (std::size_t left = count; left > 0; --left, n = n + 1 < count ? n + 1 : 0) {
    const auto* ball = lanes[n].vectors();
    const WidePoint u = WidePoint{ball[B::ax], ball[B::ay], ball[B::az]} - at;
    const WidePoint v = WidePoint{ball[B::bx], ball[B::by], ball[B::bz]} - at;
    const WidePoint w = WidePoint{ball[B::cx], ball[B::cy], ball[B::cz]} - at;
    const WidePoint link = {ball[B::nx], ball[B::ny], ball[B::nz]};
    // Inward normals of the faces opposite a, b, c.
    const WidePoint l = cross(v, w), m = cross(w, u), k = cross(u, v);
    const WideVector na = dot(l, l), nb = dot(m, m), nc = dot(k, k), np = ball[B::n2];
    const WideVector uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    const WideVector v6 = dot(link, u);
    WideVector at_a = uu * na, at_b = vv * nb, at_c = ww * nc;
    WideVector ab = ball[B::ab2] * (na * nb);
    WideVector bc = ball[B::bc2] * (nb * nc);
    WideVector ca = ball[B::ca2] * (nc * na);
    if (!is_even) {  // the link triangle's normal points outwards
      at_a *= dot(m, k) > zero ? obtuse : acute;
      at_b *= dot(k, l) > zero ? obtuse : acute;
      at_c *= dot(l, m) > zero ? obtuse : acute;
      ab *= dot(link, k) < zero ? obtuse : acute;
      bc *= dot(link, l) < zero ? obtuse : acute;
      ca *= dot(link, m) < zero ? obtuse : acute;
    }
    const WideVector at_p = smaller(smaller(at_a, at_b), at_c) * np;
    const WideVector least = smaller(smaller(smaller(ab, bc), ca), at_p);
    const WideVector product = (np * na) * (nb * nc);
    const WideVector ratio = least / (product > zero ? product : zero + 1.0);
    const WideVector sum = (uu + vv + ww) + (ball[B::ab2] + ball[B::bc2] + ball[B::ca2]);
    const WideVector by_length = flat2 + length * (v6 * v6) / (sum * sum * sum);
    const WideVector by_sines = magnitude(v6 * magnitude(v6) * (is_even ? acute * ratio : ratio));
    const WideVector size = smaller(by_length, by_sines);
    const WideVector square = product > zero ? (v6 < zero ? -size : size) : zero;
    *squares[n].vectors() = square;
    smallest = smaller(square, smallest);
    const auto below = square < least_square;
    if ((below[0] | below[1] | below[2] | below[3]) != 0) {
      first = n;
      break;
    }
  }
  double worst = smallest[0];
  for (std::size_t i = 1; i < B::kLanes; ++i) worst = smallest[i] < worst ? smallest[i] : worst;
  return worst;
}

/// Signed squares below this have roots that do not exceed `value`, whatever the rounding.
double square_below(double value) {
  constexpr double kRounding = 1e-12;
  const double less = value - kRounding * std::abs(value);
  return less * std::abs(less);
}

double signed_root(double square) {
  return square < 0 ? -std::sqrt(-square) : std::sqrt(square);
}

}  // namespace

void BallOptimiser::add(const Point& a, const Point& b, const Point& c) {
  const std::size_t n = size_ / kLanes;
  const std::size_t k = size_ % kLanes;
  if (n == lanes_.size()) lanes_.emplace_back();
  auto& of = lanes_[n].of;
  Field f = ax;
  for (const Point* p : {&a, &b, &c}) {
    for (int i = 0; i < 3; ++i) {
      if (k == 0) {
        of[f].fill((*p)[i]);
      } else {
        of[f][k] = (*p)[i];
      }
      f = static_cast<Field>(f + 1);
    }
  }
  ++size_;
  complete_ = false;
}

double BallOptimiser::worst_square(const Point& p, std::vector<Values>& squares,
                                   double least_square) {
  const std::size_t count = (size_ + kLanes - 1) / kLanes;
  if (!complete_) complete_triangles(lanes_.data(), count);
  complete_ = true;
  if (squares.size() < count) squares.resize(lanes_.size());
  if (standard_.is_own()) return own_worst_square(p, squares, least_square);
  return evaluate_ball(lanes_.data(), count, standard_, p, squares.data(), least_square, first_);
}

/// By a measure of a program, tet by tet.
double BallOptimiser::own_worst_square(const Point& p, std::vector<Values>& squares,
                                       double least_square) const {
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i) {
    const double q = quality_of_points(standard_, p, corner(ax, i), corner(bx, i), corner(cx, i));
    const double square = q * std::abs(q);
    squares[i / kLanes].of[0][i % kLanes] = square;
    worst = std::min(worst, square);
    if (square < least_square) break;
  }
  return worst;
}

double BallOptimiser::worst(const Point& p) {
  return signed_root(worst_square(p, square_, -std::numeric_limits<double>::infinity()));
}

double BallOptimiser::worst_above(const Point& p, double least) {
  const double reached = signed_root(worst_square(p, trial_, square_below(least)));
  if (reached > least) std::swap(square_, trial_);
  return reached;
}

double BallOptimiser::quality(std::size_t i) const {
  return signed_root(square_[i / kLanes].of[0][i % kLanes]);
}

double BallOptimiser::total_deficit() const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    if (square_[i / kLanes].of[0][i % kLanes] < kBadThreshold * kBadThreshold) {
      sum += deficit(quality(i));
    }
  }
  return sum;
}

/// Of a measure of a program, by differences.
void BallOptimiser::add_own_gradient(std::size_t i, const Point& p, unsigned& count) {
  constexpr double kShare = 1e-6;  // of the edge to a corner
  const Point a = corner(ax, i), b = corner(bx, i), c = corner(cx, i);
  const double step = kShare * (a - p).norm();
  if (!(step > 0)) return;
  Point gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Point more = p, less = p;
    more[axis] += step;
    less[axis] -= step;
    gradient[axis] = (quality_of_points(standard_, more, a, b, c) -
                      quality_of_points(standard_, less, a, b, c)) /
                     (more[axis] - less[axis]);
  }
  if (gradient.allFinite()) gradients_[count++] = gradient;
}

/// Gradients of the terms of one tet that lie below the band. Which do is decided by squares: few
/// do.
void BallOptimiser::add_gradients(std::size_t i, const Point& p, double band, unsigned& count) {
  const Point normal = corner(nx, i);
  const std::array<Point, 3> to = {corner(ax, i) - p, corner(bx, i) - p, corner(cx, i) - p};
  const double v6 = normal.dot(to[0]);
  // Faces opposite a, b, c: their normals; the last is the link triangle.
  std::array<Point, 3> face;
  std::array<double, 4> norm2{};
  for (unsigned f = 0; f < 3; ++f) {
    face[f] = to[(f + 1) % 3].cross(to[(f + 2) % 3]);
    norm2[f] = face[f].squaredNorm();
    if (!(norm2[f] > 0)) return;
  }
  norm2[3] = value(n2, i);
  if (!(norm2[3] > 0)) return;
  const auto log_gradient = [&](unsigned f) -> Point {  // d log|normal| / dp
    if (f == 3) return Point::Zero();
    return (to[(f + 1) % 3] - to[(f + 2) % 3]).cross(face[f]) * (1 / norm2[f]);
  };

  const std::array<double, 3> far2 = {value(bc2, i), value(ca2, i), value(ab2, i)};
  const double signed_square = v6 * std::abs(v6);
  const double band_square = band * std::abs(band);
  for (unsigned e = 0; e < 6 && count < kMaxActive; ++e) {
    // For e < 3, the edge from p to corner e, shared by the faces opposite the other two corners.
    // Else the edge opposite corner e - 3, shared by the face opposite that corner and the one
    // opposite p.
    const unsigned f = e < 3 ? (e + 1) % 3 : 3;
    const unsigned g = e < 3 ? (e + 2) % 3 : e - 3;
    const double length2 = e < 3 ? to[e].squaredNorm() : far2[e - 3];
    const double product = norm2[f] * norm2[g];
    double weight2 = standard_.acute2();
    if (!standard_.is_even()) {
      const double turn = e < 3 ? face[f].dot(face[g]) : -normal.dot(face[g]);
      if (turn > 0) weight2 = standard_.obtuse2();
    }
    if (signed_square * length2 * weight2 > band_square * product) continue;
    const double scale = std::sqrt(weight2 * (length2 / product));
    Point log_part = -log_gradient(f) - log_gradient(g);
    if (e < 3) log_part -= to[e] * (1 / length2);
    gradients_[count++] = -scale * normal + v6 * scale * log_part;
  }
  if (v6 > 0) add_length_gradient(i, p, band, count);
}

/// Gradient of the term of the length: the root of flat^2 + length V6^2 / S^3.
void BallOptimiser::add_length_gradient(std::size_t i, const Point& p, double band,
                                        unsigned& count) {
  const Point normal = corner(nx, i);
  const std::array<Point, 3> to = {corner(ax, i) - p, corner(bx, i) - p, corner(cx, i) - p};
  const double v6 = normal.dot(to[0]);
  const double sum = (to[0].squaredNorm() + to[1].squaredNorm() + to[2].squaredNorm()) +
                     (value(ab2, i) + value(bc2, i) + value(ca2, i));
  const double part = standard_.length() * v6 * v6 / (sum * sum * sum);
  const double square = standard_.flat2() + part;
  if (count == kMaxActive || square > band * std::abs(band)) return;
  // dV6 / dp = -normal, dS / dp = -2 (sum of the edges from p).
  const Point log_part = (-2 / v6) * normal + (6 / sum) * (to[0] + to[1] + to[2]);
  gradients_[count++] = part / (2 * std::sqrt(square)) * log_part;
}

unsigned BallOptimiser::find_active(const Point& p, double worst, double width) {
  const double band = worst + width * std::max(std::abs(worst), 0.04);
  const double band_square = band * std::abs(band);
  unsigned count = 0;
  for (std::size_t i = 0; i < size_ && count < kMaxActive; ++i) {
    if (square_[i / kLanes].of[0][i % kLanes] > band_square) continue;
    if (standard_.is_own()) {
      add_own_gradient(i, p, count);
    } else {
      add_gradients(i, p, band, count);
    }
  }
  return count;
}

double BallOptimiser::local_length(const Point& p) const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    sum += (corner(ax, i) - p).norm();
  }
  return sum / static_cast<double>(size_);
}

/// Follows one direction from p. Returns the gain, 0 if there is none; p and `best` follow, `step`
/// is the last length tried.
double BallOptimiser::ascend(Point& p, double& best, double width, double length, double& step,
                             double least_step) {
  const unsigned count = find_active(p, best, width);
  if (count == 0) return 0;
  if (restriction_ != nullptr) restriction_->turn_along(p, std::span(gradients_).first(count));
  const Point direction = shortest_in_hull(gradients_.data(), count);
  const double slope = direction.norm();  // of the slowest active term along the unit direction
  if (!(slope * length > 2e-3)) return 0;
  const Point unit = direction / slope;
  const double start = best;
  double gain = 0;
  double taken = 0;
  for (step = std::min(2 * step, 0.5 * length); step > least_step * length; step *= 0.5) {
    const double reached =
        signed_root(worst_square(place(p + step * unit), trial_, square_below(start + gain)));
    const double rise = reached - start;
    if (gain > 0 && rise <= gain) break;
    if (rise > gain) {
      gain = rise;
      taken = step;
      best = reached;
      std::swap(square_, trial_);
      if (gain > 0.8 * step * slope) break;
    }
  }
  if (gain > 0) {
    p = place(p + taken * unit);
    step = taken;
  }
  return gain;
}

double BallOptimiser::optimise_from(Point& p, double reached, const Limits& limits) {
  // A narrow band sees the slope at hand, a wide one the ridge ahead.
  constexpr std::array<double, 2> kWidths = {0.03, 0.15};
  double best = reached;
  const double length = local_length(p);
  double step = 0.25 * length;
  std::size_t width = 0;
  for (int i = 0; i < limits.steps && best < limits.enough && width < kWidths.size(); ++i) {
    if (ascend(p, best, kWidths[width], length, step, limits.least_step) < limits.least_gain) {
      if (best >= kBadThreshold) break;
      ++width;
      step = 0.1 * length;
    } else {
      width = 0;
    }
  }
  return best;
}

namespace {

// Whether the point of a line, plane or space nearest to the origin lies inside the segment,
// triangle or tet with the given corners; writes the point. Most do not, and few need all tests.

bool nearest_inside(const Point& p, const Point& q, Point& nearest) {
  const Point along = q - p;
  const double t = -p.dot(along) / along.squaredNorm();
  nearest = p + t * along;
  return t > 0 && t < 1;
}

bool nearest_inside(const Point& p, const Point& q, const Point& r, Point& nearest) {
  const Point normal = (q - p).cross(r - p);
  const double square = normal.squaredNorm();
  if (!(square > 0)) return false;
  const Point x = normal * (p.dot(normal) / square);
  nearest = x;
  return (q - x).cross(r - x).dot(normal) > 0 && (r - x).cross(p - x).dot(normal) > 0 &&
         (p - x).cross(q - x).dot(normal) > 0;
}

bool nearest_inside(const Point& p, const Point& q, const Point& r, const Point& s,
                    Point& nearest) {
  const double whole = (q - p).dot((r - p).cross(s - p));
  const Point rs = r.cross(s);
  nearest = Point::Zero();
  return q.dot(rs) / whole > 0 && -p.dot(rs) / whole > 0 && p.dot(q.cross(s)) / whole > 0 &&
         -p.dot(q.cross(r)) / whole > 0;
}

/// Shortest vector in the hull of a simplex of up to four points, whose last is new: the face that
/// carries the vector has it as a corner. Drops the other points.
Point reduce_simplex(std::array<Point, 4>& s, unsigned& count) {
  // The faces with the new point, by bits of the others; the best feasible one. At most 8 tiny
  // systems.
  const unsigned last = count - 1;
  Point best = s[last];
  double best_square = best.squaredNorm();
  unsigned best_mask = 0;
  for (unsigned mask = 1; mask < (1u << last); ++mask) {
    std::array<unsigned, 3> i{};
    unsigned n = 0;
    for (unsigned k = 0; k < last; ++k) {
      if (mask >> k & 1u) i[n++] = k;
    }
    Point x;
    const bool inside = n == 1   ? nearest_inside(s[i[0]], s[last], x)
                        : n == 2 ? nearest_inside(s[i[0]], s[i[1]], s[last], x)
                                 : nearest_inside(s[i[0]], s[i[1]], s[i[2]], s[last], x);
    if (!inside) continue;
    const double square = x.squaredNorm();
    if (square < best_square) {
      best = x;
      best_square = square;
      best_mask = mask;
    }
  }
  unsigned n = 0;
  for (unsigned i = 0; i < last; ++i) {
    if (best_mask >> i & 1u) s[n++] = s[i];
  }
  s[n++] = s[last];
  count = n;
  return best;
}

}  // namespace

Point shortest_in_hull(const Point* points, unsigned count) {
  std::array<Point, 4> simplex;
  unsigned n = 1;
  unsigned first = 0;
  for (unsigned i = 1; i < count; ++i) {
    if (points[i].squaredNorm() < points[first].squaredNorm()) first = i;
  }
  simplex[0] = points[first];
  Point x = simplex[0];
  for (int round = 0; round < 32; ++round) {
    // The point farthest against x; if none lies beyond the plane through x, x is the answer.
    unsigned support = 0;
    double lowest = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < count; ++i) {
      const double value = x.dot(points[i]);
      if (value < lowest) {
        lowest = value;
        support = i;
      }
    }
    const double square = x.squaredNorm();
    if (lowest >= square * (1 - 1e-6) || n == 4) break;
    simplex[n++] = points[support];
    x = reduce_simplex(simplex, n);
    if (x.squaredNorm() >= square) break;  // no progress left in rounding
  }
  return x;
}

}  // namespace tetmend
