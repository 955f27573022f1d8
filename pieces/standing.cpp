// SPDX-License-Identifier: MIT
#include "pieces/standing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/compensated_sum.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

double scale_of(double side) {
  return side > 0 ? std::ldexp(1.0, -std::ilogb(side)) : 1;
}

std::array<Point, 4> corners_of(const Piece& piece, const PieceTet& tet, double scale) {
  std::array<Point, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = scale * piece.points[tet.vertices[i]];
  return corners;
}

void Standing::add(const Standing& other) {
  const auto count = [](const QualityIndicators& of) {
    return static_cast<double>(of.n_bad + of.n_needles);
  };
  const double all = count(indicators) + count(other.indicators);
  if (all > 0) {
    indicators.q_aver = (indicators.q_aver * count(indicators) +
                         other.indicators.q_aver * count(other.indicators)) /
                        all;
  }
  tets += other.tets;
  indicators.q_worst = std::min(indicators.q_worst, other.indicators.q_worst);
  worst_angle = std::min(worst_angle, other.worst_angle);
  indicators.n_bad += other.indicators.n_bad;
  indicators.n_needles += other.indicators.n_needles;
  worst.add(other.worst);
}

void append(const Standing& standing, std::string& bytes) {
  put(standing.tets, bytes);
  put(standing.indicators, bytes);
  put(standing.worst_angle, bytes);
  const std::vector<WorstTet> worst = standing.worst.all();
  put(std::uint64_t{worst.size()}, bytes);
  for (const WorstTet& tet : worst) {
    put(tet.quality, bytes);
    for (const double x : tet.centre) put(x, bytes);
    put(tet.reach, bytes);
  }
}

Standing take_standing(std::string_view& bytes) {
  Standing standing;
  take(bytes, standing.tets);
  take(bytes, standing.indicators);
  take(bytes, standing.worst_angle);
  std::uint64_t count = 0;
  take(bytes, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    WorstTet tet;
    take(bytes, tet.quality);
    for (double& x : tet.centre) take(bytes, x);
    take(bytes, tet.reach);
    standing.worst.add(tet);
  }
  return standing;
}

Standing standing_of(const Piece& piece, const Standard& standard, double side) {
  Standing standing;
  standing.tets = piece.tets.size();
  const double scale = scale_of(side);
  CompensatedSum bad;
  QualityIndicators& indicators = standing.indicators;
  for (const PieceTet& tet : piece.tets) {
    if (tet.is_protected()) continue;
    const std::array<Point, 4> p = corners_of(piece, tet, scale);
    const auto quality_by = [&](const Standard& by) {
      return static_cast<Quality>(by.quality(p[0], p[1], p[2], p[3]));
    };
    const Quality quality = quality_by(standard);
    indicators.q_worst = std::min(indicators.q_worst, static_cast<double>(quality));
    if (quality >= kBadThreshold) continue;
    const Quality of_angles = quality_by(standard.of_angles());
    ++(of_angles < kBadThreshold ? indicators.n_bad : indicators.n_needles);
    standing.worst_angle = std::min(standing.worst_angle, static_cast<double>(of_angles));
    bad.add(static_cast<double>(quality));
    if (of_angles >= kBadThreshold) continue;
    WorstTet worst{of_angles, 0.25 / scale * (p[0] + p[1] + p[2] + p[3]), 0};
    for (const auto& [i, j] : kEdgeVertices) {
      worst.reach = std::max(worst.reach, (p[i] - p[j]).norm() / scale);
    }
    standing.worst.add(worst);
  }
  const std::size_t count = indicators.n_bad + indicators.n_needles;
  indicators.q_aver = count == 0 ? 0 : bad.value() / static_cast<double>(count);
  return standing;
}

}  // namespace tetmend::pieces
