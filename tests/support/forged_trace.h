// SPDX-License-Identifier: MIT
// Traces that no recorder writes, with sound checksums around what they say.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trace/byte_stream.h"
#include "trace/trace_event.h"
#include "trace/trace_frame.h"

namespace tetmend::test {

using FrameContent = std::vector<std::byte>;

inline std::vector<FrameContent> frames_of(const std::filesystem::path& file) {
  std::vector<FrameContent> frames;
  FrameReader reader(file);
  while (reader.next()) reader.unpack(reader.offset(), frames.emplace_back());
  return frames;
}

inline void write_frames(const std::filesystem::path& file,
                         const std::vector<FrameContent>& frames) {
  FrameWriter writer(file);
  for (const FrameContent& frame : frames) writer.write(writer.pack(frame));
  writer.file().commit();
}

/// The events of one chunk, byte by byte.
class ForgedEvents {
 public:
  ForgedEvents& kind(EventKind kind) {
    out_.put(static_cast<std::uint64_t>(kind));
    ++count_;
    return *this;
  }
  ForgedEvents& put(std::uint64_t value) {
    out_.put(value);
    return *this;
  }
  /// Steps from one number to the next, the first from 0.
  ForgedEvents& steps(std::initializer_list<std::int64_t> steps) {
    for (const std::int64_t step : steps) out_.put_signed(step);
    return *this;
  }
  ForgedEvents& text(std::string_view text) {
    out_.put_text(text);
    return *this;
  }
  ForgedEvents& point(double x, double y, double z) {
    for (const double c : {x, y, z}) out_.put_raw(c);
    return *this;
  }
  /// An attempt of a new operator `x` without settings.
  ForgedEvents& attempt(std::initializer_list<std::int64_t> target, std::uint64_t level = 0) {
    kind(EventKind::attempt_begins).put(0).put(0).text("x").put(target.size()).steps(target);
    return put(level).put(1).text("");
  }

  std::uint64_t count() const { return count_; }
  /// A chunk that begins with event `first` and says that it has `count` events.
  FrameContent chunk(std::uint64_t first, std::uint64_t count) const {
    ByteWriter whole;
    whole.put_raw('E');
    whole.put(first);
    whole.put(count);
    whole.put_bytes(out_.bytes().data(), out_.size());
    return {whole.bytes().begin(), whole.bytes().end()};
  }
  FrameContent chunk() const { return chunk(0, count_); }

 private:
  ByteWriter out_;
  std::uint64_t count_ = 0;
};

inline FrameContent end_frame(std::uint64_t events, std::uint64_t kind = 0) {
  ByteWriter whole;
  whole.put_raw('Z');
  whole.put(events);
  whole.put(kind);
  return {whole.bytes().begin(), whole.bytes().end()};
}

}  // namespace tetmend::test
