// SPDX-License-Identifier: MIT
// A handler may neither allocate nor lock: hence fixed room and atomics.
#include "kernel/formats/temporary_names.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "platform/platform.h"

namespace tetmend::formats {
namespace {

constexpr std::size_t kLongest = 4096;  // no system takes a longer path

enum class State : unsigned char { free, filling, in_use };

struct Slot {
  std::atomic<State> state{State::free};
  std::atomic<bool> of_use{false};
  std::array<std::filesystem::path::value_type, kLongest> name;
};

// A signal handler can reach nothing but globals.
std::array<Slot, 32> slots;
std::atomic<int> delays{0};
std::atomic<int> awaited{0};  // the signal that is to end the program
static_assert(std::atomic<State>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void end_now(int number) noexcept {
  remove_temporaries();
  platform::end_by_default(number);
}

}  // namespace

void TemporaryName::remember(const std::filesystem::path& file, bool of_use) {
  const auto& name = file.native();
  if (name.size() >= kLongest) return;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    State expected = State::free;
    if (!slots[i].state.compare_exchange_strong(expected, State::filling)) continue;
    std::copy_n(name.c_str(), name.size() + 1, slots[i].name.data());
    slots[i].of_use = of_use;
    slots[i].state = State::in_use;
    slot_ = i;
    return;
  }
}

void TemporaryName::forget() {
  if (slot_ != kNone) slots[slot_].state = State::free;
  slot_ = kNone;
}

// Either the handler sees the delay, or the delay sees the signal.
EndDelay::EndDelay() {
  ++delays;
  if (const int number = awaited; number != 0 && delays == 1) end_now(number);
}

EndDelay::~EndDelay() {
  const bool is_last = --delays == 0;
  if (const int number = awaited; number != 0 && is_last) end_now(number);
}

void remove_temporaries(Remains remains) noexcept {
  for (Slot& slot : slots) {
    if (slot.state != State::in_use || (slot.of_use && remains == Remains::of_use)) continue;
    platform::remove_file(slot.name.data());
  }
}

void end_by_signal(int number) noexcept {
  awaited = number;
  if (delays == 0) end_now(number);
}

}  // namespace tetmend::formats
