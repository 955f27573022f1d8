// SPDX-License-Identifier: MIT
#include "apps/plugin_watch.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/interruption.h"
#include "kernel/formats/temporary_names.h"
#include "ops/attempt_watch.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);
using Seconds = std::chrono::duration<double>;

constexpr auto kGrace = std::chrono::seconds(2);

/// A line that a signal handler may write: it neither allocates nor locks.
class PlainLine {
 public:
  void add(std::string_view text) {
    const std::size_t count = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), count, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
  }
  void add(std::uint32_t number) {
    std::array<char, 10> digits{};
    const char* end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    add({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  void write() const {
    static_cast<void>(platform::write_fully(platform::kStandardError, {text_.data(), size_}));
  }

 private:
  std::array<char, 5000> text_{};  // for a path as long as can be
  std::size_t size_ = 0;
};

extern "C" void on_crash(int) {
  if (const AttemptMark* mark = own_pending_attempt(); mark != nullptr) {
    PlainLine line;
    if (platform::is_terminal(platform::kStandardError))
      line.add("\n");  // below the line of the progress
    line.add("tetmend: crashed in operator '");
    line.add(mark->op().info().name);
    line.add("' of ");
    line.add(mark->op().origin());
    line.add(" at ");
    line.add(to_string(mark->target().kind));
    line.add(" ");
    line.add(mark->target().code);
    line.add("\n");
    line.write();
  }
  formats::remove_temporaries(formats::Remains::of_use);
}

}  // namespace

void note_crashes() {
  set_attempt_thread_hook(platform::provide_crash_stack);
  platform::on_crashes(on_crash);
}

PluginWatch::PluginWatch(const Limits& limits, Tell tell)
    : limits_(limits), tell_(std::move(tell)), thread_([this] { watch(); }) {}

PluginWatch::~PluginWatch() {
  {
    const std::lock_guard lock(busy_);
    is_over_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

/// A run that goes back improves a second time, and no longer than the first.
void PluginWatch::show(Stage stage) {
  if (limits_.time <= 0 || stage == stage_) return;
  stage_ = stage;
  deadline_ =
      stage == Stage::improving
          ? Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(limits_.time))
          : Clock::time_point::max();
}

void PluginWatch::watch() {
  std::unique_lock lock(busy_);
  while (!wake_.wait_for(lock, kInterval, [this] { return is_over_; })) {
    try {
      look(Clock::now());
    } catch (const std::bad_alloc&) {  // the run may come through; the next look is soon
    }
  }
}

void PluginWatch::look(Clock::time_point now) {
  const std::vector<PendingAttempt> pending = pending_attempts();
  std::erase_if(told_, [&](Clock::time_point since) {
    return std::none_of(pending.begin(), pending.end(),
                        [&](const PendingAttempt& attempt) { return attempt.since == since; });
  });
  if (Interruption::requested()) interrupted_ = std::min(interrupted_, now);
  const Clock::time_point deadline = deadline_;
  for (const PendingAttempt& attempt : pending) {
    const Clock::duration age = now - attempt.since;
    const auto is_late = [&](Clock::time_point end) {
      return end < now && now - std::max(end, attempt.since) > kGrace;
    };
    if (is_late(deadline)) end(attempt.what, ", and the time limit is over: no mesh was written");
    if (is_late(interrupted_)) end(attempt.what, ": interrupted, no mesh was written");
    if (limits_.longest > 0 && age > Seconds(limits_.longest)) {
      end(attempt.what, fmt::format(" for {:g} s: given up", limits_.longest));
    }
    if (limits_.attempt <= 0 || age < Seconds(limits_.attempt) ||
        std::find(told_.begin(), told_.end(), attempt.since) != told_.end()) {
      continue;
    }
    told_.push_back(attempt.since);
    tell_(fmt::format("{} has not come back for {:g} s", attempt.what, limits_.attempt));
  }
}

/// The thread that hangs cannot be ended alone, and nobody knows what state it leaves.
void PluginWatch::end(std::string_view what, std::string_view why) const {
  tell_(fmt::format("{} has not come back{}", what, why));
  formats::remove_temporaries(formats::Remains::of_use);
  std::_Exit(kFailed);
}

}  // namespace tetmend::apps
