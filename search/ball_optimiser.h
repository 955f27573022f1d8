// SPDX-License-Identifier: MIT
// Where to put a vertex so that the worst tet of its ball is as good as possible. A pure unit:
// points in, point out.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/quality.h"
#include "kernel/wide.h"

namespace tetmend {

/// Where a vertex may go that must stay on a surface or line.
class PlaceRestriction {
 public:
  virtual ~PlaceRestriction() = default;
  /// Leaves of each vector the part that leads along the surface or line at p.
  virtual void turn_along(const Point& p, std::span<Point> vectors) const = 0;
  /// The place nearest to p that the vertex may take.
  virtual Point nearest(const Point& p) const = 0;
};

/// Maximises the smallest quality of a ball, given by the triangles of its link. A steepest
/// ascent for a function that is not smooth ([freitag_ollivier_gooch]). The direction is the
/// shortest vector in the convex hull of some gradients: those of the terms of the standard, sines
/// and length, that are nearly as small as the smallest.
class BallOptimiser {
 public:
  struct Limits {
    int steps = 40;            ///< directions tried
    double enough = 1.2;       ///< stop when the worst quality exceeds this
    double least_gain = 2e-5;  ///< stop when a step gains less
    double least_step = 1e-2;  ///< shortest step, as a share of the size of the ball
  };

  /// Begins a ball, to be judged by a standard.
  void clear(const Standard& standard) {
    standard_ = standard;
    size_ = first_ = 0;
    restriction_ = nullptr;
  }
  /// Of the ball that is loaded: optimise() looks only there. It must outlive that.
  void restrict_to(const PlaceRestriction& restriction) { restriction_ = &restriction; }
  /// A link triangle; (p, a, b, c) is positive for a vertex p inside the ball.
  void add(const Point& a, const Point& b, const Point& c);
  std::size_t size() const { return size_; }

  /// Smallest quality of the ball with its vertex at p. Keeps the values of the single tets,
  /// see quality(). Cost: linear.
  double worst(const Point& p);
  /// As worst(), if that exceeds `least`; otherwise some value that does not, and the values of the
  /// single tets stay as they are. Ends at the first tets that are not better.
  double worst_above(const Point& p, double least);
  /// Quality of the i-th tet added, with the vertex where worst(), worst_above() or optimise()
  /// last left it.
  double quality(std::size_t i) const;
  /// Sum of deficit() over the tets, likewise.
  double total_deficit() const;

  /// Ascends from p, moves p to the best place, and returns the quality there: at least that of the
  /// start.
  double optimise(Point& p, const Limits& limits) { return optimise_from(p, worst(p), limits); }
  /// The same where `reached` is known to be worst(p). Precondition: quality() is for p.
  double optimise_from(Point& p, double reached, const Limits& limits);

  // Four tets side by side; a lane that is not in use repeats another.
  static constexpr std::size_t kLanes = kWideLanes;
  // Corners; from these: normal of the triangle, squared normal, squared edges.
  enum Field { ax, ay, az, bx, by, bz, cx, cy, cz, nx, ny, nz, n2, ab2, bc2, ca2, kFields };
  using Lanes = WideRows<kFields>;
  using Values = WideRows<1>;

 private:
  static constexpr unsigned kMaxActive = 16;

  double worst_square(const Point& p, std::vector<Values>& squares, double least_square);
  unsigned find_active(const Point& p, double worst, double width);
  double ascend(Point& p, double& best, double width, double length, double& step,
                double least_step);
  void add_gradients(std::size_t tet, const Point& p, double band, unsigned& count);
  double own_worst_square(const Point& p, std::vector<Values>& squares, double least_square) const;
  void add_own_gradient(std::size_t tet, const Point& p, unsigned& count);
  void add_length_gradient(std::size_t tet, const Point& p, double band, unsigned& count);
  double local_length(const Point& p) const;
  Point place(const Point& p) const {
    return restriction_ == nullptr ? p : restriction_->nearest(p);
  }
  double value(Field f, std::size_t tet) const { return lanes_[tet / kLanes].of[f][tet % kLanes]; }
  Point corner(Field x, std::size_t tet) const {
    const Lanes& lanes = lanes_[tet / kLanes];
    const std::size_t k = tet % kLanes;
    return {lanes.of[x][k], lanes.of[x + 1][k], lanes.of[x + 2][k]};
  }

  Standard standard_;
  const PlaceRestriction* restriction_ = nullptr;  // null: none
  std::size_t size_ = 0;
  bool complete_ = false;  // the fields after the corners are computed
  std::vector<Lanes> lanes_;
  // Squares of the qualities with their signs: the root is taken of few.
  std::vector<Values> square_;
  std::vector<Values> trial_;
  std::size_t first_ = 0;  // lanes that ended the last walk that ended early
  std::array<Point, kMaxActive> gradients_;
};

/// Shortest vector in the convex hull of `count` points. Source: Wolfe's method, in the form of an
/// active simplex of at most four points.
Point shortest_in_hull(const Point* points, unsigned count);

}  // namespace tetmend
