// SPDX-License-Identifier: MIT
// One mesh of parts that are files of their own: which of their points are the same.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/mesh_data.h"
#include "pieces/ranks.h"

namespace tetmend::pieces {

/// The points of the parts that one rank has, part after part. Ranks have ranges of the parts.
struct PartPoints {
  std::vector<Point> points;
  std::vector<Label> labels;           ///< of each point, or none
  std::vector<std::uint64_t> ids;      ///< of each point in the whole mesh, or none on all ranks
  std::vector<std::uint64_t> part_of;  ///< of each point: the number of its part
};

/// The points of the whole mesh, numbered through.
struct MergedPoints {
  std::vector<std::uint64_t> numbers;  ///< by point of the parts of this rank
  /// The range that this rank has; that of the first rank comes first.
  std::vector<Point> points;
  std::vector<Label> labels;  ///< of each, or none
};

/// All ranks. Points of one id are one, in the order of ids; without ids those are one that lie at
/// one place, bit for bit, in the order in which the parts name them first. How many ranks there are
/// cannot show in the numbers.
/// @throws Error for one id at two places; without ids for two points of a part at a place where
/// another part has one, too: which of them it is cannot be told
MergedPoints merge_points(const PartPoints& mine, Ranks& ranks);

}  // namespace tetmend::pieces
