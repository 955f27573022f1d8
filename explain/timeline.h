// SPDX-License-Identifier: MIT
// A trace over time: where the mesh changed, and the curves of its quality.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/replay.h"

namespace tetmend::explain {

struct Timeline {
  struct Sample {
    std::uint64_t position = 0;
    std::size_t n_bad = 0;
    double q_worst = 0;
  };
  std::vector<Sample> samples;         ///< the first at 0, the last at the end
  std::vector<std::uint64_t> changes;  ///< positions right after events that changed the mesh,
                                       ///< or by what its tets are judged

  /// The last sample that is not after `position`.
  const Sample& at(std::uint64_t position) const;
  /// Number of changes up to `position`: equal numbers mean equal meshes.
  std::size_t changes_before(std::uint64_t position) const;
};

/// A sample after each change of a number, so that curves are steps; with more changes than
/// `samples`, about as many evenly spaced ones. Plays the trace once and leaves the replay at 0.
/// Cost: about two microseconds an event.
/// @param start the mesh at 0, where that is at hand: it knows the qualities of its tets. Of a trace
/// of one pass the bad ones are then not counted, but taken from its end
Timeline make_timeline(const TraceFile& file, Replay& replay, const TetMesh* start = nullptr,
                       std::size_t samples = 200000);

}  // namespace tetmend::explain
