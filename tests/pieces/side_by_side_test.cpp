// SPDX-License-Identifier: MIT
#include "pieces/side_by_side.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "kernel/error.h"

using namespace tetmend;
using namespace tetmend::pieces;

namespace {

/// In an arena of so many threads.
void each(std::size_t most, std::size_t count, int threads,
          const std::function<SideBySide::Use(std::size_t)>& make) {
  tbb::task_arena arena(threads);
  arena.execute([&] { SideBySide(most).each(count, make); });
}

}  // namespace

TEST_CASE("pieces side by side are each made once, and used by the caller alone") {
  for (const std::size_t most : {1U, 3U, 100U}) {
    CAPTURE(most);
    std::array<std::atomic<int>, 20> made{};
    std::array<int, 20> used{};
    std::thread::id user;
    bool is_one_thread = true;
    each(most, made.size(), 4, [&](std::size_t i) -> SideBySide::Use {
      ++made[i];
      return [&, i] {
        if (user == std::thread::id()) user = std::this_thread::get_id();
        is_one_thread = is_one_thread && user == std::this_thread::get_id();
        ++used[i];
      };
    });
    CHECK(is_one_thread);
    CHECK(std::all_of(made.begin(), made.end(), [](const auto& times) { return times == 1; }));
    CHECK(std::all_of(used.begin(), used.end(), [](int times) { return times == 1; }));
  }
}

TEST_CASE("as many pieces as may be are at work at a time, and share the threads") {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t at_work = 0;
  std::vector<int> threads;
  // Each waits for the other: one after another they would never end.
  each(2, 2, 5, [&](std::size_t) -> SideBySide::Use {
    std::unique_lock lock(mutex);
    threads.push_back(tbb::this_task_arena::max_concurrency());
    ++at_work;
    changed.notify_all();
    changed.wait(lock, [&] { return at_work == 2; });
    return [] {};
  });
  std::sort(threads.begin(), threads.end());
  CHECK(threads == std::vector<int>{2, 3});
}

TEST_CASE("one thread, or one piece at a time, leaves pieces in their order") {
  for (const auto& [most, threads] : {std::pair(std::size_t{1}, 4), std::pair(std::size_t{4}, 1)}) {
    std::vector<std::size_t> order;
    each(most, 5, threads, [&](std::size_t i) -> SideBySide::Use {
      order.push_back(i);
      CHECK(tbb::this_task_arena::max_concurrency() == threads);
      return [&order, i] { order.push_back(i); };
    });
    CHECK(order == std::vector<std::size_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4});
  }
}

TEST_CASE("of several pieces that fail the first one tells, and no other is begun") {
  std::atomic<std::size_t> last = 0;
  const auto fails = [&](std::size_t i) -> SideBySide::Use {
    if (i > last) last = i;
    if (i >= 10) throw Error("piece " + std::to_string(i));
    return [] {};
  };
  CHECK_THROWS_WITH(each(4, 1000, 4, fails), "piece 10");
  CHECK(last < 14);
  CHECK_THROWS_WITH(each(4, 1000, 4,
                         [](std::size_t) -> SideBySide::Use {
                           return [] { throw std::runtime_error("in use"); };
                         }),
                    "in use");
}

TEST_CASE("what is made does not pile up") {
  std::atomic<int> waiting = 0;
  std::atomic<int> most_waiting = 0;
  each(3, 200, 3, [&](std::size_t) -> SideBySide::Use {
    const int now = ++waiting;
    for (int seen = most_waiting; now > seen && !most_waiting.compare_exchange_weak(seen, now);) {
    }
    return [&] {
      std::this_thread::yield();
      --waiting;
    };
  });
  CHECK(waiting == 0);
  CHECK(most_waiting <= 2 * 3 + 1);  // waiting, being made, and the one that is used
}
