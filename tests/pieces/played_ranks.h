// SPDX-License-Identifier: MIT
// Ranks that are threads of one process: what MPI would do, without it.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "kernel/error.h"
#include "pieces/bytes.h"
#include "pieces/ranks.h"

namespace tetmend::test {

class Play {
 public:
  explicit Play(std::size_t count)
      : count_(count), slots_(count, std::vector<std::string>(count)) {}

  /// Ends when all ranks have come here. @throws Error when one of them has failed.
  void meet() {
    std::unique_lock lock(busy_);
    const std::size_t meeting = meetings_;
    if (++here_ == count_) {
      here_ = 0;
      ++meetings_;
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return meetings_ != meeting || failure_; });
    if (meetings_ == meeting) throw Error("another rank failed");
  }
  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(busy_);
    if (!failure_) failure_ = std::move(failure);
    changed_.notify_all();
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }
  std::string& slot(std::size_t from, std::size_t to) { return slots_[from][to]; }
  std::size_t count() const { return count_; }

 private:
  const std::size_t count_;
  std::vector<std::vector<std::string>> slots_;
  std::mutex busy_;
  std::condition_variable changed_;
  std::size_t here_ = 0;
  std::size_t meetings_ = 0;
  std::exception_ptr failure_;
};

class PlayedRank final : public pieces::Ranks {
 public:
  PlayedRank(Play& play, std::size_t number) : play_(play), number_(number) {}
  std::size_t count() const override { return play_.count(); }
  std::size_t number() const override { return number_; }
  std::vector<std::string> gather(std::string_view mine) override {
    return exchange(std::vector<std::string>(count(), std::string(mine)));
  }
  void add(std::span<std::int64_t> sums) override {
    std::string mine;
    for (const std::int64_t sum : sums) pieces::put(sum, mine);
    std::fill(sums.begin(), sums.end(), 0);
    for (const std::string& from : gather(mine)) {
      std::string_view rest = from;
      for (std::int64_t& sum : sums) {
        std::int64_t other = 0;
        pieces::take(rest, other);
        sum += other;
      }
    }
  }
  std::vector<std::string> exchange(std::vector<std::string> to) override {
    for (std::size_t r = 0; r < count(); ++r) play_.slot(number_, r) = std::move(to[r]);
    play_.meet();
    std::vector<std::string> came(count());
    for (std::size_t r = 0; r < count(); ++r) came[r] = std::move(play_.slot(r, number_));
    play_.meet();
    return came;
  }

 private:
  Play& play_;
  std::size_t number_;
};

/// Calls work(ranks) for each of so many ranks at once. @throws what the first one threw that failed
template <class Work>
void on_ranks(std::size_t count, const Work& work) {
  Play play(count);
  std::vector<std::thread> threads;
  for (std::size_t r = 0; r < count; ++r) {
    threads.emplace_back([&play, &work, r] {
      try {
        PlayedRank rank(play, r);
        work(rank);
      } catch (...) {
        play.fail(std::current_exception());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  play.rethrow();
}

}  // namespace tetmend::test
