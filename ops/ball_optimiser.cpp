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

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
// Several tets at once on processors that can; the same operations in the same order everywhere.
#define TETMEND_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define TETMEND_WIDE
#endif

struct BallArrays {
  const double *ax, *ay, *az, *bx, *by, *bz, *cx, *cy, *cz, *nx, *ny, *nz, *n2, *ab2, *bc2, *ca2;
};

TETMEND_WIDE
void evaluate_ball(const BallArrays& ball, std::size_t size, double px, double py, double pz,
                   double* quality) {
  for (std::size_t i = 0; i < size; ++i) {
    const double ux = ball.ax[i] - px, uy = ball.ay[i] - py, uz = ball.az[i] - pz;
    const double vx = ball.bx[i] - px, vy = ball.by[i] - py, vz = ball.bz[i] - pz;
    const double wx = ball.cx[i] - px, wy = ball.cy[i] - py, wz = ball.cz[i] - pz;
    const double lx = vy * wz - vz * wy, ly = vz * wx - vx * wz, lz = vx * wy - vy * wx;
    const double mx = wy * uz - wz * uy, my = wz * ux - wx * uz, mz = wx * uy - wy * ux;
    const double kx = uy * vz - uz * vy, ky = uz * vx - ux * vz, kz = ux * vy - uy * vx;
    const double na = lx * lx + ly * ly + lz * lz;  // face opposite a
    const double nb = mx * mx + my * my + mz * mz;
    const double nc = kx * kx + ky * ky + kz * kz;
    const double np = ball.n2[i];
    const double u2 = ux * ux + uy * uy + uz * uz;
    const double v2 = vx * vx + vy * vy + vz * vz;
    const double w2 = wx * wx + wy * wy + wz * wz;
    const double v6 = ball.nx[i] * ux + ball.ny[i] * uy + ball.nz[i] * uz;
    const double at_p = std::min(std::min(u2 * na, v2 * nb), w2 * nc) * np;
    const double ab = ball.ab2[i] * (na * nb);
    const double bc = ball.bc2[i] * (nb * nc);
    const double ca = ball.ca2[i] * (nc * na);
    const double smallest = std::min(std::min(ab, bc), std::min(ca, at_p));
    const double product = (np * na) * (nb * nc);
    const double ratio = smallest / (product > 0 ? product : 1.0);
    quality[i] = product > 0 ? v6 * std::sqrt(ratio) : 0.0;
  }
}

}  // namespace

void BallOptimiser::clear() {
  size_ = 0;
}

void BallOptimiser::reserve(std::size_t size) {
  if (size <= capacity_) return;
  const std::size_t capacity = std::max<std::size_t>(64, 2 * size);
  std::vector<double> data(kFields * capacity);
  for (std::size_t f = 0; f < kFields; ++f) {
    std::copy_n(data_.data() + f * capacity_, size_, data.data() + f * capacity);
  }
  data_ = std::move(data);
  quality_.resize(capacity);
  capacity_ = capacity;
}

void BallOptimiser::add(const Point& a, const Point& b, const Point& c) {
  reserve(size_ + 1);
  const Point n = (b - a).cross(c - a);
  const std::array<double, kFields> row = {a.x(),
                                           a.y(),
                                           a.z(),
                                           b.x(),
                                           b.y(),
                                           b.z(),
                                           c.x(),
                                           c.y(),
                                           c.z(),
                                           n.x(),
                                           n.y(),
                                           n.z(),
                                           n.squaredNorm(),
                                           (b - a).squaredNorm(),
                                           (c - b).squaredNorm(),
                                           (a - c).squaredNorm()};
  for (std::size_t f = 0; f < kFields; ++f) data_[f * capacity_ + size_] = row[f];
  ++size_;
}

double BallOptimiser::worst(const Point& p) {
  const BallArrays ball = {field(ax), field(ay),  field(az),  field(bx), field(by), field(bz),
                           field(cx), field(cy),  field(cz),  field(nx), field(ny), field(nz),
                           field(n2), field(ab2), field(bc2), field(ca2)};
  evaluate_ball(ball, size_, p.x(), p.y(), p.z(), quality_.data());
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size_; ++i) smallest = std::min(smallest, quality_[i]);
  return smallest;
}

double BallOptimiser::total_deficit() const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i) sum += deficit(quality_[i]);
  return sum;
}

/// Gradients of the sines of one tet that lie below the band.
void BallOptimiser::add_gradients(std::size_t i, const Point& p, double band, unsigned& count) {
  const Point a(field(ax)[i], field(ay)[i], field(az)[i]);
  const Point b(field(bx)[i], field(by)[i], field(bz)[i]);
  const Point c(field(cx)[i], field(cy)[i], field(cz)[i]);
  const Point normal(field(nx)[i], field(ny)[i], field(nz)[i]);
  const std::array<Point, 3> to = {a - p, b - p, c - p};
  const double v6 = normal.dot(to[0]);
  // Faces opposite a, b, c; their normals m and d log|m| / dp.
  std::array<double, 4> norm{};
  std::array<Point, 4> log_norm;
  for (unsigned f = 0; f < 3; ++f) {
    const Point& s = to[(f + 1) % 3];
    const Point& t = to[(f + 2) % 3];
    const Point m = s.cross(t);
    const double square = m.squaredNorm();
    if (!(square > 0)) return;
    norm[f] = std::sqrt(square);
    log_norm[f] = (s - t).cross(m) / square;
  }
  norm[3] = std::sqrt(field(n2)[i]);
  log_norm[3] = Point::Zero();
  if (!(norm[3] > 0)) return;

  const std::array<double, 3> far2 = {field(bc2)[i], field(ca2)[i], field(ab2)[i]};
  for (unsigned e = 0; e < 6 && count < kMaxActive; ++e) {
    // e < 3: edge from p to corner e, shared by the faces opposite the other two corners; else the
    // edge opposite corner e - 3, shared by the face opposite that corner and the one opposite p.
    const unsigned f = e < 3 ? (e + 1) % 3 : 3;
    const unsigned g = e < 3 ? (e + 2) % 3 : e - 3;
    const double length2 = e < 3 ? to[e].squaredNorm() : far2[e - 3];
    const double scale = std::sqrt(length2) / (norm[f] * norm[g]);
    const double sine = v6 * scale;
    if (sine > band) continue;
    Point log_part = -log_norm[f] - log_norm[g];
    if (e < 3) log_part -= to[e] / length2;
    gradients_[count++] = -scale * normal + sine * log_part;
  }
}

unsigned BallOptimiser::find_active(const Point& p, double worst, double width) {
  const double band = worst + width * std::max(std::abs(worst), 0.02);
  unsigned count = 0;
  for (std::size_t i = 0; i < size_ && count < kMaxActive; ++i) {
    if (quality_[i] <= band) add_gradients(i, p, band, count);
  }
  return count;
}

double BallOptimiser::local_length(const Point& p) const {
  double sum = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    sum += std::sqrt((Point(field(ax)[i], field(ay)[i], field(az)[i]) - p).squaredNorm());
  }
  return sum / static_cast<double>(size_);
}

/// Follows one direction from p. Returns the gain, 0 if there is none; p and `best` follow, `step`
/// is the last length tried.
double BallOptimiser::ascend(Point& p, double& best, double width, double length, double& step) {
  const unsigned count = find_active(p, best, width);
  if (count == 0) return 0;
  const Point direction = shortest_in_hull(gradients_.data(), count);
  const double slope = direction.norm();  // of the slowest active sine along the unit direction
  if (!(slope * length > 1e-3)) return 0;
  const Point unit = direction / slope;
  double gain = 0;
  double taken = 0;
  for (step = std::min(2 * step, 0.5 * length); step > 1e-4 * length; step *= 0.5) {
    const double value = worst(p + step * unit) - best;
    if (gain > 0 && value <= gain) break;
    if (value > gain) {
      gain = value;
      taken = step;
      if (gain > 0.8 * step * slope) break;
    }
  }
  if (gain > 0) {
    p += taken * unit;
    step = taken;
  }
  best = worst(p);
  return gain;
}

double BallOptimiser::optimise(Point& p, const Limits& limits) {
  // A wide band sees the ridge ahead, a narrow one the slope at hand.
  constexpr std::array<double, 3> kWidths = {0.03, 0.15, 0.004};
  double best = worst(p);
  const double length = local_length(p);
  double step = 0.25 * length;
  std::size_t width = 0;
  for (int i = 0; i < limits.steps && best < limits.enough && width < kWidths.size(); ++i) {
    if (ascend(p, best, kWidths[width], length, step) < limits.least_gain) {
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

/// Shortest vector in the hull of a simplex of up to four points; drops the points that do not
/// carry it.
Point reduce_simplex(std::array<Point, 4>& s, unsigned& count) {
  // All faces of the simplex, by bits; the best feasible one. At most 15 tiny systems.
  Point best = s[0];
  double best_square = std::numeric_limits<double>::infinity();
  unsigned best_mask = 1;
  for (unsigned mask = 1; mask < (1u << count); ++mask) {
    std::array<Point, 4> q = s;
    unsigned n = 0;
    for (unsigned i = 0; i < count; ++i) {
      if (mask >> i & 1u) q[n++] = s[i];
    }
    Point x = q[0];
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
    } else if (n == 4) {
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
  for (unsigned i = 0; i < count; ++i) {
    if (best_mask >> i & 1u) s[n++] = s[i];
  }
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
