// SPDX-License-Identifier: MIT
// A trace as the input of fuzz_trace_events: its frames, unpacked, two bytes of length before each.
//   unpack_trace TRACE >INPUT
#include <cstdio>

#include "kernel/error.h"
#include "tests/support/forged_trace.h"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  try {
    for (const auto& frame : tetmend::test::frames_of(arguments[1])) {
      const std::size_t size = frame.size() & 0xFFFFu;
      std::putchar(static_cast<int>(size & 0xFFu));
      std::putchar(static_cast<int>(size >> 8));
      std::fwrite(frame.data(), 1, size, stdout);
    }
  } catch (const tetmend::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
