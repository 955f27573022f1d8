// SPDX-License-Identifier: MIT
#include "viewer/commands/frames.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <functional>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/pending_file.h"
#include "platform/child.h"

namespace tetmend::viewer {

namespace {

/// Takes the document from place to place, and back where it was.
class Tour {
 public:
  explicit Tour(Document& document)
      : document_(document),
        home_(document.debugger()->position()),
        camera_(document.view.camera) {}
  ~Tour() {
    try {
      go(home_);
      document_.view.camera = camera_;
    } catch (const std::exception& error) {  // out of memory
      document_.message = {error.what(), true};
    }
  }
  Tour(const Tour&) = delete;
  Tour& operator=(const Tour&) = delete;

  void go(std::uint64_t position) {
    if (position == document_.debugger()->position()) return;
    document_.debugger()->seek(position);
    document_.show_trace();
  }

 private:
  Document& document_;
  std::uint64_t home_;
  Camera camera_;
};

void for_each_frame(Session& session, const FrameRange& range,
                    const std::function<void(std::uint64_t number, const Image& image)>& take) {
  Tour tour(session.document);
  session.document.debugger()->playing = false;
  for (std::uint64_t i = 0; i < range.count(); ++i) {
    tour.go(range.from + i * range.every);
    take(i, session.host.render(session.document));
  }
}

std::vector<std::string> ffmpeg_command(const Image& first, unsigned frames_per_second,
                                        bool is_animation, const std::filesystem::path& file) {
  std::vector<std::string> command = {"ffmpeg",
                                      "-hide_banner",
                                      "-loglevel",
                                      "error",
                                      "-y",
                                      "-f",
                                      "rawvideo",
                                      "-pix_fmt",
                                      "rgba",
                                      "-video_size",
                                      fmt::format("{}x{}", first.width, first.height),
                                      "-framerate",
                                      fmt::format("{}", frames_per_second),
                                      "-i",
                                      "pipe:0",
                                      "-an"};
  const std::vector<std::string> film = {"-c:v",
                                         "libx264",
                                         "-pix_fmt",
                                         "yuv420p",
                                         "-crf",
                                         "18",
                                         "-vf",  // players want even sizes
                                         "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                         "-movflags",
                                         "+faststart",
                                         "-f",
                                         "mp4"};
  const std::vector<std::string> animation = {
      "-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", "-f", "gif"};
  const auto& how = is_animation ? animation : film;
  command.insert(command.end(), how.begin(), how.end());
  command.push_back("file:" + file.string());
  return command;
}

[[noreturn]] void fail_start(const std::filesystem::path& file, int error) {
  throw Error(fmt::format("{}: a video needs the program ffmpeg, which cannot be started: {}",
                          file.string(), std::generic_category().message(error)));
}

/// The first line of what it says.
[[noreturn]] void fail_encoding(const std::filesystem::path& file, const platform::Child& child) {
  const std::string said = child.complaint();
  std::string line = said.substr(0, said.find('\n'));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  throw Error(fmt::format("{}: ffmpeg failed: {}", file.string(),
                          line.empty() ? "it gives no reason" : line));
}

}  // namespace

FrameRange frame_range(const FrameRequest& request, std::uint64_t events) {
  FrameRange range{request.from.value_or(0), request.to.value_or(events), 1};
  if (range.from > range.to) {
    throw Error(
        fmt::format("frames from {} to {}: the first is after the last", range.from, range.to));
  }
  if (range.to > events) {
    throw Error(fmt::format("frames to {}: the trace has {} events", range.to, events));
  }
  range.every = request.every.value_or((range.to - range.from) / kUsualFrames + 1);
  if (range.every == 0) throw Error("frames: every 0 events is no step: from 1 on");
  if (range.count() > kMostFrames) {
    throw Error(fmt::format("{} frames are too many, the most are {}: choose a larger step",
                            range.count(), kMostFrames));
  }
  return range;
}

std::string frame_name(const std::string& pattern, std::uint64_t number) {
  const auto fail = [&] {
    throw Error(
        fmt::format("{}: the name of frames is like f-%04d.png: one %d or %04d for the "
                    "number, and .png",
                    pattern));
  };
  const std::size_t at = pattern.find('%');
  if (at == std::string::npos || !pattern.ends_with(".png")) fail();
  std::size_t digits = 0;
  std::size_t end = at + 1;
  if (end < pattern.size() && pattern[end] == '0') {
    ++end;
    if (end < pattern.size() && pattern[end] >= '1' && pattern[end] <= '9') {
      digits = static_cast<std::size_t>(pattern[end++] - '0');
    }
    if (digits == 0) fail();
  }
  if (end >= pattern.size() || pattern[end] != 'd') fail();
  if (pattern.find('%', end) != std::string::npos) fail();
  return fmt::format("{}{:0{}}{}", pattern.substr(0, at), number, digits, pattern.substr(end + 1));
}

void write_frames(Session& session, const FrameRange& range, const std::string& pattern) {
  frame_name(pattern, 0);  // what is wrong is said before any work
  for_each_frame(session, range, [&](std::uint64_t number, const Image& image) {
    write_png(frame_name(pattern, number), image);
  });
}

void write_video(Session& session, const FrameRange& range, const std::filesystem::path& file,
                 unsigned frames_per_second) {
  const bool is_animation = file.extension() == ".gif";
  if (!is_animation && file.extension() != ".mp4") {
    throw Error(fmt::format("{}: videos are written as .mp4 or .gif", file.string()));
  }
  formats::PendingFile out(file);
  std::unique_ptr<platform::Child> ffmpeg;
  for_each_frame(session, range, [&](std::uint64_t, const Image& image) {
    if (ffmpeg == nullptr) {
      ffmpeg = std::make_unique<platform::Child>(
          ffmpeg_command(image, frames_per_second, is_animation, out.temporary()));
      if (ffmpeg->error() != 0) fail_start(file, ffmpeg->error());
    }
    const std::string_view bytes(reinterpret_cast<const char*>(image.pixels.data()),
                                 image.pixels.size() * sizeof(Colour));
    if (ffmpeg->write(bytes) == 0) return;
    ffmpeg->wait();
    fail_encoding(file, *ffmpeg);
  });
  if (ffmpeg->wait() != 0) fail_encoding(file, *ffmpeg);
  out.commit();
}

}  // namespace tetmend::viewer
