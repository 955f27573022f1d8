// SPDX-License-Identifier: MIT
#include "trace/trace_summary.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "trace/call_tree.h"
#include "trace/traced_standard.h"

namespace tetmend {

namespace {

constexpr std::size_t kLargest = 10;

std::vector<std::uint32_t> largest_calls(const TraceFile& file) {
  std::vector<std::uint32_t> calls;
  for (std::uint32_t c = 0; c < file.calls().size(); c = file.calls()[c].subtree_end) {
    if (file.calls()[c].subtree_end - c > 1) calls.push_back(c);
  }
  const auto size = [&](std::uint32_t c) { return file.calls()[c].subtree_end - c; };
  std::stable_sort(calls.begin(), calls.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return size(a) > size(b); });
  if (calls.size() > kLargest) calls.resize(kLargest);
  return calls;
}

double percent(const TraceSummary::Tally& tally) {
  return tally.calls == 0
             ? 0
             : 100 * static_cast<double>(tally.for_good) / static_cast<double>(tally.calls);
}

}  // namespace

TraceSummary summarize(const TraceFile& file) {
  TraceSummary summary;
  const std::span<const Call> calls = file.calls();
  summary.calls = calls.size();
  summary.visits = file.visits().size();
  std::vector<double> inner(calls.size(), 0);  // seconds of the calls in each
  for (const Call& call : calls) {
    if (call.parent != kNoCall) inner[call.parent] += call.events.seconds();
  }
  for (std::uint32_t c = 0; c < calls.size(); ++c) {
    const Call& call = calls[c];
    TraceSummary::Operator& op = summary.operators[std::string(file.name(call.operator_name))];
    for (TraceSummary::Tally* tally : {&op.all, &op.levels[call.level]}) {
      ++tally->calls;
      tally->for_good += call.accepted_for_good() ? 1 : 0;
      tally->undone += call.undone ? 1 : 0;
    }
    ++op.verdicts[call.verdict_text()];
    op.own_seconds += call.events.seconds() - inner[c];
    std::uint32_t around = call.parent;
    while (around != kNoCall && calls[around].operator_name != call.operator_name) {
      around = calls[around].parent;
    }
    if (around == kNoCall) op.seconds += call.events.seconds();
    if (call.depth == 0) ++summary.outermost_calls;
    summary.deepest = std::max<unsigned>(summary.deepest, call.depth);
  }
  summary.edits = file.edit_count();
  summary.undos = file.undo_count();
  summary.largest = largest_calls(file);
  return summary;
}

std::string format_summary(const TraceFile& file, const TraceSummary& summary) {
  std::string text;
  const auto out = std::back_inserter(text);
  const TraceHeader& header = file.header();
  fmt::format_to(out, "{}: {}, schedule {}", header.program, header.input, header.schedule);
  for (const auto& [name, value] : header.settings) fmt::format_to(out, ", {} = {}", name, value);
  fmt::format_to(out, "\n{} events in {} bytes\n", file.event_count(), file.file_size());
  if (!header.filter.empty()) fmt::format_to(out, "left out all but: {}\n", header.filter);
  if (file.limit_reached()) {
    fmt::format_to(out, "the size limit was reached: the trace ends before the run\n");
  }
  const SlotMesh& mesh = file.initial_mesh();
  fmt::format_to(out, "mesh at the beginning: {} tets, {} vertices\n", mesh.tet_count(),
                 mesh.vertex_count());
  fmt::format_to(out, "goal: {}\n", describe(mesh.standard()));
  fmt::format_to(out, "{} calls, {} of them outermost, {} deep at most; {} tets visited; ",
                 summary.calls, summary.outermost_calls, summary.deepest, summary.visits);
  fmt::format_to(out, "{} edits, {} of them undone\n\n", summary.edits, summary.undos);

  fmt::format_to(out, "{:<32} {:>9} {:>9} {:>7} {:>9} {:>9} {:>9}\n", "operator, level", "calls",
                 "for good", "%", "undone", "seconds", "own");
  for (const auto& [name, op] : summary.operators) {
    fmt::format_to(out, "{:<32} {:>9} {:>9} {:>7.1f} {:>9} {:>9.3f} {:>9.3f}\n", name, op.all.calls,
                   op.all.for_good, percent(op.all), op.all.undone, op.seconds, op.own_seconds);
    if (op.levels.rbegin()->first == 0) continue;
    for (const auto& [level, tally] : op.levels) {
      fmt::format_to(out, "  {:<30} {:>9} {:>9} {:>7.1f} {:>9}\n", level, tally.calls,
                     tally.for_good, percent(tally), tally.undone);
    }
  }
  fmt::format_to(out, "\n{:<32} {:<20} {:>9}\n", "operator", "verdict", "calls");
  for (const auto& [name, op] : summary.operators) {
    for (const auto& [verdict, count] : op.verdicts) {
      fmt::format_to(out, "{:<32} {:<20} {:>9}\n", name, verdict, count);
    }
  }
  fmt::format_to(out, "\n{:<24} {:>5} {:>9} {:>9} {:>8} {:>8}\n", "pass", "round", "calls",
                 "seconds", "q_worst", "n_bad");
  Standard standard = mesh.standard();
  auto change = file.parameter_changes().begin();
  for (const TracedPass& pass : file.passes()) {
    for (; change != file.parameter_changes().end() && change->event < pass.events.begin;
         ++change) {
      fmt::format_to(out, "changed while the run was paused: {}\n", file.name(change->text));
    }
    if (pass.standard != standard) fmt::format_to(out, "goal: {}\n", describe(pass.standard));
    standard = pass.standard;
    fmt::format_to(out, "{:<24} {:>5} {:>9} {:>9.3f} {:>8.5f} {:>8}\n", file.name(pass.name),
                   pass.round, pass.last_call - pass.first_call, pass.events.seconds(),
                   pass.now.q_worst, pass.now.n_bad);
  }
  if (!summary.largest.empty()) fmt::format_to(out, "\nlargest calls\n");
  for (const std::uint32_t c : summary.largest) {
    fmt::format_to(out, "{:>9}  {}, {} calls\n", c, describe_call(file, c),
                   file.calls()[c].subtree_end - c);
  }
  return text;
}

}  // namespace tetmend
