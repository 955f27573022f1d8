// SPDX-License-Identifier: MIT
// Ctrl-C: the first asks the work to stop, the second ends the program at once.
#include "apps/interruption.h"

namespace tetmend::apps {
namespace {

// A signal handler can reach nothing but a global.
std::atomic<bool> signalled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not take a lock");

extern "C" void on_signal(int number) {
  if (!signalled.exchange(true)) return;
  ::signal(number, SIG_DFL);
  ::raise(number);  // takes effect when the handler returns
}

void install(int number, struct sigaction& old) {
  ::sigaction(number, nullptr, &old);
  if (old.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  ::sigaction(number, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  signalled = false;
  install(SIGINT, old_interrupt_);
  install(SIGTERM, old_terminate_);
}

Interruption::~Interruption() {
  ::sigaction(SIGINT, &old_interrupt_, nullptr);
  ::sigaction(SIGTERM, &old_terminate_, nullptr);
}

const std::atomic<bool>& Interruption::requested() {
  return signalled;
}

}  // namespace tetmend::apps
