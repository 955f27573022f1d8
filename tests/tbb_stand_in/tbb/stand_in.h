// SPDX-License-Identifier: MIT
// What tetmend uses of oneTBB, on plain threads that the thread sanitizer understands. For that
// alone: every loop starts its threads anew, loops inside loops run on one, pipelines on one as well.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {

namespace stand_in {

inline constexpr std::size_t kThreads = 8;  ///< also on a machine with fewer cores
inline std::atomic<std::size_t> allowed{kThreads};
inline thread_local std::size_t concurrency = 0;  ///< of the arena; 0: as allowed
inline thread_local std::size_t slot = 0;         ///< of a thread in its loop

inline std::size_t threads() {
  return std::min(concurrency == 0 ? kThreads : concurrency, allowed.load());
}

/// Sets a variable, and puts it back.
template <class Value>
class Changed {
 public:
  Changed(Value& variable, Value value)
      : variable_(variable), old_(std::exchange(variable, value)) {}
  ~Changed() { variable_ = old_; }
  Changed(const Changed&) = delete;
  Changed& operator=(const Changed&) = delete;

 private:
  Value& variable_;
  Value old_;
};

}  // namespace stand_in

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t value) : old_(stand_in::allowed.exchange(value)) {}
  ~global_control() { stand_in::allowed = old_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  static std::size_t active_value(parameter) { return stand_in::allowed; }

 private:
  std::size_t old_;
};

class task_arena {
 public:
  explicit task_arena(int threads) : threads_(static_cast<std::size_t>(threads)) {}
  template <class Work>
  auto execute(const Work& work) {
    const stand_in::Changed<std::size_t> here(stand_in::concurrency, threads_);
    return work();
  }

 private:
  std::size_t threads_;
};

namespace this_task_arena {
inline int max_concurrency() {
  return static_cast<int>(stand_in::threads());
}
/// A thread of the stand-in takes no work of others while it waits.
template <class Body>
auto isolate(const Body& body) {
  return body();
}
}  // namespace this_task_arena

struct simple_partitioner {};

template <class Index, class Body>
void parallel_for(Index begin, Index end, const Body& body, simple_partitioner = {}) {
  if (begin >= end) return;
  std::atomic<Index> next{begin};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&](std::size_t slot) {
    const stand_in::Changed<std::size_t> mine(stand_in::slot, slot);
    const stand_in::Changed<std::size_t> alone(stand_in::concurrency, 1);
    try {
      for (Index i = next++; i < end; i = next++) body(i);
    } catch (...) {
      next = end;
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  const std::size_t count = std::min(stand_in::threads(), static_cast<std::size_t>(end - begin));
  for (std::size_t k = 1; k < count; ++k) others.emplace_back(work, k);
  work(count > 1 ? 0 : stand_in::slot);
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

template <class Iterator>
void parallel_sort(Iterator begin, Iterator end) {
  std::sort(begin, end);
}
template <class Iterator, class Compare>
void parallel_sort(Iterator begin, Iterator end, const Compare& compare) {
  std::sort(begin, end, compare);
}

/// One value for each thread of a loop.
template <class Value>
class enumerable_thread_specific {
 public:
  Value& local() {
    const std::lock_guard lock(mutex_);
    return values_[stand_in::slot];
  }
  class iterator {
   public:
    explicit iterator(typename std::map<std::size_t, Value>::iterator at) : at_(at) {}
    Value& operator*() const { return at_->second; }
    iterator& operator++() {
      ++at_;
      return *this;
    }
    friend bool operator==(const iterator&, const iterator&) = default;

   private:
    typename std::map<std::size_t, Value>::iterator at_;
  };
  iterator begin() { return iterator(values_.begin()); }
  iterator end() { return iterator(values_.end()); }

 private:
  std::mutex mutex_;
  std::map<std::size_t, Value> values_;
};

class flow_control {
 public:
  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }

 private:
  bool stopped_ = false;
};

enum class filter_mode { serial_in_order, parallel };

template <class In, class Out>
struct filter {
  std::function<Out(In)> run;
};
template <class Out>
struct filter<void, Out> {
  std::function<Out(flow_control&)> run;
};
template <>
struct filter<void, void> {
  std::function<void(flow_control&)> run;
};

template <class In, class Out, class Body>
filter<In, Out> make_filter(filter_mode, const Body& body) {
  return {body};
}

template <class Middle, class Out>
filter<void, Out> operator&(const filter<void, Middle>& first, const filter<Middle, Out>& second) {
  return {[first, second](flow_control& control) -> Out {
    Middle item = first.run(control);
    if constexpr (std::is_void_v<Out>) {
      if (!control.stopped()) second.run(std::move(item));
    } else {
      return control.stopped() ? Out() : second.run(std::move(item));
    }
  }};
}

inline void parallel_pipeline(std::size_t, const filter<void, void>& chain) {
  flow_control control;
  while (!control.stopped()) chain.run(control);
}

}  // namespace tbb
