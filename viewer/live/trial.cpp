// SPDX-License-Identifier: MIT
#include "viewer/live/trial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "kernel/mesh_view.h"
#include "schedule/run.h"
#include "schedule/single_attempt.h"
#include "trace/recorder.h"

namespace tetmend::viewer {

namespace {

/// Slots of vertices as a view of the mesh counts them.
std::vector<std::uint32_t> numbers_of(const TetMesh& mesh, std::span<const VertexHandle> vertices) {
  const MeshView view(mesh);
  const auto slots = view.vertex_slots();
  std::vector<std::uint32_t> numbers;
  for (const VertexHandle v : vertices) {
    std::uint32_t number = v.index();
    if (!slots.empty()) {
      const auto found = std::find(slots.begin(), slots.end(), v.index());
      if (found == slots.end()) throw Error(fmt::format("there is no vertex {}", v.index()));
      number = static_cast<std::uint32_t>(found - slots.begin());
    }
    numbers.push_back(number);
  }
  return numbers;
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
    : request_(std::move(request)), result_(mesh) {
  TraceHeader header;
  header.program = "tetmend-view";
  header.input = file;
  header.schedule = "a trial of " + request_.operator_name;
  std::string trace;
  {
    TraceRecorder recorder(trace, result_, std::move(header));
    Run run(result_, registry);
    run.set_trace(&recorder);
    attempt_once(run,
                 {.what = {.operator_name = request_.operator_name, .settings = request_.settings},
                  .vertices = numbers_of(result_, request_.target)});
    run.set_trace(nullptr);
    recorder.finish();
  }
  debugger_ = std::make_unique<Debugger>("the trial", trace);
  const auto calls = debugger_->file().calls();
  if (calls.empty()) throw Error(request_.operator_name + ": nothing here may be changed");
  call_ = calls.front();
  is_accepted_ = call_.accepted();
  outcome_ = in_words(call_);
  seconds_ = call_.events.seconds();
  debugger_->seek(call_.events.end);
}

}  // namespace tetmend::viewer
