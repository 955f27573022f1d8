// SPDX-License-Identifier: MIT
// A recorded run, for users.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tetmend/trace.h>

#include "face/mesh_access.h"
#include "trace/call_tree.h"
#include "trace/history.h"
#include "trace/ledger.h"
#include "trace/replay.h"
#include "trace/run_comparison.h"
#include "trace/trace_file.h"
#include "trace/trace_summary.h"

namespace tetmend {

struct Trace::Content {
  TraceFile file;
};

namespace {

Trace::Range to_range(const EventRange& events) {
  return {events.begin, events.end, events.begin_seconds, events.end_seconds};
}

template <class Handles>
std::vector<std::uint32_t> numbers_of(const Handles& vertices) {
  std::vector<std::uint32_t> numbers;
  for (const VertexHandle v : vertices) numbers.push_back(v.index());
  return numbers;
}

void check_number(std::string_view what, std::uint64_t number, std::uint64_t count) {
  if (number < count) return;
  throw Error(
      fmt::format("there is no {} {}; the trace has {}, counted from 0", what, number, count));
}

Trace::Event to_event(const TraceFile& file, const TraceEvent& event) {
  Trace::Event made;
  made.kind = to_string(event.kind);
  if (has_time(event.kind)) made.seconds = event.seconds;
  switch (event.kind) {
    case EventKind::pass_begins:
      made.name = file.name(event.name);
      break;
    case EventKind::attempt_begins:
      made.name = file.name(event.name);
      made.vertices = numbers_of(event.vertices);
      break;
    case EventKind::attempt_ends:
      made.verdict = to_string(event.verdict);
      break;
    case EventKind::replace_cavity:
      made.removed = event.removed.size();
      made.created = event.created.size();
      break;
    case EventKind::visit_begins:
    case EventKind::move_vertex:
    case EventKind::add_vertex:
    case EventKind::remove_vertex:
      made.vertices = numbers_of(event.vertices);
      break;
    default:
      break;
  }
  return made;
}

}  // namespace

Trace::Trace(const std::filesystem::path& file)
    : content_(std::make_unique<Content>(Content{TraceFile(file)})) {}
Trace::~Trace() = default;
Trace::Trace(Trace&& other) noexcept = default;
Trace& Trace::operator=(Trace&& other) noexcept = default;

const std::string& Trace::program() const {
  return content_->file.header().program;
}
const std::string& Trace::input() const {
  return content_->file.header().input;
}
const std::string& Trace::schedule() const {
  return content_->file.header().schedule;
}
const std::vector<std::pair<std::string, std::string>>& Trace::settings() const {
  return content_->file.header().settings;
}
const std::string& Trace::filter() const {
  return content_->file.header().filter;
}
const std::string& Trace::damage() const {
  return content_->file.damage();
}
bool Trace::limit_reached() const {
  return content_->file.limit_reached();
}

std::uint64_t Trace::event_count() const {
  return content_->file.event_count();
}
std::uint32_t Trace::call_count() const {
  return static_cast<std::uint32_t>(content_->file.calls().size());
}
std::size_t Trace::visit_count() const {
  return content_->file.visits().size();
}
std::size_t Trace::pass_count() const {
  return content_->file.passes().size();
}

Trace::Call Trace::call(std::uint32_t number) const {
  const TraceFile& file = content_->file;
  check_number("call", number, file.calls().size());
  const tetmend::Call& from = file.calls()[number];
  Call made;
  made.operator_name = file.name(from.operator_name);
  made.settings = file.name(from.settings);
  made.events = to_range(from.events);
  if (from.parent != kNoCall) made.parent = from.parent;
  made.subtree_end = from.subtree_end;
  made.level = from.level;
  made.depth = from.depth;
  made.edits = from.edits;
  made.target = numbers_of(from.target());
  made.verdict = from.verdict_text();
  made.reason = file.reason(from);
  made.accepted = from.accepted();
  made.for_good = from.accepted_for_good();
  if (from.undone_with != kNoCall) made.undone_with = from.undone_with;
  made.worst_before = from.worst_before;
  made.worst_after = from.worst_after;
  if (!from.accepted() && std::isfinite(from.missing())) made.missing = from.missing();
  return made;
}

Trace::Visit Trace::visit(std::size_t number) const {
  check_number("visit", number, visit_count());
  const tetmend::Visit& from = content_->file.visits()[number];
  return {to_range(from.events), numbers_of(from.tet), from.quality, from.first_call,
          from.last_call};
}

Trace::Pass Trace::pass(std::size_t number) const {
  check_number("pass", number, pass_count());
  const TracedPass& from = content_->file.passes()[number];
  return {content_->file.name(from.name),
          from.round,
          to_range(from.events),
          from.first_call,
          from.last_call,
          from.now};
}

std::vector<Trace::Event> Trace::events(std::uint64_t first, std::uint64_t last) const {
  const TraceFile& file = content_->file;
  if (first > last || last > file.event_count()) {
    throw Error(fmt::format("there are no events {} to {}; the trace has {}, counted from 0", first,
                            last, file.event_count()));
  }
  std::vector<Event> list;
  if (first == last) return list;
  EventCursor cursor(file);
  cursor.move_to(first);
  while (cursor.position() < last) list.push_back(to_event(file, cursor.next()));
  return list;
}

namespace {

Replay replay_to(const TraceFile& file, std::uint64_t n) {
  if (n > file.event_count()) {
    throw Error(fmt::format("there are no {} events; the trace has {}", n, file.event_count()));
  }
  Replay replay(file, 0);
  replay.seek(n);
  return replay;
}

}  // namespace

Mesh Trace::mesh_at(std::uint64_t n) const {
  return MeshAccess::make(replay_to(content_->file, n).mesh().to_data());
}

std::vector<float> Trace::quality_at(std::uint64_t n) const {
  return qualities_of_tets(replay_to(content_->file, n).mesh());
}

std::string_view Trace::measure() const {
  return content_->file.initial_mesh().standard().measure_name();
}

std::vector<Trace::Entry> Trace::ledger() const {
  std::vector<Entry> entries;
  for (const LedgerRow& row : make_ledger(content_->file).rows) {
    const auto all = static_cast<double>(row.total().calls);
    for (std::size_t i = 0; i < kEndingCount; ++i) {
      const LedgerCell& cell = row.cells[i];
      if (cell.calls == 0) continue;
      const auto ending = static_cast<CallEnding>(i);
      entries.push_back({row.operator_name,
                         row.level,
                         name_of(ending),
                         kEndingWords[i].reason,
                         is_refusal(ending),
                         cell.calls,
                         static_cast<double>(cell.calls) / all,
                         cell.seconds,
                         {}});
      if (std::isfinite(cell.nearest)) entries.back().nearest = cell.nearest;
    }
  }
  return entries;
}

std::vector<std::uint32_t> Trace::calls_of(const Entry& entry) const {
  for (std::size_t i = 0; i < kEndingCount; ++i) {
    if (kEndingWords[i].name != entry.ending) continue;
    return calls_in(content_->file, {std::string(entry.operator_name), entry.level,
                                     static_cast<CallEnding>(i), false});
  }
  throw Error(fmt::format("no call ends with '{}'", entry.ending));
}

std::vector<Trace::TetPair> Trace::worse_than(const Trace& other) const {
  std::vector<TetPair> pairs;
  for (const auto& pair : compare_runs(content_->file, other.content_->file).worse_in_a) {
    pairs.push_back(
        {numbers_of(pair.bad), pair.bad_quality, numbers_of(pair.good), pair.good_quality});
  }
  return pairs;
}

std::string Trace::against(const Trace& other) const {
  const TraceFile& b = other.content_->file;
  return format_comparison(content_->file, b, compare_runs(content_->file, b));
}

std::string Trace::history(std::string_view what) const {
  const TraceFile& file = content_->file;
  Replay replay(file, 0);
  return history_text(file, history_of(file, replay, find_subject(file, replay, what)));
}

std::string Trace::summary() const {
  return format_summary(content_->file, summarize(content_->file));
}

std::string Trace::tree(std::uint32_t call) const {
  check_number("call", call, call_count());
  return call_tree_text(content_->file, call);
}

std::string Trace::dot(std::uint32_t call) const {
  check_number("call", call, call_count());
  return call_tree_dot(content_->file, call);
}

void Trace::write_slices(const std::function<void(std::string_view)>& write) const {
  tetmend::write_slices(content_->file, write);
}

}  // namespace tetmend
