// SPDX-License-Identifier: MIT
#include "viewer/live/trial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "schedule/run.h"
#include "schedule/single_attempt.h"
#include "trace/recorder.h"

namespace tetmend::viewer {

namespace {

Composition composition_of(const TrialRequest& request) {
  return {.operator_name = request.operator_name, .settings = request.settings};
}

std::string in_words(const Call& call) {
  if (call.accepted()) {
    if (!call.has_qualities()) return "accepted";
    return fmt::format("accepted: worst quality {:.4f}, before {:.4f}", call.worst_after,
                       call.worst_before);
  }
  const std::string verdict = call.verdict_in_words();
  const double missing = call.missing();
  if (!std::isfinite(missing)) return fmt::format("refused: {}", verdict);
  if (missing <= 0) return fmt::format("refused: {}; the worst tet is no reason", verdict);
  return fmt::format("refused: {}; {:.4f} of quality were missing", verdict, missing);
}

/// The slots that the events write.
std::vector<TetHandle> slots_written(const TraceFile& file) {
  std::vector<TetHandle> slots;
  EventCursor cursor(file);
  for (std::uint64_t k = 0; k < file.event_count(); ++k) {
    const TraceEvent& event = cursor.next();
    if (event.kind != EventKind::replace_cavity && event.kind != EventKind::move_vertex) continue;
    slots.insert(slots.end(), event.removed.begin(), event.removed.end());
    if (event.kind == EventKind::move_vertex) continue;
    slots.insert(slots.end(), event.created.begin(), event.created.end());
  }
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  return slots;
}

}  // namespace

std::size_t vertices_of(TargetKind kind) {
  switch (kind) {
    case TargetKind::tet:
      return 4;
    case TargetKind::edge:
      return 2;
    case TargetKind::face:
      return 3;
    case TargetKind::vertex:
      break;
  }
  return 1;
}

Trial::Trial(const TetMesh& mesh, const Registry& registry, TrialRequest request,
             const std::string& file)
    : request_(std::move(request)), mesh_(mesh) {
  TraceHeader header;
  header.program = "tetmend-view";
  header.input = file;
  header.schedule = "a trial of " + request_.operator_name;
  std::string events;
  {
    TraceRecorder recorder(events, mesh_, std::move(header), TraceClock::real,
                           TraceBeginning::without_mesh);
    Run run(mesh_, registry);
    run.set_trace(&recorder);
    attempt_at(run, composition_of(request_), request_.target);
    run.set_trace(nullptr);
    recorder.finish();
  }
  debugger_ = std::make_unique<Debugger>("the trial", events, mesh);
  const auto calls = debugger_->file().calls();
  if (calls.empty()) throw Error(request_.operator_name + ": nothing here may be changed");
  call_ = calls.front();
  is_accepted_ = call_.accepted();
  outcome_ = in_words(call_);
  seconds_ = call_.events.seconds();
  debugger_->seek(call_.events.end);
  debugger_->know_mesh();
  changed_ = slots_written(debugger_->file());
}

void Trial::make_on(TetMesh& mesh, const Registry& registry) const {
  Run run(mesh, registry);
  attempt_at(run, composition_of(request_), request_.target);
}

}  // namespace tetmend::viewer
