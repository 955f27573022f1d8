// SPDX-License-Identifier: MIT
// A trace with sound checksums around what a stranger says. The input is the frames, unpacked: two
// bytes of length before each.
#include <algorithm>
#include <vector>

#include "fuzz/target.h"
#include "kernel/error.h"
#include "tests/support/forged_trace.h"
#include "tests/support/trace_use.h"

using namespace tetmend;
using namespace tetmend::fuzz;

namespace {

std::vector<test::FrameContent> frames_in(std::string_view input) {
  std::vector<test::FrameContent> frames;
  while (input.size() >= 2) {
    const auto low = static_cast<unsigned char>(input[0]);
    const auto high = static_cast<unsigned char>(input[1]);
    input.remove_prefix(2);
    const std::string_view frame = input.substr(0, low + 256u * high);
    const auto* bytes = reinterpret_cast<const std::byte*>(frame.data());
    frames.emplace_back(bytes, bytes + frame.size());
    input.remove_prefix(frame.size());
  }
  return frames;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  const auto file = folder / "in.trace";
  test::write_frames(file, frames_in({reinterpret_cast<const char*>(data), size}));
  try {
    const std::string findings = test::findings_in_trace(file);
    require(findings.empty(), findings);
    test::use_trace(file);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
