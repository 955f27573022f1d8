// SPDX-License-Identifier: MIT
#include "explain/icicle.h"

#include <algorithm>

namespace tetmend::explain {

CallWindow whole_trace(const TraceFile& file) {
  return {0, file.event_count(), 0, static_cast<std::uint32_t>(file.calls().size())};
}

CallWindow pass_around(const TraceFile& file, std::uint64_t position) {
  for (const TracedPass& pass : file.passes()) {
    if (pass.events.begin < position && position <= pass.events.end) {
      return {pass.events.begin, pass.events.end, pass.first_call, pass.last_call};
    }
  }
  return whole_trace(file);
}

CallWindow call_window(const TraceFile& file, std::uint32_t call) {
  const Call& c = file.calls()[call];
  return {c.events.begin, c.events.end, call, c.subtree_end};
}

std::vector<IcicleBar> lay_out_icicle(const TraceFile& file, const CallWindow& window,
                                      double thinnest) {
  std::vector<IcicleBar> bars;
  if (window.first_call >= window.last_call) return bars;
  std::vector<std::size_t> last_in_row;  // bars of joined calls grow
  const double events = static_cast<double>(std::max<std::uint64_t>(1, window.end - window.begin));
  const auto place = [&](std::uint64_t event) {
    return static_cast<double>(event - window.begin) / events;
  };
  const unsigned top = file.calls()[window.first_call].depth;
  for (std::uint32_t k = window.first_call; k < window.last_call;) {
    const Call& call = file.calls()[k];
    const IcicleBar bar{place(call.events.begin), place(call.events.end), call.depth - top, k, 1};
    if (bar.row >= last_in_row.size()) last_in_row.resize(bar.row + 1, bars.size());
    const bool is_thin = bar.right - bar.left < thinnest;
    IcicleBar* before = nullptr;
    if (const std::size_t i = last_in_row[bar.row]; i < bars.size() && bars[i].row == bar.row) {
      before = &bars[i];
    }
    // Joined while the bar that results is thin itself, so that many make no long blur.
    const bool joins = is_thin && before != nullptr && bar.left - before->right < thinnest &&
                       before->right - before->left < thinnest;
    if (joins) {
      before->right = std::max(before->right, bar.right);
      ++before->count;
    } else {
      last_in_row[bar.row] = bars.size();
      bars.push_back(bar);
    }
    k = is_thin ? call.subtree_end : k + 1;
  }
  return bars;
}

const IcicleBar* bar_at(const std::vector<IcicleBar>& bars, double x, unsigned row) {
  const auto found = std::find_if(bars.begin(), bars.end(), [&](const IcicleBar& bar) {
    return bar.row == row && bar.left <= x && x <= bar.right;
  });
  return found == bars.end() ? nullptr : &*found;
}

}  // namespace tetmend::explain
