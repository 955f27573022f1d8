// SPDX-License-Identifier: MIT
// Calls as bars under each other, as wide as the events in them: a flame graph upside down.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "explain/call_facts.h"

namespace tetmend::explain {

struct IcicleBar {
  double left = 0, right = 0;    ///< shares of the width
  unsigned row = 0;              ///< calls around it, counted from the outermost in the window
  std::uint32_t call = kNoCall;  ///< of a bar of many calls: the first of them
  std::uint32_t count = 1;       ///< more than 1: neighbours that are too thin to be drawn alone
  std::array<std::uint32_t, kOutcomeCount> ended{};  ///< how many of them in which way, by Outcome
};

/// A part of a trace: the calls of an outermost call, of a pass, or all.
struct CallWindow {
  std::uint64_t begin = 0, end = 0;             ///< events
  std::uint32_t first_call = 0, last_call = 0;  ///< the calls from one up to before the other
};
CallWindow whole_trace(const TraceFile& file);
/// The pass at that position, or all where none is.
CallWindow pass_around(const TraceFile& file, std::uint64_t position);
/// Precondition: there is such a call.
CallWindow call_window(const TraceFile& file, std::uint32_t call);

/// A part of `shown`, or more of it up to `whole`: `factor` times as many events, the one at the
/// share `at` of the width stays where it is.
CallWindow zoomed(const CallWindow& whole, const CallWindow& shown, double at, double factor);
/// As many events from another on, within `whole`.
CallWindow panned(const CallWindow& whole, const CallWindow& shown, std::int64_t events);

/// Bars of at least `thinnest` of the width; what is thinner is joined with its neighbours, and
/// what is in it left out. In the order of calls. Calls that reach beyond the events of the window
/// are cut there. Cost: linear in the calls that are not left out.
std::vector<IcicleBar> lay_out_icicle(const TraceFile& file, const CallWindow& window,
                                      double thinnest);

/// Rows of one height that fill the band, all whole.
double icicle_row_height(const std::vector<IcicleBar>& bars, double band);

/// What stands in the bar of a single call.
struct BarName {
  std::vector<std::string> lines;  ///< none: there is no room
  double size = 0;                 ///< of the text
};
/// Operator and target, in one line or in as many as fit, smaller if need be; else the target alone.
/// @param text the size of the text, if there is room
/// @param width_of a text in that size
BarName name_in_bar(const std::string& operator_name, const std::string& target, double width,
                    double height, double text,
                    const std::function<double(const std::string&)>& width_of);

/// The bar at a place; null where there is none.
const IcicleBar* bar_at(const std::vector<IcicleBar>& bars, double x, unsigned row);

}  // namespace tetmend::explain
