// SPDX-License-Identifier: MIT
// Active-set ascent of the worst quality of a ball.
//
//   repeat: active = sines within a band above the worst
//           direction = shortest vector in the hull of their gradients; stop when it is nearly zero
//           step = halve from the last step until the worst quality rises; stop when the gain is
//           small
#include "ops/ball_optimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetmend {

namespace {

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Several tets at once on processors that can; the same operations in the same order everywhere.
#define TETMEND_WIDE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define TETMEND_WIDE
#endif

/// Squares, with the signs, of the minimum sines of four tets with a common vertex p.
using Lanes = BallOptimiser::Lanes;
using Values = BallOptimiser::Values;

// A vector of the compiler: one register or several, as the processor has them.
using Vector = double __attribute__((vector_size(sizeof(Values))));

/// Computes what depends on the corners alone.
TETMEND_WIDE
void complete_triangles(Lanes* lanes, std::size_t count) {
  using B = BallOptimiser;
  for (std::size_t n = 0; n < count; ++n) {
    auto* ball = reinterpret_cast<Vector*>(&lanes[n]);
    const Vector ux = ball[B::bx] - ball[B::ax], vx = ball[B::cx] - ball[B::ax];
    const Vector uy = ball[B::by] - ball[B::ay], vy = ball[B::cy] - ball[B::ay];
    const Vector uz = ball[B::bz] - ball[B::az], vz = ball[B::cz] - ball[B::az];
    const Vector wx = ball[B::cx] - ball[B::bx];
    const Vector wy = ball[B::cy] - ball[B::by];
    const Vector wz = ball[B::cz] - ball[B::bz];
    const Vector nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    ball[B::nx] = nx;
    ball[B::ny] = ny;
    ball[B::nz] = nz;
    ball[B::n2] = nx * nx + ny * ny + nz * nz;
    ball[B::ab2] = ux * ux + uy * uy + uz * uz;
    ball[B::bc2] = wx * wx + wy * wy + wz * wz;
    ball[B::ca2] = vx * vx + vy * vy + vz * vz;
  }
}

/// Returns the smallest.
TETMEND_WIDE
double evaluate_ball(const Lanes* lanes, std::size_t count, double px, double py, double pz,
                     Values* squares) {
  using B = BallOptimiser;
  const Vector zero = {};
  Vector smallest = zero + std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < count; ++n) {
    const auto* ball = reinterpret_cast<const Vector*>(&lanes[n]);
    const Vector ux = ball[B::ax] - px, uy = ball[B::ay] - py, uz = ball[B::az] - pz;
    const Vector vx = ball[B::bx] - px, vy = ball[B::by] - py, vz = ball[B::bz] - pz;
    const Vector wx = ball[B::cx] - px, wy = ball[B::cy] - py, wz = ball[B::cz] - pz;
    const Vector lx = vy * wz - vz * wy, ly = vz * wx - vx * wz, lz = vx * wy - vy * wx;
    const Vector mx = wy * uz - wz * uy, my = wz * ux - wx * uz, mz = wx * uy - wy * ux;
    const Vector kx = uy * vz - uz * vy, ky = uz * vx - ux * vz, kz = ux * vy - uy * vx;
    const Vector na = lx * lx + ly * ly + lz * lz;  // face opposite a
    const Vector nb = mx * mx + my * my + mz * mz;
    const Vector nc = kx * kx + ky * ky + kz * kz;
    const Vector np = ball[B::n2];
    const Vector at_a = (ux * ux + uy * uy + uz * uz) * na;
    const Vector at_b = (vx * vx + vy * vy + vz * vz) * nb;
    const Vector at_c = (wx * wx + wy * wy + wz * wz) * nc;
    const Vector v6 = ball[B::nx] * ux + ball[B::ny] * uy + ball[B::nz] * uz;
    const Vector ab = ball[B::ab2] * (na * nb);
    const Vector bc = ball[B::bc2] * (nb * nc);
    const Vector ca = ball[B::ca2] * (nc * na);
    Vector at_p = at_a < at_b ? at_a : at_b;
    at_p = (at_p < at_c ? at_p : at_c) * np;
    Vector least = ab < bc ? ab : bc;
    least = least < ca ? least : ca;
    least = least < at_p ? least : at_p;
    const Vector product = (np * na) * (nb * nc);
    const Vector ratio = least / (product > zero ? product : zero + 1.0);
    const Vector size = v6 < zero ? -v6 : v6;
    const Vector square = product > zero ? v6 * size * ratio : zero;
    *reinterpret_cast<Vector*>(&squares[n]) = square;
    smallest = square < smallest ? square : smallest;
  }
  double worst = smallest[0];
  for (std::size_t i = 1; i < B::kLanes; ++i) worst = smallest[i] < worst ? smallest[i] : worst;
  return worst;
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

double BallOptimiser::worst_square(const Point& p, std::vector<Values>& squares) {
  const std::size_t count = (size_ + kLanes - 1) / kLanes;
  if (!complete_) complete_triangles(lanes_.data(), count);
  complete_ = true;
  if (squares.size() < count) squares.resize(lanes_.size());
  return evaluate_ball(lanes_.data(), count, p.x(), p.y(), p.z(), squares.data());
}

double BallOptimiser::worst(const Point& p) {
  return signed_root(worst_square(p, square_));
}

double BallOptimiser::quality(std::size_t i) const {
  return signed_root(square_[i / kLanes].of[i % kLanes]);
}

double BallOptimiser::total_deficit() const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    if (square_[i / kLanes].of[i % kLanes] < kBadThreshold * kBadThreshold) {
      sum += deficit(quality(i));
    }
  }
  return sum;
}

/// Gradients of the sines of one tet that lie below the band. Which do is decided by squares: few
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
    // e < 3: edge from p to corner e, shared by the faces opposite the other two corners; else the
    // edge opposite corner e - 3, shared by the face opposite that corner and the one opposite p.
    const unsigned f = e < 3 ? (e + 1) % 3 : 3;
    const unsigned g = e < 3 ? (e + 2) % 3 : e - 3;
    const double length2 = e < 3 ? to[e].squaredNorm() : far2[e - 3];
    const double product = norm2[f] * norm2[g];
    if (signed_square * length2 > band_square * product) continue;
    const double scale = std::sqrt(length2 / product);
    Point log_part = -log_gradient(f) - log_gradient(g);
    if (e < 3) log_part -= to[e] * (1 / length2);
    gradients_[count++] = -scale * normal + v6 * scale * log_part;
  }
}

unsigned BallOptimiser::find_active(const Point& p, double worst, double width) {
  const double band = worst + width * std::max(std::abs(worst), 0.02);
  const double band_square = band * std::abs(band);
  unsigned count = 0;
  for (std::size_t i = 0; i < size_ && count < kMaxActive; ++i) {
    if (square_[i / kLanes].of[i % kLanes] <= band_square) add_gradients(i, p, band, count);
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
  const Point direction = shortest_in_hull(gradients_.data(), count);
  const double slope = direction.norm();  // of the slowest active sine along the unit direction
  if (!(slope * length > 1e-3)) return 0;
  const Point unit = direction / slope;
  const double start = best;
  double gain = 0;
  double taken = 0;
  for (step = std::min(2 * step, 0.5 * length); step > least_step * length; step *= 0.5) {
    const double reached = signed_root(worst_square(p + step * unit, trial_));
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
    p += taken * unit;
    step = taken;
  }
  return gain;
}

double BallOptimiser::optimise(Point& p, const Limits& limits) {
  // A narrow band sees the slope at hand, a wide one the ridge ahead.
  constexpr std::array<double, 2> kWidths = {0.03, 0.15};
  double best = worst(p);
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
    std::array<Point, 4> q;
    unsigned n = 0;
    for (unsigned i = 0; i < last; ++i) {
      if (mask >> i & 1u) q[n++] = s[i];
    }
    q[n++] = s[last];
    Point x;
    if (n == 2) {
      const Point d = q[1] - q[0];
      const double t = -q[0].dot(d) / d.squaredNorm();
      if (!(t > 0 && t < 1)) continue;
      x = q[0] + t * d;
    } else if (n == 3) {
      const Point normal = (q[1] - q[0]).cross(q[2] - q[0]);
      const double square = normal.squaredNorm();
      if (!(square > 0)) continue;
      x = normal * (q[0].dot(normal) / square);
      const double u = (q[1] - x).cross(q[2] - x).dot(normal);
      const double v = (q[2] - x).cross(q[0] - x).dot(normal);
      const double w = (q[0] - x).cross(q[1] - x).dot(normal);
      if (!(u > 0 && v > 0 && w > 0)) continue;
    } else {
      const double whole = (q[1] - q[0]).dot((q[2] - q[0]).cross(q[3] - q[0]));
      const double d0 = q[1].dot(q[2].cross(q[3])) / whole;
      const double d1 = -q[0].dot(q[2].cross(q[3])) / whole;
      const double d2 = q[0].dot(q[1].cross(q[3])) / whole;
      const double d3 = -q[0].dot(q[1].cross(q[2])) / whole;
      if (!(d0 > 0 && d1 > 0 && d2 > 0 && d3 > 0)) continue;
      x = Point::Zero();
    }
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
