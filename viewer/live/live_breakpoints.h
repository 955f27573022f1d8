// SPDX-License-Identifier: MIT
// Breakpoints of a live run: the same conditions as in a trace, asked of calls as they are made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/edit.h"
#include "kernel/tet_mesh.h"
#include "trace/trace_sink.h"
#include "viewer/debugger/condition.h"

namespace tetmend::viewer {

/// Follows what a run tells, and notes the first condition that held in the outermost call at hand.
/// For the thread of the run.
class LiveBreakpoints {
 public:
  void set(std::vector<Condition> conditions) { conditions_ = std::move(conditions); }
  bool is_empty() const { return conditions_.empty(); }

  void visit_begins(Quality quality) { visited_ = quality; }
  void attempt_begins(const TetMesh& mesh, const AttemptEvent& event);
  void attempt_ends(const TetMesh& mesh, Verdict verdict, double worst_before);
  void edit_made(const Journal& journal);
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
