// SPDX-License-Identifier: MIT
#include "trace/call_tree.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/printable.h"

namespace tetmend {

namespace {

std::string format_target(const Call& call) {
  std::vector<std::uint32_t> numbers;
  for (const VertexHandle v : call.target()) numbers.push_back(v.index());
  return fmt::format("{}", fmt::join(numbers, " "));
}

/// Of a box. A border tells calls that were undone apart without colours.
std::string_view look_of(const Call& call) {
  if (call.undone) return R"(fillcolor="#e8f5e9", style="filled,dashed")";
  return call.accepted() ? R"(fillcolor="#c8e6c9")" : R"(fillcolor="#ffcdd2")";
}

/// Text in JSON or DOT: names may come from plugins.
std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// Writes slices one after the other.
class SliceWriter {
 public:
  explicit SliceWriter(const std::function<void(std::string_view)>& write) : write_(write) {}

  void slice(std::string_view name, std::string_view category, const EventRange& range,
             std::string_view arguments) {
    constexpr double kMicro = 1e6;
    write_(fmt::format(
        R"({}{{"name":{},"cat":{},"ph":"X","pid":1,"tid":1,"ts":{:.3f},"dur":{:.3f},"args":{{{}}}}})",
        first_ ? "\n" : ",\n", in_quotes(name), in_quotes(category), range.begin_seconds * kMicro,
        range.seconds() * kMicro, arguments));
    first_ = false;
  }

 private:
  const std::function<void(std::string_view)>& write_;
  bool first_ = true;
};

}  // namespace

std::string describe_call(const TraceFile& file, std::uint32_t call) {
  const Call& c = file.calls()[call];
  return fmt::format("{}({}) level {}", file.name(c.operator_name), format_target(c), c.level);
}

std::string call_tree_text(const TraceFile& file, std::uint32_t call) {
  const Call& root = file.calls()[call];
  std::string text;
  const auto out = std::back_inserter(text);
  for (std::uint32_t k = call; k < root.subtree_end; ++k) {
    const Call& c = file.calls()[k];
    fmt::format_to(out, "{:>9}  {:{}}{} -> {}", k, "", 2 * (c.depth - root.depth),
                   describe_call(file, k), c.verdict_in_words());
    if (c.has_qualities()) {
      fmt::format_to(out, ", {}worst {:.4f} -> {:.4f}",
                     c.accepted() ? "" : "tried: ", c.worst_before, c.worst_after);
    }
    if (c.edits > 0) fmt::format_to(out, ", {} edit{}", c.edits, c.edits == 1 ? "" : "s");
    if (!c.accepted()) fmt::format_to(out, ": {}", file.reason(c));
    text += '\n';
  }
  return text;
}

std::string call_tree_dot(const TraceFile& file, std::uint32_t call) {
  std::string text =
      "digraph calls {\n  node [shape=box, style=filled, fontname=\"sans-serif\"];\n";
  const auto out = std::back_inserter(text);
  for (std::uint32_t k = call; k < file.calls()[call].subtree_end; ++k) {
    const Call& c = file.calls()[k];
    std::string quality;
    if (c.has_qualities()) {
      quality = fmt::format("\\n{}{:.4f} to {:.4f}", c.accepted() ? "" : "tried: ", c.worst_before,
                            c.worst_after);
    }
    std::string label = in_quotes(fmt::format("{}: {}", k, describe_call(file, k)));
    label.pop_back();
    fmt::format_to(out, "  c{} [label={}\\n{}{}\", {}];\n", k, label, c.verdict_in_words(), quality,
                   look_of(c));
    if (k != call) fmt::format_to(out, "  c{} -> c{};\n", c.parent, k);
  }
  return text + "}\n";
}

void write_slices(const TraceFile& file, const std::function<void(std::string_view)>& write) {
  write(R"({"displayTimeUnit":"ms","traceEvents":[)");
  SliceWriter writer(write);
  for (const TracedPass& pass : file.passes()) {
    writer.slice(file.name(pass.name), "pass", pass.events,
                 fmt::format(R"("round":{},"n_bad":{})", pass.round, pass.now.n_bad));
  }
  for (const Visit& visit : file.visits()) {
    writer.slice("tet", "visit", visit.events, fmt::format(R"("quality":{})", visit.quality));
  }
  for (std::uint32_t k = 0; k < file.calls().size(); ++k) {
    const Call& call = file.calls()[k];
    writer.slice(
        file.name(call.operator_name), "call", call.events,
        fmt::format(R"("call":{},"target":{},"level":{},"verdict":{},"undone_with":{})", k,
                    in_quotes(format_target(call)), call.level, in_quotes(call.verdict_text()),
                    call.undone_with == kNoCall ? "null" : std::to_string(call.undone_with)));
  }
  write("\n]}\n");
}

}  // namespace tetmend
