// SPDX-License-Identifier: MIT
// What one thread works with.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/index_set.h"
#include "kernel/workspace.h"
#include "ops/attempt_inspector.h"

namespace tetmend {

/// Tools and counts of one thread. The whole mesh is its territory unless its workspace has entered
/// another.
class Worker {
 public:
  /// `workspace` is the one with the free slots of the mesh, or a Workspace::without_slots().
  Worker(TetMesh& mesh, Workspace workspace)
      : workspace_(std::move(workspace)), context_{mesh, workspace_, states_} {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  const TetMesh& mesh() const { return context_.mesh; }
  Workspace& workspace() { return workspace_; }
  OperatorContext& context() { return context_; }

  /// Null: nobody looks at the attempts.
  void set_inspector(AttemptInspector* inspector) { inspector_ = inspector; }

  /// Says whether the run is to stop. Asked between two attempts, also on the same tet.
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }
  bool is_stopped() const { return is_spent() || (stop_ && stop_()); }
  /// It stops when it has made that many attempts from now on.
  void set_most_attempts(std::size_t attempts) { attempts_left_ = attempts; }
  bool is_spent() const { return attempts_left_ == 0; }

  /// Attempts and counts.
  Verdict attempt(const Operator& op, Target target) {
    return count(attempt_in(context_, op, target));
  }
  /// Attempts, in a context of this worker.
  Verdict attempt_in(OperatorContext& context, const Operator& op, Target target) {
    return inspector_ == nullptr ? op.attempt(context, target)
                                 : inspector_->attempt(op, context, target);
  }
  Verdict count(Verdict verdict) {
    ++verdicts[static_cast<std::size_t>(verdict)];
    if (attempts_left_ > 0) --attempts_left_;
    return verdict;
  }

  std::array<std::size_t, kVerdictCount> verdicts{};  ///< by Verdict, since last taken
  /// What was tried already and needs no second attempt, for each operator of a pass: edges by
  /// their ends, faces by the two vertices opposite. Emptied for each block.
  std::vector<PairSet> tried;

  void provide_memory(std::size_t operators) {
    if (tried.size() < operators) tried.resize(operators);
  }
  void forget_tried() {
    for (PairSet& set : tried) set.clear();
  }

 private:
  Workspace workspace_;
  OperatorStates states_;
  OperatorContext context_;
  AttemptInspector* inspector_ = nullptr;
  std::function<bool()> stop_;
  std::size_t attempts_left_ = std::numeric_limits<std::size_t>::max();
};

/// The attempts of a worker have another judge while this lives.
class JudgedBy {
 public:
  JudgedBy(Worker& worker, const Judge& judge) : context_(worker.context()) {
    context_.judge = &judge;
  }
  ~JudgedBy() { context_.judge = nullptr; }
  JudgedBy(const JudgedBy&) = delete;
  JudgedBy& operator=(const JudgedBy&) = delete;

 private:
  OperatorContext& context_;
};

}  // namespace tetmend
