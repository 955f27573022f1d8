// SPDX-License-Identifier: MIT
// Long work beside the interpreter.
#pragma once

#include <atomic>
#include <functional>

namespace tetmend::python {

/// Runs `work` in a thread of its own, without the interpreter's lock, and waits for it. Signals that
/// Python handles (Ctrl-C) set `cancel`; once the work has ended, the exception of their handler is
/// thrown. That thread computes as the library expects, whatever other modules have done to the
/// floating-point settings of this one.
/// @throws what `work` throws
void run_detached(const std::function<void()>& work, std::atomic<bool>& cancel);

/// Of work that cannot be cancelled.
inline void run_detached(const std::function<void()>& work) {
  std::atomic<bool> nobody_looks = false;
  run_detached(work, nobody_looks);
}

}  // namespace tetmend::python
