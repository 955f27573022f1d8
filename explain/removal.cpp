// SPDX-License-Identifier: MIT
#include "explain/removal.h"

#include <algorithm>

#include <fmt/format.h>

namespace tetmend::explain {

namespace {

bool is_recursion(const Call& call) {
  return call.algorithm == Algorithm::recursion && call.target_size == 2;
}

bool is_same_edge(const Call& x, const Call& y) {
  const auto p = x.target();
  const auto q = y.target();
  return (p[0] == q[0] && p[1] == q[1]) || (p[0] == q[1] && p[1] == q[0]);
}

}  // namespace

std::uint32_t recursion_of(const TraceFile& file, std::uint32_t call) {
  const auto calls = file.calls();
  if (is_recursion(calls[call])) return call;
  const std::uint32_t parent = calls[call].parent;
  const bool is_step = parent != kNoCall && is_recursion(calls[parent]) &&
                       calls[call].target_size == 2 && is_same_edge(calls[call], calls[parent]);
  return is_step ? parent : kNoCall;
}

std::uint32_t caller_of(const TraceFile& file, std::uint32_t call) {
  const auto calls = file.calls();
  const std::uint32_t inner = recursion_of(file, call);
  if (inner == kNoCall) return kNoCall;
  for (std::uint32_t c = calls[inner].parent; c != kNoCall; c = calls[c].parent) {
    if (is_recursion(calls[c]) && calls[c].level < calls[inner].level) return c;
  }
  return kNoCall;
}

std::optional<Removal> removal_of(const TraceFile& file, std::uint32_t call) {
  const std::uint32_t inner = recursion_of(file, call);
  if (inner == kNoCall) return std::nullopt;
  const auto edge = file.calls()[inner].target();
  Removal removal{{edge[0], edge[1]}, std::nullopt, file.calls()[inner].level};
  const std::uint32_t outer = caller_of(file, call);
  if (outer == kNoCall) return removal;
  const auto around = file.calls()[outer].target();
  // A link edge of f has one end on the edge of the caller; the other end is the p_i of f.
  for (unsigned i = 0; i < 2; ++i) {
    const bool is_on = edge[i] == around[0] || edge[i] == around[1];
    const VertexHandle p = edge[1 - i];
    if (is_on && p != around[0] && p != around[1]) removal.face = {around[0], around[1], p};
  }
  return removal;
}

std::string to_text(const Removal& removal) {
  const std::string edge = fmt::format("{} {}", removal.edge[0].index(), removal.edge[1].index());
  if (!removal.face) return fmt::format("to remove: edge e = {}, level {}", edge, removal.level);
  const auto& f = *removal.face;
  return fmt::format("to remove: face f = {} {} {} at its link edge e = {}, level {}", f[0].index(),
                     f[1].index(), f[2].index(), edge, removal.level);
}

}  // namespace tetmend::explain
