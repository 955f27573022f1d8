// SPDX-License-Identifier: MIT
// Pictures of many places of a trace: PNG files in a row, or a video.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/commands/commands.h"

namespace tetmend::viewer {

/// Which places: after `from` events, `every` later, and so on, none after `to`.
struct FrameRange {
  std::uint64_t from = 0, to = 0, every = 1;
  std::uint64_t count() const { return (to - from) / every + 1; }
};
/// What is not given: from the beginning to the end of the trace, in steps that make at most
/// kUsualFrames.
struct FrameRequest {
  std::optional<std::uint64_t> from, to, every;
};
inline constexpr std::uint64_t kUsualFrames = 600;
inline constexpr std::uint64_t kMostFrames = 100'000;
inline constexpr unsigned kFramesPerSecond = 25;

/// @throws Error when the trace has no such events, or when there would be more than kMostFrames.
FrameRange frame_range(const FrameRequest& request, std::uint64_t events);

/// The name of frame `number`: `pattern` with the number for its one %d or %04d.
/// @throws Error when there is none, another %, or another extension than .png
std::string frame_name(const std::string& pattern, std::uint64_t number);

/// Pictures of the document as it would be shown at each place. Numbers of files count from 0. The
/// place in the trace stays. Each file appears when it is complete.
/// Precondition: a trace is open. @throws Error as frame_name() and write_png()
void write_frames(Session& session, const FrameRange& range, const std::string& pattern);

/// The same as a video in H.264, by the program ffmpeg. The file appears when it is complete.
/// Precondition: a trace is open. @throws Error when the name does not end in .mp4 or .gif, or when ffmpeg
/// is not there or fails, with what it says.
void write_video(Session& session, const FrameRange& range, const std::filesystem::path& file,
                 unsigned frames_per_second = kFramesPerSecond);

}  // namespace tetmend::viewer
