// SPDX-License-Identifier: MIT
// Where to put several vertices at once so that the worst tets around them are as good as possible.
// A pure unit: points in, points out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/quality.h"

namespace tetmend {

/// Moves the free vertices of a patch of tets together. The smallest quality has no gradient where
/// several tets share it, so a smooth stand-in is minimised: the p-norm of what the terms of all
/// tets lack, that is their six sines and their length as the standard weighs them,
///
///   |u|_p = (sum u^p)^(1/p),  u = max(0, enough - term),
///
/// by a quasi-Newton method of limited memory ([liu_nocedal]), for p = 16 and 64: at first
/// several bad tets count, in the end only the worst. No tet that was positive ceases to be so.
class PatchOptimiser {
 public:
  struct Limits {
    int mildest = 4;           ///< p = 2^mildest at first
    int sharpest = 6;          ///< and 4 times as much each time, up to 2^sharpest
    int steps = 20;            ///< directions for each p
    double enough = 1.2;       ///< terms above this need nothing
    double least_gain = 2e-3;  ///< a norm is left when a step lowers it by less
  };

  /// Begins a patch, to be judged by a standard.
  void clear(const Standard& standard);
  /// A vertex that may move; vertices count from 0.
  void add_vertex(const Point& p) { points_.push_back(p); }
  static constexpr int kFixed = -1;
  /// A tet by its corners, in positive order if it is valid; `vertex` has the number of each corner
  /// that may move, and kFixed for the others. Precondition: these vertices were added.
  void add_tet(const std::array<Point, 4>& corners, const std::array<int, 4>& vertex);
  std::size_t vertex_count() const { return points_.size(); }
  std::size_t tet_count() const { return tets_.size(); }

  /// Smallest quality of the patch as it is now; infinite for an empty one. Cost: linear.
  double worst();
  /// Sum of deficit() over the tets at the last call of worst() or optimise().
  double total_deficit() const;
  /// Where vertex v is now.
  const Point& point(std::size_t v) const { return points_[v]; }

  /// Moves the vertices until the angles of one tet that are acute, or obtuse, as its worst is reach
  /// `goal`. All other terms may fall to `least`; those of a tet that is below, to what its worst
  /// is now. What they lack of that, squared, is minimised in sum. False if something is
  /// still lacking in the end; then no vertex has moved. Of the limits, steps and least gain count.
  /// Cost: as of optimise().
  bool lift(std::size_t tet, double goal, double least, const Limits& limits);

  /// Moves the vertices; returns the worst quality, which is not lower than it was. Cost: a few
  /// dozen looks at all tets. Takes no memory once it has seen a patch as large.
  double optimise(const Limits& limits);

 private:
  // Of the standard: for each dihedral angle, in the order of kEdgeVertices; then of the length.
  static constexpr std::size_t kTerms = 7;
  using Terms = std::array<double, kTerms>;
  struct Tet {
    std::array<Point, 4> corners;
    std::array<int, 4> vertex;
    bool positive;  // at the start
  };
  static constexpr std::size_t kMemory = 8;
  /// One step of the past: way and change of the gradient, and their product.
  struct Memory {
    std::vector<Point> way;
    std::vector<Point> turn;
    double product;
  };

  void measure_scales();
  bool measure(const std::vector<Point>& points, std::vector<Terms>& terms);
  void descend(int doublings, const Limits& limits);
  double norm(const std::vector<Terms>& terms, int doublings) const;
  void find_gradient(int doublings, double norm, std::vector<Point>& gradient);
  void add_own_gradient(const Tet& tet, double weight, std::vector<Point>& gradient) const;
  void find_direction();
  bool search_line(int doublings, double slope, double& value);
  void remember();

  Standard standard_;
  std::vector<Point> points_;
  std::vector<Tet> tets_;
  std::vector<Terms> terms_;
  std::vector<Terms> goals_;   // terms above these need nothing
  std::vector<double> scale_;  // mean edge length at each vertex: the unit of its steps
  std::vector<Point> trial_;
  std::vector<Terms> trial_terms_;
  std::vector<Point> best_;
  std::vector<Point> gradient_;
  std::vector<Point> last_gradient_;
  std::vector<Point> direction_;
  double step_ = 0;
  std::array<Memory, kMemory> memory_;
  std::size_t remembered_ = 0;  // steps so far; the last kMemory of them are kept
};

}  // namespace tetmend
