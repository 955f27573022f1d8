// SPDX-License-Identifier: MIT
#include "explain/event_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "explain/stepper.h"
#include "trace/traced_standard.h"

namespace tetmend::explain {

namespace {

/// `position` is right after its first event.
std::string visit_text(const TraceFile& file, std::uint64_t position) {
  const auto number = visit_at(file, position);
  if (!number) return std::string(to_string(EventKind::visit_begins));
  const Visit& visit = file.visits()[*number];
  return fmt::format("visit {} begins: t = {}, quality {:.4f}", *number, format_visit(visit),
                     visit.quality);
}

}  // namespace

std::string format_visit(const Visit& visit) {
  std::string text = "tet";
  TetVertices tet = visit.tet;
  std::sort(tet.begin(), tet.end());
  for (const VertexHandle v : tet) text += fmt::format(" {}", v.index());
  return text;
}

std::string event_text(const TraceFile& file, std::uint64_t position) {
  if (position == 0) return "the trace begins";
  const std::uint32_t call = file.call_at(position - 1);
  EventCursor cursor(file);
  cursor.move_to(position - 1);
  const TraceEvent& event = cursor.next();
  std::string text(to_string(event.kind));
  switch (event.kind) {
    case EventKind::pass_begins:
      return fmt::format("pass {} begins, round {}", file.name(event.name), event.number);
    case EventKind::visit_begins:
      return visit_text(file, position);
    case EventKind::attempt_begins:
      return fmt::format("call {} begins", call);
    case EventKind::attempt_ends:
      return fmt::format("call {} ends: {}", call, file.calls()[call].verdict_in_words());
    case EventKind::replace_cavity:
      return fmt::format("{} tets are replaced by {}", event.removed.size(), event.created.size());
    case EventKind::move_vertex:
    case EventKind::add_vertex:
    case EventKind::remove_vertex:
      return fmt::format("{}: {}", text, event.vertices.front().index());
    case EventKind::undo:
      return "the last edit is undone";
    case EventKind::candidate_found:
      return "a candidate is found";
    case EventKind::standard_changes:
      return fmt::format("the goal becomes {}", describe(event.standard));
    case EventKind::parameter_changes:
      return fmt::format("a parameter changes: {}", file.name(event.name));
    case EventKind::pass_ends:
    case EventKind::visit_ends:
      break;
  }
  return text;
}

}  // namespace tetmend::explain
