// SPDX-License-Identifier: MIT
#include "envelope/cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetmend {

namespace {

double distance2(const CoverTarget& target, const Point& p) {
  return (nearest_point(target.points, target.corners, p) - p).squaredNorm();
}

}  // namespace

Point CoverTest::Piece::middle() const {
  Point sum = Point::Zero();
  for (unsigned i = 0; i < corners; ++i) sum += points[i];
  return sum / corners;
}

bool CoverTest::covers(const std::array<Point, 3>& points, unsigned corners,
                       std::span<CoverTarget> targets, bool nearest) {
  bound_ = 0;
  for (CoverTarget& target : targets) target.used = false;
  Piece whole;
  whole.corners = corners;
  std::copy_n(points.begin(), corners, whole.points.begin());
  for (unsigned i = 0; i < corners; ++i) {  // most that are too far fail here
    const bool near = std::any_of(targets.begin(), targets.end(), [&](const CoverTarget& target) {
      return distance2(target, points[i]) <= target.tolerance * target.tolerance;
    });
    if (!near) return false;
  }
  stack_.assign(1, whole);
  for (unsigned pieces = 0; !stack_.empty(); ++pieces) {
    if (pieces == most_pieces_) return false;
    const Piece piece = stack_.back();
    stack_.pop_back();
    if (!certify(piece, targets, nearest) && !divide(piece, targets)) return false;
  }
  return true;
}

bool CoverTest::certify(const Piece& piece, std::span<CoverTarget> targets, bool nearest) {
  CoverTarget* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (CoverTarget& target : targets) {
    const double limit = std::min(least, target.tolerance * target.tolerance);
    double most = 0;
    for (unsigned i = 0; i < piece.corners && most <= limit; ++i) {
      most = std::max(most, distance2(target, piece.points[i]));
    }
    if (!(most <= limit) || most == least) continue;
    least = most;
    best = &target;
    if (!nearest) break;
  }
  if (best == nullptr) return false;
  best->used = true;
  bound_ = std::max(bound_, std::sqrt(least));
  return true;
}

bool CoverTest::divide(const Piece& piece, std::span<const CoverTarget> targets) {
  const Point middle = piece.middle();
  const CoverTarget* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const CoverTarget& target : targets) {
    const double distance = distance2(target, middle);
    if (distance > target.tolerance * target.tolerance || distance >= least) continue;
    least = distance;
    best = &target;
  }
  if (best == nullptr) return false;  // the middle is too far from all
  // Beyond the sides, where a gap or a bend keeps two targets apart.
  if (!cut(piece, *best, 0) && !cut(piece, *best, 0.7 * best->tolerance)) halve(piece);
  return true;
}

/// Cuts off what lies so far beyond a side of the target. False: nothing.
bool CoverTest::cut(const Piece& piece, const CoverTarget& target, double beyond) {
  Piece inside = piece;
  bool any = false;
  const double slack = 1e-3 * target.tolerance;
  for (unsigned k = 0; k < target.corners; ++k) {
    const Point& from = target.points[k];
    const Point along = target.points[(k + 1) % target.corners] - from;
    const Point outward = target.corners == 2 ? Point(-along) : Point(along.cross(target.normal));
    const double length = outward.norm();
    if (!(length > 0)) continue;
    std::array<double, kMostCorners> side{};
    double lowest = 0;
    double highest = 0;
    for (unsigned i = 0; i < inside.corners; ++i) {
      side[i] = outward.dot(inside.points[i] - from) / length - beyond;
      lowest = std::min(lowest, side[i]);
      highest = std::max(highest, side[i]);
    }
    if (highest <= slack || lowest >= -slack) continue;
    if (inside.corners + 1 >= kMostCorners) return any;
    Piece in;
    Piece out;
    for (unsigned i = 0; i < inside.corners; ++i) {
      const unsigned j = (i + 1) % inside.corners;
      const Point& p = inside.points[i];
      if (side[i] <= 0) in.points[in.corners++] = p;
      if (side[i] >= 0) out.points[out.corners++] = p;
      if (inside.corners == 2 && i == 1) break;  // a segment is no ring
      if ((side[i] < 0 && side[j] > 0) || (side[i] > 0 && side[j] < 0)) {
        const Point q = p + side[i] / (side[i] - side[j]) * (inside.points[j] - p);
        in.points[in.corners++] = q;
        out.points[out.corners++] = q;
      }
    }
    stack_.push_back(out);
    inside = in;
    any = true;
  }
  if (any) stack_.push_back(inside);
  return any;
}

void CoverTest::halve(const Piece& piece) {
  unsigned longest = 0;
  double most = -1;
  for (unsigned i = 0; i < piece.corners; ++i) {
    const double length = (piece.points[(i + 1) % piece.corners] - piece.points[i]).squaredNorm();
    if (length > most) {
      most = length;
      longest = i;
    }
  }
  const Point middle = (piece.points[longest] + piece.points[(longest + 1) % piece.corners]) / 2;
  if (piece.corners == 2) {
    for (unsigned i = 0; i < 2; ++i) {
      Piece half;
      half.corners = 2;
      half.points[0] = piece.points[i];
      half.points[1] = middle;
      stack_.push_back(half);
    }
    return;
  }
  // From the middle of the longest side to the corner opposite.
  const unsigned opposite = 1 + piece.corners / 2;  // counted from the longest side's first
  Piece first;
  Piece second;
  first.points[first.corners++] = middle;
  second.points[second.corners++] = middle;
  for (unsigned i = 1; i <= piece.corners; ++i) {
    const Point& p = piece.points[(longest + i) % piece.corners];
    if (i <= opposite) first.points[first.corners++] = p;
    if (i >= opposite) second.points[second.corners++] = p;
  }
  stack_.push_back(first);
  stack_.push_back(second);
}

}  // namespace tetmend
