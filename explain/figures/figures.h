// SPDX-License-Identifier: MIT
// The four figures of a call; see call_figure.h.
#pragma once

#include "explain/call_study.h"
#include "explain/figures/call_figure.h"
#include "explain/timeline.h"

namespace tetmend::explain {

/// More than these are no longer read.
inline constexpr std::size_t kMostTreeRows = 400;
inline constexpr std::size_t kMostShellTets = 300;

/// Precondition of both: the study is one of this trace. @throws Error as draw_call()
figure::Drawing draw_ring(const TraceFile& file, const CallStudy& study);
figure::Drawing draw_shell(const TraceFile& file, const CallStudy& study,
                           const std::optional<Look>& look);
figure::Drawing draw_tree(const TraceFile& file, Replay& replay, std::uint32_t call);
figure::Drawing draw_timeline(const TraceFile& file, const Timeline& timeline,
                              const std::optional<std::uint32_t>& call);

}  // namespace tetmend::explain
