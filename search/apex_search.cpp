// SPDX-License-Identifier: MIT
// Branch and bound over the dihedral angles at the edges of a triangle.
//
//        p            The angles t1 t2 t3 at the edges of the base, of lengths l1 l2 l3, name an
//       /|\           apex p: three planes meet there. It lies above the base if
//      / | \            sum l_i cot t_i > 0.
//     /  3  \         At corner k the base and the two sides i, j make a spherical triangle with
//    / /   \ \        the angles t_i, t_j and s_k, the dihedral angle at the edge p k. By the law
//   1---------2       of cosines, with c_k the angle of the base at k,
//                       cos s_k = sin t_i sin t_j cos c_k - cos t_i cos t_j.
//
//   boxes of (t1, t2, t3), the whole range first:
//     drop a box that cannot hold an apex | stop if its middle is one | halve it
#include "search/apex_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tetmend {

namespace {

constexpr double kRight = std::numbers::pi / 2;
constexpr double kSmallestBox = 1e-4;  // radians
constexpr std::size_t kMostBoxes = 4000;

struct Direction {
  double sine, cosine;
  explicit Direction(double angle) : sine(std::sin(angle)), cosine(std::cos(angle)) {}
};

/// A range of angles within [0, pi] with sine and cosine of its ends.
struct Arc {
  AngleRange range;
  Direction low, high;

  explicit Arc(AngleRange of) : range(of), low(of.low), high(of.high) {}
  double width() const { return range.high - range.low; }
  double middle() const { return 0.5 * (range.low + range.high); }
};

using Box = std::array<Arc, 3>;

struct Interval {
  double low = 1;
  double high = -1;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// All values of p sin x + q cos x for x in the arc, which is shorter than half a turn. They
  /// range between the ends, or to the top or bottom of the wave if the slope changes its sign in
  /// between.
  void include_wave(double p, double q, const Arc& arc) {
    include(p * arc.low.sine + q * arc.low.cosine);
    include(p * arc.high.sine + q * arc.high.cosine);
    const double slope_low = p * arc.low.cosine - q * arc.low.sine;
    const double slope_high = p * arc.high.cosine - q * arc.high.sine;
    if (slope_low > 0 && slope_high < 0) include(std::hypot(p, q));
    if (slope_low < 0 && slope_high > 0) include(-std::hypot(p, q));
  }
};

double cosine_at_side(double cosine_of_corner, const Direction& a, const Direction& b) {
  return a.sine * b.sine * cosine_of_corner - a.cosine * b.cosine;
}

/// All cosines at a side edge. Their only stationary point between 0 and pi, two right angles, is a
/// saddle: the extremes lie on the rim of the rectangle.
Interval cosines_at_side(double cosine_of_corner, const Arc& a, const Arc& b) {
  Interval all;
  for (const Direction& end : {b.low, b.high}) {
    all.include_wave(end.sine * cosine_of_corner, -end.cosine, a);
  }
  for (const Direction& end : {a.low, a.high}) {
    all.include_wave(end.sine * cosine_of_corner, -end.cosine, b);
  }
  return all;
}

class Search {
 public:
  Search(const std::array<double, 3>& corners, AngleRange side) {
    for (unsigned k = 0; k < 3; ++k) {
      // Law of sines. The other two angles tell the sine even where the corner is nearly straight.
      const double others = corners[(k + 1) % 3] + corners[(k + 2) % 3];
      edge_length_[k] = std::sin(corners[k] < kRight ? corners[k] : others);
      cosine_[k] = std::cos(corners[k]);
    }
    const AngleRange wide{side.low - kAngleSlack, side.high + kAngleSlack};
    allowed_.low = wide.high < std::numbers::pi ? std::cos(wide.high) : -2;
    allowed_.high = wide.low > 0 ? std::cos(wide.low) : 2;
  }

  bool run(const Box& all) const {
    // The angles of the regular tet, as far as the ranges go, will often do.
    constexpr double kRegular = 1.23;
    std::array<double, 3> likely{};
    for (unsigned i = 0; i < 3; ++i) {
      likely[i] =
          std::clamp(kRegular, all[i].range.low, std::max(all[i].range.low, all[i].range.high));
    }
    if (is_apex(likely)) return true;
    std::vector<Box> open = {all};
    for (std::size_t boxes = 0; !open.empty(); ++boxes) {
      if (boxes == kMostBoxes) return true;
      const Box box = open.back();
      open.pop_back();
      if (is_empty(box)) continue;
      if (is_apex({box[0].middle(), box[1].middle(), box[2].middle()})) return true;
      const auto widest = static_cast<std::size_t>(
          std::max_element(box.begin(), box.end(),
                           [](const Arc& a, const Arc& b) { return a.width() < b.width(); }) -
          box.begin());
      const AngleRange range = box[widest].range;
      if (box[widest].width() < kSmallestBox) return true;
      const double middle = box[widest].middle();
      open.push_back(box);
      open.back()[widest] = Arc({range.low, middle});
      open.push_back(box);
      open.back()[widest] = Arc({middle, range.high});
    }
    return false;
  }

 private:
  bool is_empty(const Box& box) const {
    // The smallest angles put the apex lowest: if even their planes do not meet above, none do.
    if (!meet_above({box[0].low, box[1].low, box[2].low})) return true;
    for (unsigned k = 0; k < 3; ++k) {
      const Interval cosines = cosines_at_side(cosine_[k], box[(k + 1) % 3], box[(k + 2) % 3]);
      if (cosines.low > allowed_.high || cosines.high < allowed_.low) return true;
    }
    return false;
  }
  bool is_apex(const std::array<double, 3>& base) const {
    const std::array<Direction, 3> t = {Direction(base[0]), Direction(base[1]), Direction(base[2])};
    if (!meet_above(t)) return false;
    for (unsigned k = 0; k < 3; ++k) {
      const double cosine = cosine_at_side(cosine_[k], t[(k + 1) % 3], t[(k + 2) % 3]);
      if (cosine > allowed_.high || cosine < allowed_.low) return false;
    }
    return true;
  }
  bool meet_above(const std::array<Direction, 3>& t) const {
    double sum = 0;
    for (unsigned i = 0; i < 3; ++i) sum += edge_length_[i] * t[i].cosine / t[i].sine;
    return sum > 0;
  }

  std::array<double, 3> edge_length_{};
  std::array<double, 3> cosine_{};
  Interval allowed_;  // cosines at the side edges
};

}  // namespace

bool has_apex(const std::array<double, 3>& corners, const std::array<AngleRange, 3>& base,
              AngleRange side) {
  for (const AngleRange& range : base) {
    if (range.low > range.high + kAngleSlack) return false;
  }
  const auto widened = [](AngleRange range) {
    constexpr double kLeast = 1e-8;  // sines stay positive
    return Arc({std::max(range.low - kAngleSlack, kLeast),
                std::min(range.high + kAngleSlack, std::numbers::pi - kLeast)});
  };
  return Search(corners, side).run({widened(base[0]), widened(base[1]), widened(base[2])});
}

}  // namespace tetmend
