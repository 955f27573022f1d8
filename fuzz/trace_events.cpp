// SPDX-License-Identifier: MIT
// A trace with sound checksums around what a stranger says. The input is the frames, unpacked: two
// bytes of length before each.
#include <algorithm>
#include <vector>

#include "fuzz/target.h"
#include "fuzz/trace_promise.h"
#include "tests/support/forged_trace.h"

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
  require_error_or_sound_trace(file);
  return 0;
}
