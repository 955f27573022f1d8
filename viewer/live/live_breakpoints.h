// SPDX-License-Identifier: MIT
// Breakpoints of a live run: the same conditions as in a trace, asked of calls as they are made.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/edit.h"
#include "kernel/tet_mesh.h"
#include "trace/trace_sink.h"
#include "viewer/debugger/condition.h"

namespace tetmend::viewer {

/// Follows what a run tells, and notes the first condition that held since the last question.
/// For the thread of the run.
class LiveBreakpoints {
 public:
  /// Inside of a call only if calls are followed.
  void set(std::vector<Condition> conditions);
  /// It must be told of calls: there are conditions, or were some when the call at hand began.
  bool is_following() const { return !conditions_.empty() || !open_.empty(); }

  void visit_begins(Quality quality) { visited_ = quality; }
  void attempt_begins(const TetMesh& mesh, const AttemptEvent& event);
  void attempt_ends(const TetMesh& mesh, Verdict verdict, double worst_before);
  void edit_made(const Journal& journal);
  /// Inside of a call: a condition that holds there, and is not one for good. Forgets it.
  std::optional<std::string> take_now() { return std::exchange(hit_, std::nullopt); }
  /// After an outermost call: the condition that held in it. Forgets it.
  std::optional<std::string> take(bool accepted);

 private:
  struct Call {
    std::string operator_name;
    std::vector<VertexHandle> target;
    unsigned level = 0;
    Quality worst = 0;  // that the tets at the target have
  };
  void look(const TetMesh& mesh, const Call& call, std::optional<Verdict> verdict, double worst);
  void note(const Condition& condition);

  std::vector<Condition> conditions_;
  std::vector<Call> open_;
  Quality visited_ = 0;
  std::optional<std::string> hit_, hit_for_good_;
};

}  // namespace tetmend::viewer
