// SPDX-License-Identifier: MIT
// Which part of space belongs to which piece.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/hilbert.h"
#include "kernel/mesh_data.h"
#include "pieces/piece.h"
#include "pieces/zones.h"

namespace tetmend::pieces {

/// A cube around a mesh, shifted as those of schedule/partition.h. Nothing but `low`, `side` and
/// `shift` enters, so all who know them have the same curve.
HilbertCurve shifted_curve(const Point& low, double side, unsigned shift);

/// Counts keys, to cut a curve into parts of about the same weight. Whole numbers: who counts which
/// key, and in which order, cannot show. All keys are counted twice, so that a few fine cells are
/// enough: those around the cuts.
class KeyHistogram {
 public:
  void count(std::uint64_t key);
  /// By cell of the curve; those of several histograms may be added up.
  std::span<std::int64_t> counts() { return counts_; }
  /// After the first count, of all keys: from now on cells are finer, and counts are 0 again.
  void refine(std::size_t parts);
  /// After the second: keys at which the parts begin; the first is 0.
  std::vector<std::uint64_t> cuts() const;

 private:
  static constexpr int kBits = 21;        // fine cells of 1/128 of the cube
  static constexpr int kCoarseBits = 12;  // coarse ones of 1/16
  static constexpr int kShift = 63 - kBits;
  static constexpr std::size_t kFine = std::size_t{1} << (kBits - kCoarseBits);  // of a coarse one
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// Where a part begins.
  struct Cut {
    std::uint32_t cell = 0;    ///< coarse
    std::int64_t missing = 0;  ///< keys of that cell that are before it, at least; times parts
  };
  std::vector<std::int64_t> counts_ = std::vector<std::int64_t>(std::size_t{1} << kCoarseBits, 0);
  std::vector<std::uint32_t>
      refined_;            // by coarse cell: which it is of those that are counted finely
  std::vector<Cut> cuts_;  // of all parts but the first
};

/// The parts of one division: stretches of a Hilbert curve, and zones, which go before them.
struct Parting {
  Point low = Point::Zero();
  double side = 0;
  unsigned shift = 0;
  std::vector<std::uint64_t> cuts = {0};  ///< key at which each stretch begins
  ZoneMap zones = {};                     ///< their parts follow those of the curve
  bool sends_all = true;                  ///< or only what is left to work on: see kSent

  /// The part of vertices that were not sent: what lies around them is in no gathered piece.
  static constexpr std::uint32_t kNoPart = 0xFFFFFFFF;
  std::size_t stretches() const { return cuts.size(); }
  std::size_t parts() const { return cuts.size() + zones.count(); }
  /// Part of each point.
  std::vector<std::uint32_t> parts_of(std::span<const Point> points) const;
  /// Of the stretches those that may have points of a box, ascending. Zones do not count.
  std::vector<std::uint32_t> stretches_of(const Eigen::AlignedBox3d& box) const;
  /// Part of each vertex of a gathered piece.
  std::vector<std::uint32_t> parts_of(const Piece& gathered) const;

 private:
  std::uint32_t part_of(const Point& point, const HilbertCurve& curve) const;
  std::uint32_t stretch_of(std::uint64_t key) const;
};

/// Whether an element belongs to the part: that of its vertices with the lowest number. `parts` is by
/// vertex.
template <std::size_t N>
bool is_own(const std::array<std::uint32_t, N>& vertices, std::span<const std::uint32_t> parts,
            std::uint32_t number) {
  std::uint32_t least = parts[vertices[0]];
  for (const std::uint32_t v : vertices) least = std::min(least, parts[v]);
  return least == number;
}

}  // namespace tetmend::pieces
