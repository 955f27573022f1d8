// SPDX-License-Identifier: MIT
#include "pieces/side_by_side.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

namespace tetmend::pieces {

namespace {

using Use = SideBySide::Use;
using Make = std::function<Use(std::size_t)>;

/// Threads that take one number after another, and the caller, who uses what they have made.
class Crew {
 public:
  /// @param most  that are made and wait
  Crew(std::size_t count, std::size_t most, const Make& make)
      : count_(count), most_(most), make_(make) {
    made_.reserve(count);
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() { join(); }

  /// The threads are dealt out evenly. False: there is no room for any.
  bool begin(std::size_t workers, std::size_t threads) {
    threads_.reserve(workers);
    try {
      for (std::size_t i = 0; i < workers; ++i) {
        const std::size_t own = threads / workers + (i < threads % workers ? 1 : 0);
        ++at_work_;
        threads_.emplace_back([this, own] { work(static_cast<int>(own)); });
      }
    } catch (...) {
      leave();
    }
    return !threads_.empty();
  }
  /// Until all is made and used, or something has failed.
  void use_all() {
    while (const Use use = wait_for_one()) {
      try {
        use();
      } catch (...) {
        fail(count_, std::current_exception());
      }
    }
    join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  void work(int threads) noexcept {
    try {
      tbb::task_arena arena(threads);
      arena.execute([this] {
        for (std::size_t i = take_number(); i < count_; i = take_number()) make_one(i);
      });
    } catch (...) {
      fail(count_, std::current_exception());
    }
    leave();
  }
  void make_one(std::size_t i) {
    try {
      Use use = make_(i);
      const std::lock_guard lock(mutex_);
      made_.push_back(std::move(use));
    } catch (...) {
      fail(i, std::current_exception());
    }
    changed_.notify_all();
  }
  /// Of the next one, as soon as there is room for it.
  std::size_t take_number() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return failure_ || made_.size() < most_; });
    return failure_ || next_ == count_ ? count_ : next_++;
  }
  Use wait_for_one() {
    Use use;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !made_.empty() || at_work_ == 0; });
      if (made_.empty() || failure_) return {};
      use = std::move(made_.back());
      made_.pop_back();
    }
    changed_.notify_all();
    return use;
  }
  void fail(std::size_t number, std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (number < failed_) {
      failed_ = number;
      failure_ = std::move(failure);
    }
    changed_.notify_all();
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --at_work_;
    changed_.notify_all();
  }
  void join() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

  const std::size_t count_;
  const std::size_t most_;
  const Make& make_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Use> made_;
  std::size_t next_ = 0;
  std::size_t at_work_ = 0;  // threads
  std::size_t failed_ = kNobody;
  std::exception_ptr failure_;  // of that one
};

}  // namespace

void SideBySide::each(std::size_t count, const Make& make) const {
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const std::size_t workers = std::min({count, most_, threads});
  if (workers > 1) {
    Crew crew(count, workers, make);
    if (crew.begin(workers, threads)) return crew.use_all();
  }
  for (std::size_t i = 0; i < count; ++i) make(i)();
}

}  // namespace tetmend::pieces
