// SPDX-License-Identifier: MIT
// Which attempts of plugins have not come back yet: for those who want to know why a run stands
// still, or where it crashed.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "ops/operator.h"

namespace tetmend {

/// While one lives, others see that this thread makes that attempt. Only those of plugins are seen,
/// and of one in another the outer one. Cost: a lock that nobody else holds; nothing for an operator
/// of tetmend itself.
class AttemptMark {
 public:
  /// Precondition: the operator outlives this.
  AttemptMark(const Operator& op, Target target) {
    if (!op.origin().empty()) begin(op, target);
  }
  ~AttemptMark() {
    if (op_ != nullptr) end();
  }
  AttemptMark(const AttemptMark&) = delete;
  AttemptMark& operator=(const AttemptMark&) = delete;

  /// Precondition of these: a mark that others see.
  const Operator& op() const { return *op_; }
  Target target() const { return target_; }
  std::chrono::steady_clock::time_point since() const { return since_; }

 private:
  void begin(const Operator& op, Target target);
  void end();

  const Operator* op_ = nullptr;  // null: nobody sees it
  Target target_{};
  std::chrono::steady_clock::time_point since_;
};

/// An attempt of a plugin's operator that has not come back.
struct PendingAttempt {
  std::string what;  ///< operator, plugin and target, for a message
  std::chrono::steady_clock::time_point since;
};

/// Those of all threads. Any thread may ask.
std::vector<PendingAttempt> pending_attempts();

/// From now on each thread calls this before its first attempt of a plugin. Precondition: no such
/// attempt has been made.
void set_attempt_thread_hook(void (*hook)());

/// That of the calling thread; null if there is none. A signal handler may ask.
const AttemptMark* own_pending_attempt() noexcept;

}  // namespace tetmend
