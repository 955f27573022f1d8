// SPDX-License-Identifier: MIT
#include "viewer/debugger/paper_lines.h"

namespace tetmend::viewer {

namespace {

constexpr std::array<std::string_view, 8> kShell = {
    "best triangulation of each pocket p_i .. p_j",
    "the same for pockets beyond p_m",
    "graph: an arc i -> j for each pocket that has one",
    "core: the best cycle of arcs; none: full reduction",
    "triangles: those of the pockets outside the core",
    "covering: 2 tets a triangle, 1 tet a side of the core",
    "if it is better than the old tets",
    "    replace them by it"};
constexpr Pseudocode kShellCode = {"Algorithm 3: shell transformation of edge ab", kShell};

constexpr std::array<std::string_view, 15> kRecursion = {
    "if edge e, or face f, is gone already",
    "    success",
    "transform the shell of e (Algorithm 3)",
    "if edge e, or face f, is gone now",
    "    success",
    "if the level is the deepest allowed",
    "    fail",
    "m = degree of the shell",
    "for each supporting face f_i of e",
    "    e' = its reflex link edge, if any",
    "    if there is one",
    "        recursion: remove f_i at e', level + 1",
    "        if the degree is below m now",
    "            once more from line 1",
    "fail"};
constexpr Pseudocode kRecursionCode = {"Algorithm 4: remove edge e, or face f at e", kRecursion};

bool is_shell(const Call& call) {
  return call.algorithm == Algorithm::shell_transformation ||
         call.algorithm == Algorithm::edge_removal;
}

EventKind last_kind(const TraceFile& file, std::uint64_t position) {
  EventCursor cursor(file);
  cursor.move_to(position - 1);
  return cursor.next().kind;
}

unsigned line_of_end(const Call& call) {
  if (call.accepted()) return 8;
  return call.verdict == Verdict::no_improvement && !call.candidate_found ? 4 : 7;
}

unsigned line_of_shell(const TraceFile& file, const Call& call, std::uint64_t position) {
  switch (last_kind(file, position)) {
    case EventKind::attempt_begins:
      return 1;
    case EventKind::candidate_found:
      return 6;
    case EventKind::attempt_ends:
      return line_of_end(call);
    case EventKind::undo:
      return 7;
    default:
      return 8;
  }
}

/// The call is the innermost: it has just begun or ended.
unsigned line_of_recursion(const TraceFile& file, std::uint32_t number, std::uint64_t position) {
  const Call& call = file.calls()[number];
  if (position < call.events.end) return 1;
  if (call.accepted()) return 5;
  const bool recursed = call.subtree_end > number + 2;  // more in it than its own transformation
  return call.verdict == Verdict::depth_spent && !recursed ? 7 : 15;
}

}  // namespace

const Pseudocode& shell_transformation_code() {
  return kShellCode;
}

const Pseudocode& recursion_code() {
  return kRecursionCode;
}

CodePlace code_place(const TraceFile& file, std::span<const std::uint32_t> stack, std::size_t i,
                     std::uint64_t position) {
  const Call& call = file.calls()[stack[i]];
  const bool is_innermost = i + 1 == stack.size();
  if (is_shell(call)) {
    return {&kShellCode, is_innermost ? line_of_shell(file, call, position) : 1};
  }
  if (call.algorithm != Algorithm::recursion) return {};
  if (is_innermost) return {&kRecursionCode, line_of_recursion(file, stack[i], position)};
  const Call& inner = file.calls()[stack[i + 1]];
  const bool is_done = inner.events.end <= position;
  if (is_shell(inner)) return {&kRecursionCode, is_done ? 4U : 3U};
  return {&kRecursionCode, is_done ? 13U : 12U};
}

}  // namespace tetmend::viewer
