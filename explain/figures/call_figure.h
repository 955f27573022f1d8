// SPDX-License-Identifier: MIT
// Calls of a trace as figures for papers: black on white, with a legend, the same for window and
// command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "figure/drawing.h"
#include "trace/replay.h"

namespace tetmend::explain {

enum class FigureKind : unsigned char {
  ring,      ///< the skirt polygon, before and after
  tree,      ///< a call and all calls in it
  timeline,  ///< bad tets and worst quality over the events, and the calls as icicles
  shell      ///< the tets of the call, before and after
};
/// "ring", "tree", "timeline", "shell".
/// @throws Error for another word, with the valid ones
FigureKind find_figure_kind(std::string_view name);
std::string_view to_string(FigureKind kind);

/// Where a figure is seen from, in degrees: yaw around z, from x towards y; pitch above the xy
/// plane.
struct Look {
  double yaw = 0, pitch = 0;
};

struct FigureRequest {
  FigureKind kind = FigureKind::ring;
  /// Of a timeline, the call whose icicles are drawn; without one those of the whole trace.
  std::optional<std::uint32_t> call;
  /// Of a shell; without it, an edge is upright and the corners are far from each other.
  std::optional<Look> look;
};

/// Leaves the replay where it was. Cost: a study of the call; of a timeline, plays the trace once.
/// @throws Error when the call is missing or is none of the trace, when it has nothing of that kind
/// to draw (a ring of a vertex), or more of it than a figure can have.
figure::Drawing draw_call(const TraceFile& file, Replay& replay, const FigureRequest& request);

}  // namespace tetmend::explain
