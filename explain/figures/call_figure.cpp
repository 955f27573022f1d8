// SPDX-License-Identifier: MIT
#include "explain/figures/call_figure.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "explain/figures/figures.h"
#include "kernel/error.h"

namespace tetmend::explain {

namespace {

constexpr std::array<std::string_view, 4> kKinds = {"ring", "tree", "timeline", "shell"};

}  // namespace

FigureKind find_figure_kind(std::string_view name) {
  const auto found = std::find(kKinds.begin(), kKinds.end(), name);
  if (found == kKinds.end()) {
    throw Error(
        fmt::format("there is no figure '{}': expected one of {}", name, fmt::join(kKinds, ", ")));
  }
  return static_cast<FigureKind>(found - kKinds.begin());
}

std::string_view to_string(FigureKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

figure::Drawing draw_call(const TraceFile& file, Replay& replay, const FigureRequest& request) {
  if (!request.call && request.kind != FigureKind::timeline) {
    throw Error(fmt::format("a {} is that of a call: say which", to_string(request.kind)));
  }
  if (request.call && *request.call >= file.calls().size()) {
    throw Error(fmt::format("there is no call {}; the trace has {}, counted from 0", *request.call,
                            file.calls().size()));
  }
  switch (request.kind) {
    case FigureKind::ring:
      return draw_ring(file, study_call(file, replay, *request.call));
    case FigureKind::shell:
      return draw_shell(file, study_call(file, replay, *request.call), request.look);
    case FigureKind::tree:
      return draw_tree(file, replay, *request.call);
    case FigureKind::timeline:
      break;
  }
  const std::uint64_t here = replay.position();
  const Timeline timeline = make_timeline(file, replay);
  replay.seek(here);
  return draw_timeline(file, timeline, request.call);
}

}  // namespace tetmend::explain
