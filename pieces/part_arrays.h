// SPDX-License-Identifier: MIT
// Arrays of a mesh in several files: those that all of them have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "pieces/merged_points.h"
#include "pieces/ranks.h"
#include "pieces/rows.h"

namespace tetmend::pieces {

/// Those of one kind, of the parts that one rank has.
class PartArrays {
 public:
  /// Of the next part. @param count how many points or elements it has; of a part without any,
  /// arrays do not count
  void add(std::vector<DataArray> arrays, std::size_t count);
  /// All ranks: the arrays of all parts, in the order of the first one, with the values of this
  /// rank's.
  /// @param on what has them, for a note about each array that some parts do not have
  std::vector<DataArray> finish(Ranks& ranks, std::string_view on, std::vector<std::string>& notes);

 private:
  struct Known {
    DataArray array;
    std::uint64_t parts = 0;  ///< that have it
    std::uint64_t last = 0;   ///< of these, by number from 1
  };
  /// In the order in which they were asked for.
  struct KnownArrays {
    std::vector<Known> all;
    std::map<OutlineKey, std::size_t> places;

    Known& find(const DataArray& array);
  };

  KnownArrays known_;
  std::uint64_t parts_ = 0;
};

/// All ranks: from values of the points of parts those of the whole mesh. Where parts have several
/// for one point, that of the first part counts.
/// @param arrays  the same on all ranks, with the values of PartPoints::points
std::vector<DataArray> merge_point_arrays(const MergedPoints& merged,
                                          const std::vector<DataArray>& arrays, Ranks& ranks);

}  // namespace tetmend::pieces
