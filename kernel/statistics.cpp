// SPDX-License-Identifier: MIT
// Statistics of a mesh in one pass, without a transcendental function per angle.
//
//   an angle enters as  key = cos |cos| = c |c| / (c^2 + s^2),  monotone, no root needed
//   bins (5 degrees) and bands (6 degrees) together cut 0..180 into classes: count the classes
//   a uniform grid over the keys finds the class; bins and bands are added up at the end
//   the extreme angles are compared as signed squares of the cotangent, exact near 0 and 180
#include "kernel/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tetmend {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A sum whose relative error stays near one rounding however many terms it has: the exact error of
/// every addition is carried along (Knuth's TwoSum).
class CompensatedSum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    const double added = sum - sum_;
    error_ += (sum_ - (sum - added)) + (x - added);
    sum_ = sum;
  }
  double value() const { return sum_ + error_; }

 private:
  double sum_ = 0;
  double error_ = 0;
};

double share(double part, std::size_t whole) {
  return whole == 0 ? 0 : part / static_cast<double>(whole);
}

/// Counts angles by class. Class 2 j is the open interval below edge j, class 2 j + 1 edge j itself
/// (give or take kAngleTolerance): bins and bands close their intervals on different sides.
class AngleCounter {
 public:
  AngleCounter() {
    for (int degrees = 1; degrees < 180; ++degrees) {
      const bool band_edge = degrees % 6 == 0 && std::min(degrees, 180 - degrees) <= 30;
      if (degrees % 5 == 0 || band_edge) {
        edge_[edges_] = degrees;
        reached_[edges_] = key_of(degrees - kAngleTolerance);
        passed_[edges_] = key_of(degrees + kAngleTolerance);
        ++edges_;
      }
    }
    reached_[edges_] = passed_[edges_] = -kInfinity;  // no angle gets past 180
    for (std::size_t cell = 0; cell < first_.size(); ++cell) {
      std::size_t j = 0;
      while (j < edges_ && cell_of(passed_[j]) < cell) ++j;
      first_[cell] = static_cast<std::uint8_t>(j);
    }
  }

  /// @param key cos |cos| of the angle, within [-1, 1]
  void add(double key) {
    std::size_t j = first_[cell_of(key)];
    while (key < passed_[j]) ++j;
    ++count_[2 * j + (key <= reached_[j] ? 1 : 0)];
  }

  void write(MeshStatistics& result) const {
    std::array<std::size_t, 5> band_count{};
    std::size_t all = 0;
    for (std::size_t c = 0; c <= 2 * edges_; ++c) {
      const double low = c < 2 ? 0 : edge_[c / 2 - 1];
      const double high = c / 2 < edges_ ? edge_[c / 2] : 180;
      const double angle = c % 2 == 1 ? high : 0.5 * (low + high);  // stands for its class
      const double distance = std::min(angle, 180 - angle);
      result.histogram[static_cast<std::size_t>(angle / 5)] += count_[c];
      if (distance <= 30) {
        band_count[std::min<std::size_t>(4, static_cast<std::size_t>(distance / 6))] += count_[c];
      }
      all += count_[c];
    }
    std::size_t bad = 0;
    for (std::size_t i = 0; i < band_count.size(); ++i) {
      result.lambda_bands[i] = share(100.0 * static_cast<double>(band_count[i]), all);
      bad += band_count[i];
    }
    result.lambda = share(100.0 * static_cast<double>(bad), all);
  }

 private:
  static constexpr std::size_t kMaxEdges = 48;
  static constexpr double kCellsPerUnit =
      512;  // fine enough for one edge a cell, small enough for L1

  static double key_of(double degrees) {
    const double cosine = std::cos(degrees * std::numbers::pi / 180);
    return cosine * std::abs(cosine);
  }
  static std::size_t cell_of(double key) {
    return static_cast<std::size_t>((1 - key) * kCellsPerUnit);
  }

  std::size_t edges_ = 0;
  std::array<int, kMaxEdges> edge_{};        // degrees, ascending
  std::array<double, kMaxEdges> reached_{};  // keys at most this are at the edge or beyond
  std::array<double, kMaxEdges> passed_{};   // keys below this are beyond the edge
  std::array<std::uint8_t, 2 * static_cast<std::size_t>(kCellsPerUnit) + 1> first_{};
  std::array<std::size_t, 2 * kMaxEdges + 1> count_{};
};

/// What the angles of one tet contribute: keys to count and the extreme signed squared cotangents.
struct TetAngles {
  std::array<double, 6> key;
  double sharpest = -kInfinity;  // of the smallest angle
  double bluntest = kInfinity;   // of the largest angle

  TetAngles(const std::array<Point, 4>& p, double v6) {
    std::array<Point, 4> normal;
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [i, j, k] = kFaceVertices[f];
      normal[f] = (p[j] - p[i]).cross(p[k] - p[i]);
    }
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j] = kEdgeVertices[e];
      const auto& [k, l] = kEdgeVertices[5 - e];  // the faces at edge ij lie opposite k and l
      const double cosine = -normal[k].dot(normal[l]);
      const double signed_square = cosine * std::abs(cosine);
      const double sine_square = v6 * v6 * (p[j] - p[i]).squaredNorm();
      const double scale = cosine * cosine + sine_square;
      const double cosine_key = scale > 0 ? signed_square / scale : 1.0;
      const double cotangent = scale > 0 ? signed_square / sine_square : kInfinity;
      key[e] = cosine_key > -1 ? std::min(cosine_key, 1.0) : -1.0;  // not a number after overflow
      sharpest = std::max(sharpest, cotangent);
      bluntest = std::min(bluntest, cotangent);
    }
  }
};

std::array<Point, 4> corners(const TetMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])};
}

std::array<double, 6> angles_of(const TetMesh& mesh, TetHandle t) {
  const auto p = corners(mesh, t);
  return dihedral_angles(p[0], p[1], p[2], p[3]);
}

}  // namespace

MeshStatistics compute_statistics(const TetMesh& mesh) {
  MeshStatistics result;
  AngleCounter counter;
  CompensatedSum sum_v6;
  CompensatedSum sum_quality;
  CompensatedSum sum_bad;
  double q_worst = kInfinity;
  double sharpest = -kInfinity;
  double bluntest = kInfinity;
  TetHandle sharpest_tet;
  TetHandle bluntest_tet;

  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    const std::array<Point, 4> p = corners(mesh, t);
    const double v6 = volume6(p[0], p[1], p[2], p[3]);
    sum_v6.add(v6);
    if (!certified_positive(p[0], p[1], p[2], p[3])) {
      ++(certified_positive(p[0], p[1], p[3], p[2]) ? result.inverted : result.flat);
    }
    for (const HalfFace twin : mesh.neighbours(t)) {
      result.boundary_triangles += twin.is_outside() ? 1 : 0;
    }

    const double q = minimum_sine(p[0], p[1], p[2], p[3]);
    sum_quality.add(q);
    q_worst = std::min(q_worst, q);
    if (static_cast<Quality>(q) < kBadThreshold) {  // as the queues of bad tets see it
      ++result.n_bad;
      sum_bad.add(q);
    }

    const TetAngles angles(p, v6);
    for (const double key : angles.key) counter.add(key);
    if (!sharpest_tet.is_valid() || angles.sharpest > sharpest) {
      sharpest = angles.sharpest;
      sharpest_tet = t;
    }
    if (!bluntest_tet.is_valid() || angles.bluntest < bluntest) {
      bluntest = angles.bluntest;
      bluntest_tet = t;
    }
  }

  result.tets = mesh.tet_count();
  result.vertices = mesh.vertex_count();
  if (result.tets == 0) return result;
  result.volume = sum_v6.value() / 6;
  result.q_worst = q_worst;
  result.q_mean = share(sum_quality.value(), result.tets);
  result.q_aver = share(sum_bad.value(), result.n_bad);
  const auto sharp_angles = angles_of(mesh, sharpest_tet);
  const auto blunt_angles = angles_of(mesh, bluntest_tet);
  result.theta_min = *std::min_element(sharp_angles.begin(), sharp_angles.end());
  result.theta_max = *std::max_element(blunt_angles.begin(), blunt_angles.end());
  counter.write(result);
  return result;
}

QualityIndicators quality_indicators(const TetMesh& mesh) {
  QualityIndicators result;
  Quality worst = std::numeric_limits<Quality>::infinity();
  CompensatedSum sum_bad;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    const Quality q = mesh.quality(t);
    worst = std::min(worst, q);
    if (q < kBadThreshold) {
      ++result.n_bad;
      sum_bad.add(static_cast<double>(q));
    }
  }
  if (mesh.tet_count() > 0) result.q_worst = static_cast<double>(worst);
  result.q_aver = share(sum_bad.value(), result.n_bad);
  return result;
}

MeasureSummary summarize(const TetMesh& mesh, const QualityMeasure& measure) {
  MeasureSummary result{&measure, 0, 0};
  if (mesh.tet_count() == 0) return result;
  result.worst = kInfinity;
  CompensatedSum sum;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    const auto p = corners(mesh, t);
    const double value = measure.evaluate(p[0], p[1], p[2], p[3]);
    result.worst = std::min(result.worst, value);
    sum.add(value);
  }
  result.mean = share(sum.value(), mesh.tet_count());
  return result;
}

}  // namespace tetmend
