// SPDX-License-Identifier: MIT
// Exceptions of loops on several threads.
#pragma once

#include <atomic>
#include <exception>
#include <utility>

namespace tetmend {

/// Keeps the first exception of several threads. oneTBB would need memory to carry it from one to
/// another, and ends the process if there is none.
class FirstFailure {
 public:
  /// Calls `work`, on any thread.
  template <class Work>
  void guard(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      if (!failed_.exchange(true)) failure_ = std::current_exception();
    }
  }
  bool failed() const { return failed_.load(std::memory_order_relaxed); }
  /// Throws what was kept. Precondition: all calls of guard() have returned.
  void rethrow() {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
};

}  // namespace tetmend
