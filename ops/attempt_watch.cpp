// SPDX-License-Identifier: MIT
// A signal handler and a thread that looks after others can reach nothing but globals.
#include "ops/attempt_watch.h"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

namespace tetmend {

namespace {

thread_local const AttemptMark* own = nullptr;  // no constructor: a handler may read it
void (*thread_hook)() = nullptr;

/// What other threads see of one.
struct Window {
  std::mutex busy;
  const AttemptMark* mark = nullptr;
};

struct Windows {
  std::mutex busy;
  std::vector<Window*> all;
};

/// Never destroyed: threads may end after the program has begun to.
Windows& windows() {
  static Windows& windows = *new Windows;
  return windows;
}

/// A thread has a window from its first attempt of a plugin on.
class OwnWindow {
 public:
  OwnWindow() {
    if (thread_hook != nullptr) thread_hook();
    const std::lock_guard lock(windows().busy);
    windows().all.push_back(&window_);
  }
  ~OwnWindow() {
    const std::lock_guard lock(windows().busy);
    std::erase(windows().all, &window_);
  }
  OwnWindow(const OwnWindow&) = delete;
  OwnWindow& operator=(const OwnWindow&) = delete;

  /// Who looks in has done so when this returns: then what was shown may vanish.
  void show(const AttemptMark* mark) {
    const std::lock_guard lock(window_.busy);
    window_.mark = mark;
  }

 private:
  Window window_;
};

OwnWindow& own_window() {
  thread_local OwnWindow window;
  return window;
}

}  // namespace

void AttemptMark::begin(const Operator& op, Target target) {
  if (own != nullptr) return;
  op_ = &op;
  target_ = target;
  since_ = std::chrono::steady_clock::now();
  own_window().show(this);
  own = this;
}

void AttemptMark::end() {
  own = nullptr;
  own_window().show(nullptr);
}

std::vector<PendingAttempt> pending_attempts() {
  std::vector<PendingAttempt> pending;
  const std::lock_guard lock(windows().busy);
  for (Window* window : windows().all) {
    const std::lock_guard look(window->busy);
    if (window->mark == nullptr) continue;
    const AttemptMark& mark = *window->mark;
    pending.push_back(
        {fmt::format("operator '{}' of {} at {} {}", mark.op().info().name, mark.op().origin(),
                     to_string(mark.target().kind), mark.target().code),
         mark.since()});
  }
  return pending;
}

void set_attempt_thread_hook(void (*hook)()) {
  thread_hook = hook;
}

const AttemptMark* own_pending_attempt() noexcept {
  return own;
}

}  // namespace tetmend
