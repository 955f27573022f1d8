// SPDX-License-Identifier: MIT
// A trace of a stranger, byte for byte: an Error of one line, or a mesh after every event.
#include "fuzz/target.h"
#include "kernel/error.h"
#include "tests/support/trace_use.h"

using namespace tetmend;
using namespace tetmend::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  const auto file = folder / "in.trace";
  write_file(file, {reinterpret_cast<const char*>(data), size});
  try {
    const std::string findings = test::findings_in_trace(file);
    require(findings.empty(), findings);
    test::use_trace(file);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
