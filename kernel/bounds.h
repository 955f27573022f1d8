// SPDX-License-Identifier: MIT
// What no change may make worse, whatever else it brings.
#pragma once

#include <limits>
#include <optional>

#include <tetmend/api.h>

#include "kernel/quality.h"

namespace tetmend {

struct P1Diagonals;
class TetMesh;

/// Bounds on every new tet: those of the worst tets that a run began with. The quality of a tet
/// does not hold them: it takes large and small angles for the same, and a needle may be better
/// than a tet with a sharp angle. A value; immutable.
class TETMEND_API Bounds {
 public:
  /// What they are for.
  enum class Holding : bool {
    angles,  ///< the shapes of tets; an angle may be as large as the goal allows
    solver   ///< the stable step as well, and no angle is larger than there was
  };

  /// No bounds.
  Bounds() = default;
  /// Of the mesh: no smaller dihedral angle, no larger one than it or its goal has, no smaller mean or
  /// radius ratio, no larger ratio of edges of a tet than it has or 10, no smaller stable step at a vertex. Bounds that a mesh has stay; its
  /// angles of now make them tighter. Cost: one pass over the tets. An inverted tet counts as below.
  static Bounds of(const TetMesh& mesh, Holding holding = Holding::angles);
  /// Those for a solver, where the sums behind the stable step are known.
  static Bounds of(const TetMesh& mesh, const P1Diagonals& diagonals);
  /// Of no tet yet: what the goal allows, to be widened tet by tet. What comes of it are the bounds of a
  /// mesh of these tets, in whatever order they came.
  static Bounds of_goal(const Standard& standard);

  /// From now on they admit the tet, too.
  void widen(const Point& a, const Point& b, const Point& c, const Point& d);
  /// From now on they admit what the other ones do. Both come from of_goal().
  void widen(const Bounds& other);

  /// The same bounds, which hold where inverted tets are mended, too.
  Bounds for_mending() const;
  /// Some tet that they are of is not in positive order.
  bool are_of_inverted() const { return least_radius_ratio_ <= 0; }
  /// They are of such a mesh, and where one is mended, they may be broken: that goes first.
  bool yield_to_mending() const { return least_radius_ratio_ == 0; }

  /// The same bounds where tets are judged by another standard.
  Bounds under(const Standard& standard) const;

  /// Tets of this quality or more keep the bounds, whatever their shape.
  Quality safe() const { return static_cast<Quality>(safe_); }
  /// One not in positive order: as its mirror image, with ratios (mean, radius) of 0.
  bool admit(const Point& a, const Point& b, const Point& c, const Point& d) const;

  /// Squared, see stable_step(): no vertex may allow less. 0: any may.
  double least_step2() const { return least_step2_; }
  /// What a change adds must be as round on average: the mean ratios, each less this, have no smaller
  /// sum than before. 0: any may be.
  double least_mean() const { return least_mean_; }
  /// The same bounds, with that.
  Bounds with_mean(double mean_ratio) const;

 private:
  /// @param step to be held; nothing: none, and the angles are the goal's where these are larger
  static Bounds of(const TetMesh& mesh, std::optional<double> step);
  bool any() const { return safe_ > -std::numeric_limits<double>::infinity(); }

  double least_sine2_ = 0;           // of an acute angle
  double least_obtuse_sine2_ = 0;    // of an obtuse one
  double least_volume_length2_ = 0;  // mean ratio = volume-length^(2/3)
  double least_radius_ratio_ = 0;    // 0 of an inverted tet, less in for_mending()
  double least_step2_ = 0;
  double least_mean_ = 0;
  double most_edge_ratio2_ = std::numeric_limits<double>::infinity();
  double safe_ = -std::numeric_limits<double>::infinity();  // that: no bounds
};

}  // namespace tetmend
