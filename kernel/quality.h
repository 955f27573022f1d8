// SPDX-License-Identifier: MIT
// Quality of a tet: by the standard of a run, and measures chosen by name. Larger is better, 0 is
// degenerate, negative is inverted.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <tetmend/api.h>
#include <tetmend/goal.h>

#include "kernel/geometry.h"
#include "kernel/handles.h"

namespace tetmend {

/// Quality as the mesh stores it: 1 for a tet that just reaches the goal, see Standard. Single
/// precision is enough to rank tets; see kernel/judge.h for comparisons.
using Quality = float;

/// A tet of lower quality is bad.
inline constexpr Quality kBadThreshold = 1;

/// A measure is a pure function of the four points of a tet, in positive order for a valid tet.
struct TETMEND_API QualityMeasure {
  std::string_view name;  ///< as in `--measure NAME`
  std::string_view help;  ///< one line: formula and value of the regular tet
  double (*evaluate)(const Point& a, const Point& b, const Point& c, const Point& d);
  double best;  ///< value of the regular tet
};

/// A measure of a program or of a plugin, for Standard::of().
struct TETMEND_API OwnMeasure {
  std::string name;  ///< a-z, 0-9 and _, first a letter
  double good = 1;   ///< a tet of a lower value is bad; above 0
  /// Of the four points of a tet in positive order: larger is better. Asked by many threads at once,
  /// and the same whenever it is asked. Null: unknown, as of a trace that another program made.
  std::function<double(const Point&, const Point&, const Point&, const Point&)> evaluate;
};

/// From when on a tet is good, and what it is judged by. Its quality is the smaller of two terms,
/// with the sign of the volume; 0 when a face is degenerate.
///
///   sines    the smallest of the six sin(theta) / sin(goal), goal being the smallest angle of the
///            goal for an acute theta and the largest one for an obtuse theta
///   length   sqrt(flat^2 + (1 - flat^2) (VL / VL_needle)^2), VL the volume-length measure
///
/// So a tet is bad if it misses the goal, or if it is a needle. Sines alone do not see needles:
/// operators make them, and nothing can repair the thin tets around. A needle is no worse than
/// `flat`, so among the worst tets sines alone decide. Where the surface forces needles, these do
/// not hide the angles. Or it is a measure of the program's own. A value of a few words; immutable.
class TETMEND_API Standard {
 public:
  /// Of a new bad tet, in runs that do not say otherwise. The paper has none.
  static constexpr double kUsualPrice = 0.1;
  /// The measures that a run may have.
  enum class Terms : unsigned char {
    sine,             ///< of [chen, 6.1]
    sine_and_length,  ///< with the second term
    own               ///< one of the program, see of()
  };
  /// No goal: the quality is minimum_sine().
  Standard() = default;
  /// Precondition: terms are not `own`.
  explicit Standard(const Goal& goal, Terms terms = Terms::sine_and_length, double price = 0);
  /// By a measure of one's own: the quality is its value over `good`, and has the sign of the volume; 0
  /// where that is none. Where the function is unknown, it is that of the angles by the goal, which else is for figures
  /// of angles alone. @throws Error for a name or a value of a good tet without sense
  static Standard of(OwnMeasure measure, const Goal& goal = {}, double price = 0);
  /// The same in another point.
  Standard with_goal(const Goal& goal) const;
  Standard with_price(double price) const;

  const Goal& goal() const { return goal_; }
  Terms terms() const { return terms_; }
  /// Null: none.
  const OwnMeasure* own() const { return own_.get(); }
  /// What options, scripts and traces call what tets are judged by.
  std::string_view measure_name() const;
  /// What the worst tet must gain for each more bad tet that a change leaves; see Judge.
  double price() const { return price_; }
  /// The quality of a tet whose worst angle is `degrees` and that is no needle.
  double quality_of_angle(double degrees) const;

  // Squares, for whoever computes qualities of many tets: with V6, S the sum of the squared edges
  // and r the least l_ij^2 / (N_k^2 N_l^2), times the weight of the angle's kind,
  //   quality^2 = min(V6^2 r, flat2 + length V6^2 / S^3).
  double acute2() const { return acute2_; }
  double obtuse2() const { return obtuse2_; }
  bool is_even() const { return acute2_ == obtuse2_; }
  double flat2() const { return flat2_; }
  double length() const { return length_; }

  /// The same goal, for angles alone.
  Standard of_angles() const {
    Standard angles = *this;
    angles.terms_ = Terms::sine;
    angles.flat2_ = kOff;
    angles.length_ = 0;
    angles.own_ = nullptr;
    return angles;
  }
  /// Of a tet in positive order. One root, two divisions. Loops inside the library call
  /// quality_of_points().
  double quality(const Point& p0, const Point& p1, const Point& p2, const Point& p3) const;
  /// The own measure of several tets costs what it costs of each: there is nothing to share.
  bool is_own() const { return own_ != nullptr; }
  friend bool operator==(const Standard& a, const Standard& b) {
    return a.goal_ == b.goal_ && a.terms_ == b.terms_ && a.price_ == b.price_ && is_same(a, b);
  }

 private:
  /// The same measure of a program, or one of the same name that two traces know nothing else of.
  static bool is_same(const Standard& a, const Standard& b);
  double own_quality(const Point& p0, const Point& p1, const Point& p2, const Point& p3) const;

  Goal goal_ = {90, 90};
  Terms terms_ = Terms::sine;
  double price_ = 0;
  double acute2_ = 1;
  double obtuse2_ = 1;
  double flat2_ = kOff;
  double length_ = 0;
  std::shared_ptr<const OwnMeasure> own_;

  static constexpr double kOff = 1e30;  // more than any other term
};

/// Minimum sine of the six dihedral angles, with the sign of the volume. 0 when a face is
/// degenerate. Regular tet: 0.942809 (2 sqrt(2) / 3). One root and one division. Source: [chen,
/// 6.1]; sin(theta_ij) = V6 l_ij / (N_k N_l) with N the norms of the face normals.
TETMEND_API double minimum_sine(const Point& p0, const Point& p1, const Point& p2, const Point& p3);

/// As options and scripts write it: "sine" or "sine_and_length".
/// @throws Error for another name, with the valid ones
TETMEND_API Standard::Terms to_terms(std::string_view name,
                                     std::string_view valid = "sine, sine_and_length");
TETMEND_API std::string_view to_string(Standard::Terms terms);

/// True if the angles of a goal are within their bounds.
TETMEND_API bool is_sound(const Goal& goal);

/// The six dihedral angles in degrees, 0..180, at the edges in the order of kEdgeVertices. For an
/// inverted tet the angles of its mirror image. The angles at a degenerate face are 0.
TETMEND_API std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c,
                                                  const Point& d);

/// Smallest dihedral angle in degrees, with the sign of the volume. Regular tet: 70.5288.
TETMEND_API double minimum_dihedral_angle(const Point& a, const Point& b, const Point& c,
                                          const Point& d);

/// 6 sqrt(2) V / l_rms^3, l_rms the root mean square edge length. Regular tet: 1. Source:
/// [shewchuk_good].
TETMEND_API double volume_length(const Point& a, const Point& b, const Point& c, const Point& d);

/// 3 r / R: inradius over circumradius, with the sign of the volume. Regular tet: 1.
TETMEND_API double radius_ratio(const Point& a, const Point& b, const Point& c, const Point& d);

/// 12 (3 V)^(2/3) / sum of squared edge lengths, with the sign of the volume. Regular tet: 1.
TETMEND_API double mean_ratio(const Point& a, const Point& b, const Point& c, const Point& d);

/// Minimum sine in which the sine of an obtuse angle counts 0.75 times: large angles weigh more.
/// Regular tet: 0.942809. Source: option of [klingner_shewchuk].
TETMEND_API double warped_minimum_sine(const Point& a, const Point& b, const Point& c,
                                       const Point& d);

/// Sine of the largest dihedral angle, with the sign of the volume; 1 if none is obtuse.
TETMEND_API double largest_angle_sine(const Point& a, const Point& b, const Point& c,
                                      const Point& d);

/// All measures; the first is the default.
TETMEND_API std::span<const QualityMeasure> quality_measures();

/// @throws Error for an unknown name, with the valid ones.
TETMEND_API const QualityMeasure& find_quality_measure(std::string_view name);

}  // namespace tetmend
