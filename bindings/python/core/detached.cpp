// SPDX-License-Identifier: MIT
#include "bindings/python/core/detached.h"

#include <cfenv>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include <pybind11/pybind11.h>

namespace tetmend::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};

/// A thread and its end.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work) : thread_([this, &work] { run(work); }) {}
  ~Worker() { thread_.join(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// True if it has ended; waits for that a while.
  bool has_ended() {
    std::unique_lock lock(busy_);
    return ended_.wait_for(lock, kBetweenLooks, [this] { return is_done_; });
  }
  /// Precondition: it has ended.
  const std::exception_ptr& failure() const { return failure_; }

 private:
  void run(const std::function<void()>& work) {
    std::fesetenv(FE_DFL_ENV);
    try {
      work();
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(busy_);
    is_done_ = true;
    ended_.notify_one();
  }

  std::mutex busy_;
  std::condition_variable ended_;
  bool is_done_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace

void run_detached(const std::function<void()>& work, std::atomic<bool>& cancel) {
  std::optional<py::error_already_set> interruption;
  std::exception_ptr failure;
  {
    const py::gil_scoped_release others_may_run;
    Worker worker(work);
    while (!worker.has_ended()) {
      if (interruption) continue;
      const py::gil_scoped_acquire interpreter;
      if (PyErr_CheckSignals() == 0) continue;
      interruption.emplace();
      cancel = true;
    }
    failure = worker.failure();
  }
  if (interruption) throw std::move(*interruption);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tetmend::python
