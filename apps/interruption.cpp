// SPDX-License-Identifier: MIT
// What a signal from outside does: it ends the program without remains, or asks the work to stop.
#include "apps/interruption.h"

#include <cstdlib>
#include <exception>

#include "apps/commands.h"
#include "kernel/formats/temporary_names.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

// A signal handler can reach nothing but globals.
std::atomic<bool> stops_in_order{false};
std::atomic<bool> signalled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not take a lock");

extern "C" void on_signal(int number) {
  if (stops_in_order && !signalled.exchange(true)) return;
  if (stops_in_order && platform::comes_again(number)) return;
  formats::end_by_signal(number);
}

/// oneTBB, for one, throws where nothing can be caught when the system has no thread for it.
[[noreturn]] void on_terminate() {
  formats::remove_temporaries();
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
    complain(kFailed, "unexpected failure");
  } catch (const std::bad_alloc&) {
    complain(kFailed, "out of memory");
  } catch (const std::exception& error) {
    complain(kFailed, error.what());
  } catch (...) {
    complain(kFailed, "unexpected failure");
  }
  std::_Exit(kFailed);
}

}  // namespace

void end_without_remains() {
  std::set_terminate(on_terminate);
  platform::ignore_file_limits();
  platform::on_end_signals(platform::EndSignals::batch, on_signal);
}

Interruption::Interruption() {
  signalled = false;
  stops_in_order = true;
}

Interruption::~Interruption() {
  stops_in_order = false;
}

const std::atomic<bool>& Interruption::requested() {
  return signalled;
}

}  // namespace tetmend::apps
