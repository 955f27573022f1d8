// SPDX-License-Identifier: MIT
// Statistics of a mesh in one pass, without a transcendental function per angle.
//
//   an angle enters as  key = cos |cos| = c |c| / (c^2 + s^2),  monotone, no root needed
//   bins (5 degrees) and bands (a fifth of what is bad) together cut 0..180 into classes: count the
//   classes
//   a uniform grid over the keys finds the class; bins and bands are added up at the end
//   the extreme angles are compared as signed squares of the cotangent, exact near 0 and 180
#include "kernel/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "kernel/angle_rows.h"
#include "kernel/chunks.h"
#include "kernel/compensated_sum.h"
#include "kernel/statistics_cache.h"

namespace tetmend {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double share(double part, std::size_t whole) {
  return whole == 0 ? 0 : part / static_cast<double>(whole);
}

/// The classes of angles. Class 2 j is the open interval below edge j, and class 2 j + 1 is edge j
/// itself (give or take kAngleTolerance). Bins and bands close their intervals on different sides.
class AngleClasses {
 public:
  static constexpr std::size_t kMaxEdges = 48;
  using Counts = std::array<std::size_t, 2 * kMaxEdges + 1>;

  explicit AngleClasses(const Goal& goal) : goal_(goal) {
    std::vector<double> edges;
    for (int degrees = 5; degrees < 180; degrees += 5) edges.push_back(degrees);
    for (int band = 1; band <= 5; ++band) {
      edges.push_back(band * goal.min_angle / 5);
      edges.push_back(180 - band * (180 - goal.max_angle) / 5);
    }
    std::sort(edges.begin(), edges.end());
    for (const double degrees : edges) {
      if (edges_ > 0 && degrees - edge_[edges_ - 1] <= 3 * kAngleTolerance) continue;
      edge_[edges_] = degrees;
      reached_[edges_] = angle_key(degrees - kAngleTolerance);
      passed_[edges_] = angle_key(degrees + kAngleTolerance);
      ++edges_;
    }
    reached_[edges_] = passed_[edges_] = -kInfinity;  // no angle gets past 180
    for (std::size_t cell = 0; cell < first_.size(); ++cell) {
      std::size_t j = 0;
      while (j < edges_ && cell_of(passed_[j]) < cell) ++j;
      first_[cell] = static_cast<std::uint8_t>(j);
    }
  }

  /// @param key of the angle, within [-1, 1]
  std::size_t find(double key) const {
    std::size_t j = first_[cell_of(key)];
    while (key < passed_[j]) ++j;
    return 2 * j + (key <= reached_[j] ? 1 : 0);
  }

  void write(const Counts& counts, MeshStatistics& result) const {
    std::array<std::size_t, 5> band_count{};
    std::size_t all = 0;
    const auto count_band = [&](double outside, double width, std::size_t count) {
      const double band = std::floor(outside / width + kAngleTolerance);
      band_count[std::min<std::size_t>(4, static_cast<std::size_t>(band))] += count;
    };
    for (std::size_t c = 0; c <= 2 * edges_; ++c) {
      const double low = c < 2 ? 0 : edge_[c / 2 - 1];
      const double high = c / 2 < edges_ ? edge_[c / 2] : 180;
      const double angle = c % 2 == 1 ? high : 0.5 * (low + high);  // stands for its class
      result.histogram[static_cast<std::size_t>(angle / 5 + kAngleTolerance)] += counts[c];
      if (angle <= goal_.min_angle) {
        count_band(angle, goal_.min_angle / 5, counts[c]);
      } else if (angle >= goal_.max_angle) {
        count_band(180 - angle, (180 - goal_.max_angle) / 5, counts[c]);
      }
      all += counts[c];
    }
    std::size_t bad = 0;
    for (std::size_t i = 0; i < band_count.size(); ++i) {
      result.lambda_bands[i] = share(100.0 * static_cast<double>(band_count[i]), all);
      bad += band_count[i];
    }
    result.lambda = share(100.0 * static_cast<double>(bad), all);
  }

 private:
  // Fine enough for one edge a cell, small enough for L1.
  static constexpr double kCellsPerUnit = 512;

  static std::size_t cell_of(double key) {  // to 32 bits first, which is one instruction
    return static_cast<std::uint32_t>(static_cast<std::int32_t>((1 - key) * kCellsPerUnit));
  }

  Goal goal_;
  std::size_t edges_ = 0;
  std::array<double, kMaxEdges> edge_{};     // degrees, ascending
  std::array<double, kMaxEdges> reached_{};  // keys at most this are at the edge or beyond
  std::array<double, kMaxEdges> passed_{};   // keys below this are beyond the edge
  std::array<std::uint8_t, 2 * static_cast<std::size_t>(kCellsPerUnit) + 1> first_{};
};

/// Keys of the angles that a bad tet surpasses. The queues of bad tets see sines in single
/// precision, so half a unit of it is granted.
KeyLimits limits_of(const Goal& goal) {
  constexpr double kGranted = 1 - 0x1p-25;
  constexpr double kDegrees = 180 / std::numbers::pi;
  const auto granted = [](double degrees) {
    return std::asin(std::min(1.0, std::sin(degrees / kDegrees)) * kGranted) * kDegrees;
  };
  return {angle_key(granted(goal.min_angle)), angle_key(180 - granted(180 - goal.max_angle))};
}

/// The squares of the cotangents of a tet's angles, with the signs of these: exact near 0 and 180,
/// where keys cannot tell angles apart.
std::array<double, 6> cotangents_of(const std::array<Point, 4>& p) {
  std::array<Point, 4> normal;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& [i, j, k] = kFaceVertices[f];
    normal[f] = (p[j] - p[i]).cross(p[k] - p[i]);
  }
  const double v6 = volume6(p[0], p[1], p[2], p[3]);
  std::array<double, 6> squares{};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto& [i, j] = kEdgeVertices[e];
    const auto& [k, l] = kEdgeVertices[5 - e];  // the faces at edge ij lie opposite k and l
    const double cosine = -normal[k].dot(normal[l]);
    const double cosine_square = cosine * std::abs(cosine);
    const double sine_square = v6 * v6 * (p[j] - p[i]).squaredNorm();
    const double scale = std::abs(cosine_square) + sine_square;
    squares[e] = scale > 0 ? cosine_square / sine_square : kInfinity;
  }
  return squares;
}

/// The smallest and the largest angle of many tets, and whose they are. Keys choose the few tets of
/// which the cotangents are worth their divisions.
class ExtremeAngles {
 public:
  /// True if the tet with these extreme keys may have one of the extremes of all.
  bool may_take(double greatest_key, double smallest_key) const {
    constexpr double kRounding = 1e-12;
    return greatest_key >= greatest_key_ - kRounding || smallest_key <= smallest_key_ + kRounding ||
           !sharpest_tet_.is_valid();
  }
  void take(TetHandle t, const std::array<Point, 4>& p, double greatest_key, double smallest_key) {
    greatest_key_ = std::max(greatest_key_, greatest_key);
    smallest_key_ = std::min(smallest_key_, smallest_key);
    const auto cotangents = cotangents_of(p);
    add(t, *std::max_element(cotangents.begin(), cotangents.end()), t,
        *std::min_element(cotangents.begin(), cotangents.end()));
  }
  /// Precondition: the tets of `later` follow those met so far.
  void add(const ExtremeAngles& later) {
    if (!later.sharpest_tet_.is_valid()) return;
    add(later.sharpest_tet_, later.sharpest_, later.bluntest_tet_, later.bluntest_);
  }
  TetHandle sharpest_tet() const { return sharpest_tet_; }
  TetHandle bluntest_tet() const { return bluntest_tet_; }

 private:
  void add(TetHandle t, double sharpest, TetHandle u, double bluntest) {
    if (!sharpest_tet_.is_valid() || sharpest > sharpest_) {
      sharpest_ = sharpest;
      sharpest_tet_ = t;
    }
    if (!bluntest_tet_.is_valid() || bluntest < bluntest_) {
      bluntest_ = bluntest;
      bluntest_tet_ = u;
    }
  }

  double greatest_key_ = -kInfinity;
  double smallest_key_ = kInfinity;
  double sharpest_ = -kInfinity;  // signed squared cotangents
  double bluntest_ = kInfinity;
  TetHandle sharpest_tet_;
  TetHandle bluntest_tet_;
};

std::array<Point, 4> corners(const TetMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])};
}

std::array<double, 6> angles_of(const TetMesh& mesh, TetHandle t) {
  const auto p = corners(mesh, t);
  return dihedral_angles(p[0], p[1], p[2], p[3]);
}

/// The statistics of some tets, before means and shares are taken.
struct PartialStatistics {
  std::size_t boundary_triangles = 0;
  std::size_t inverted = 0;
  std::size_t flat = 0;
  std::size_t n_bad = 0;
  double q_worst = kInfinity;
  CompensatedSum v6;
  CompensatedSum quality;
  CompensatedSum bad;
  AngleClasses::Counts angles{};
  ExtremeAngles extremes;

  void add(const PartialStatistics& later) {
    boundary_triangles += later.boundary_triangles;
    inverted += later.inverted;
    flat += later.flat;
    n_bad += later.n_bad;
    q_worst = std::min(q_worst, later.q_worst);
    v6.add(later.v6);
    quality.add(later.quality);
    bad.add(later.bad);
    for (std::size_t c = 0; c < angles.size(); ++c) angles[c] += later.angles[c];
    extremes.add(later.extremes);
  }
};

/// Counts the angles of a block, and looks for extremes.
void count_angles(const TetMesh& mesh, const TetRows& rows, const AngleRows& angles,
                  const AngleClasses& classes, std::array<AngleClasses::Counts, 2>& counts,
                  PartialStatistics& part) {
  const std::size_t size = rows.points.size();
  // Two tables, so that equal angles in a row need not wait for each other's count.
  for (std::size_t e = 0; e < 6; e += 2) {
    const auto* some = reinterpret_cast<const double*>(angles.keys[e].data());
    const auto* others = reinterpret_cast<const double*>(angles.keys[e + 1].data());
    for (std::size_t i = 0; i < size; ++i) {
      ++counts[0][classes.find(some[i])];
      ++counts[1][classes.find(others[i])];
    }
  }
  const auto* greatest = reinterpret_cast<const double*>(angles.greatest.data());
  const auto* smallest = reinterpret_cast<const double*>(angles.smallest.data());
  for (std::size_t i = 0; i < size; ++i) {
    const TetHandle t = rows.tets[i];
    for (const HalfFace twin : mesh.neighbours(t)) {
      part.boundary_triangles += twin.is_outside() ? 1 : 0;
    }
    if (!part.extremes.may_take(greatest[i], smallest[i])) continue;
    part.extremes.take(t, corners(mesh, t), greatest[i], smallest[i]);
  }
}

PartialStatistics measure_part(const TetMesh& mesh, const AngleClasses& classes,
                               const KeyLimits& limits, std::size_t begin, std::size_t end) {
  PartialStatistics part;
  AngleTally tally;
  AngleRows angles;
  std::array<AngleClasses::Counts, 2> counts{};
  std::size_t tets = 0;
  visit_rows(mesh, begin, end, 1, [&](const TetRows& rows) {
    compute_angles(rows.points, limits, angles, tally);
    count_angles(mesh, rows, angles, classes, counts, part);
    tets += rows.points.size();
  });
  for (std::size_t c = 0; c < part.angles.size(); ++c) part.angles[c] = counts[0][c] + counts[1][c];
  part.n_bad = total_count(tally.bad);
  part.inverted = total_count(tally.inverted);
  part.flat = tets - part.inverted - total_count(tally.positive);
  for (std::size_t i = 0; i < kWideLanes; ++i) {
    part.q_worst = std::min<double>(part.q_worst, tally.worst_sine[i]);
  }
  part.v6 = tally.volume6.total();
  part.quality = tally.sine.total();
  part.bad = tally.bad_sine.total();
  return part;
}

/// Sums up in chunks: `Partial` takes tets by add(mesh, tet, arguments...) and later chunks by
/// add().
template <class Partial, class... Arguments>
Partial sum_up(const TetMesh& mesh, const Arguments&... arguments) {
  const auto parts = map_chunks<Partial>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Partial part;
    for (std::size_t slot = begin; slot < end; ++slot) {
      const TetHandle t(static_cast<std::uint32_t>(slot));
      if (!mesh.is_deleted(t)) part.add(mesh, t, arguments...);
    }
    return part;
  });
  Partial sum;
  for (const Partial& part : parts) sum.add(part);
  return sum;
}

}  // namespace

namespace {

MeshStatistics put_together(const TetMesh& mesh, const Goal& goal, const AngleClasses& classes,
                            std::span<const PartialStatistics> parts) {
  PartialStatistics sum;
  for (const PartialStatistics& part : parts) sum.add(part);
  MeshStatistics result;
  result.goal = goal;
  result.tets = mesh.tet_count();
  result.vertices = mesh.vertex_count();
  if (result.tets == 0) return result;
  result.boundary_triangles = sum.boundary_triangles;
  result.inverted = sum.inverted;
  result.flat = sum.flat;
  result.scaled_volume = sum.v6.value() / 6;
  result.scale = mesh.scale().exponent();
  result.volume = std::ldexp(result.scaled_volume, 3 * result.scale);
  result.q_worst = sum.q_worst;
  result.q_mean = share(sum.quality.value(), result.tets);
  result.n_bad = sum.n_bad;
  result.q_aver = share(sum.bad.value(), result.n_bad);
  const auto sharp_angles = angles_of(mesh, sum.extremes.sharpest_tet());
  const auto blunt_angles = angles_of(mesh, sum.extremes.bluntest_tet());
  result.theta_min = *std::min_element(sharp_angles.begin(), sharp_angles.end());
  result.theta_max = *std::max_element(blunt_angles.begin(), blunt_angles.end());
  classes.write(sum.angles, result);
  return result;
}

}  // namespace

MeshStatistics compute_statistics(const TetMesh& mesh, const Goal& goal) {
  const AngleClasses classes(goal);
  const KeyLimits limits = limits_of(goal);
  const auto parts =
      map_chunks<PartialStatistics>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        return measure_part(mesh, classes, limits, begin, end);
      });
  return put_together(mesh, goal, classes, parts);
}

struct StatisticsCache::Parts {
  bool is_measured = false;
  bool is_current = false;
  Goal goal;
  std::size_t slots = 0;
  std::vector<PartialStatistics> measured;  // by chunk
  std::vector<char> touched;                // likewise
  MeshStatistics result;
};

StatisticsCache::StatisticsCache() : parts_(std::make_unique<Parts>()) {}
StatisticsCache::~StatisticsCache() = default;

void StatisticsCache::forget() {
  parts_->is_measured = parts_->is_current = false;
}

void StatisticsCache::touch(TetHandle t) {
  const std::size_t chunk = t.index() / kChunkSize;
  if (chunk >= parts_->touched.size()) parts_->touched.resize(chunk + 1);
  parts_->touched[chunk] = 1;
  parts_->is_current = false;
}

const MeshStatistics& StatisticsCache::statistics(const TetMesh& mesh, const Goal& goal) {
  Parts& p = *parts_;
  if (p.is_current && p.goal == goal && p.slots == mesh.tet_slots()) return p.result;
  const std::size_t chunks = chunk_count(mesh.tet_slots());
  const bool keep = p.is_measured && p.goal == goal;
  p.measured.resize(chunks);
  p.touched.resize(chunks);
  const AngleClasses classes(goal);
  const KeyLimits limits = limits_of(goal);
  const std::size_t known = keep ? p.slots / kChunkSize : 0;  // chunks that end where they did
  for_chunks(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    const std::size_t chunk = begin / kChunkSize;
    const bool is_same_size = chunk < known || (keep && mesh.tet_slots() == p.slots);
    if (is_same_size && p.touched[chunk] == 0) return;
    p.measured[chunk] = measure_part(mesh, classes, limits, begin, end);
  });
  p.touched.assign(chunks, 0);
  p.slots = mesh.tet_slots();
  p.goal = goal;
  p.result = put_together(mesh, goal, classes, p.measured);
  p.is_measured = p.is_current = true;
  return p.result;
}

std::string volume_text(double scaled_volume, int scale, int digits) {
  const double volume = std::ldexp(scaled_volume, 3 * scale);
  if (scaled_volume == 0 || std::isnormal(volume)) return fmt::format("{:.{}g}", volume, digits);
  const long double wide = std::ldexp(static_cast<long double>(scaled_volume), 3 * scale);
  return fmt::format("{:.{}g}", wide, digits);
}

std::string volume_text(const MeshStatistics& statistics, int digits) {
  const double scaled = statistics.scaled_volume;
  if (scaled == 0) return fmt::format("{:.{}g}", statistics.volume, digits);
  return volume_text(scaled, statistics.scale, digits);
}

namespace {

/// Of the tets that are not frozen and below the threshold.
struct TetsBelow {
  Quality worst = std::numeric_limits<Quality>::infinity();
  std::size_t n_bad = 0;
  std::size_t n_needles = 0;
  CompensatedSum sum;

  void add(const TetMesh& mesh, TetHandle t) {
    const Quality q = mesh.quality(t);
    worst = std::min(worst, q);
    ++(misses_goal(mesh, t) ? n_bad : n_needles);
    sum.add(static_cast<double>(q));
  }
  void add(const TetsBelow& later) {
    worst = std::min(worst, later.worst);
    n_bad += later.n_bad;
    n_needles += later.n_needles;
    sum.add(later.sum);
  }
};

/// Of the tets that are not frozen.
Quality worst_of_all(const TetMesh& mesh) {
  Quality worst = std::numeric_limits<Quality>::infinity();
  const auto parts = map_chunks<Quality>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Quality part = std::numeric_limits<Quality>::infinity();
    for (std::size_t slot = begin; slot < end; ++slot) {
      const TetHandle t(static_cast<std::uint32_t>(slot));
      if (mesh.quality(t) < part && !mesh.is_frozen(t)) part = mesh.quality(t);
    }
    return part;
  });
  for (const Quality part : parts) worst = std::min(worst, part);
  return worst;
}

}  // namespace

QualityIndicators quality_indicators(const TetMesh& mesh) {
  const auto parts =
      map_chunks<TetsBelow>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        TetsBelow part;
        mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
          if (!mesh.is_frozen(t)) part.add(mesh, t);
        });
        return part;
      });
  TetsBelow below;
  for (const TetsBelow& part : parts) below.add(part);
  const std::size_t count = below.n_bad + below.n_needles;
  const Quality worst = count > 0 ? below.worst : worst_of_all(mesh);
  QualityIndicators result;
  result.n_bad = below.n_bad;
  result.n_needles = below.n_needles;
  if (std::isfinite(worst)) result.q_worst = static_cast<double>(worst);
  result.q_aver = share(below.sum.value(), count);
  return result;
}

MeasureSummary summarize(const TetMesh& mesh, const QualityMeasure& measure) {
  struct Partial {
    double worst = kInfinity;
    CompensatedSum values;
    void add(const TetMesh& of, TetHandle t, const QualityMeasure& by) {
      const auto p = corners(of, t);
      const double value = by.evaluate(p[0], p[1], p[2], p[3]);
      worst = std::min(worst, value);
      values.add(value);
    }
    void add(const Partial& later) {
      worst = std::min(worst, later.worst);
      values.add(later.values);
    }
  };
  if (mesh.tet_count() == 0) return {measure.name, 0, 0};
  const auto sum = sum_up<Partial>(mesh, measure);
  return {measure.name, sum.worst, share(sum.values.value(), mesh.tet_count())};
}

}  // namespace tetmend
