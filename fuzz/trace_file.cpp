// SPDX-License-Identifier: MIT
// A trace of a stranger, byte for byte: an Error of one line, or a mesh after every event.
#include "fuzz/target.h"
#include "fuzz/trace_promise.h"

using namespace tetmend;
using namespace tetmend::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  const auto file = folder / "in.trace";
  write_file(file, {reinterpret_cast<const char*>(data), size});
  require_error_or_sound_trace(file);
  return 0;
}
