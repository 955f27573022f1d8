// SPDX-License-Identifier: MIT
// Progress of a run as one line of a terminal that is written over and over.
#include "apps/progress_line.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "apps/standard_streams.h"
#include "kernel/printable.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

/// Asked for each time: the user may resize the window. One column stays free, else some terminals
/// would begin a new line.
std::size_t terminal_width() {
  const std::size_t columns = platform::terminal_columns();
  return columns < 2 ? 79 : columns - 1;
}

}  // namespace

ProgressLine::ProgressLine(bool wanted)
    : active_(wanted && platform::is_terminal(platform::kStandardError)) {}

void ProgressLine::show(std::string_view phase) {
  if (active_) draw(std::string(phase));
}

void ProgressLine::show(const Progress& progress) {
  constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
  if (!active_) return;
  if (progress.stage == Stage::building) return show("building the mesh");
  if (progress.stage == Stage::measuring) return show("measuring");
  const Clock::time_point now = Clock::now();
  if (progress.phase.empty() || now - last_drawn_ < kRedrawInterval) return;
  last_drawn_ = now;
  draw(fmt::format("round {:2}  {:<22} {:3.0f} %  bad {:>7}  worst {:7.4f}  {:.1f} s{}",
                   progress.round, printable(progress.phase, 19), 100 * progress.share,
                   progress.now.n_bad, progress.now.q_worst,
                   std::chrono::duration<double>(now - start_).count(), rest_of(progress, now)));
}

std::string ProgressLine::rest_of(const Progress& progress, Clock::time_point now) {
  constexpr double kLong = 5;           // seconds
  constexpr double kLeastShare = 0.05;  // what is less tells little
  if (progress.phase != phase_ || progress.share < share_) {
    phase_ = progress.phase;
    phase_start_ = now;
  }
  share_ = progress.share;
  const double spent = std::chrono::duration<double>(now - phase_start_).count();
  if (spent < kLong || share_ < kLeastShare) return {};
  return fmt::format(", pass: {:.0f} s left", spent * (1 - share_) / share_);
}

void ProgressLine::note(std::string_view text) {
  if (!active_) return;
  clear();
  say(stderr, text);
  say(stderr, "\n");
}

void ProgressLine::clear() {
  if (drawn_width_ == 0) return;
  draw("");
  std::fputc('\r', stderr);
  std::fflush(stderr);
}

void ProgressLine::draw(std::string line) {
  constexpr std::size_t kDots = 3;
  const std::size_t width = terminal_width();
  line = printable(line);
  if (line.size() > width) line = printable(line, std::max(width, kDots) - kDots);
  const std::size_t length = line.size();
  // Blanks over the rest of the longer line before: every terminal understands them.
  line.resize(std::max(length, std::min(drawn_width_, width)), ' ');
  std::fputc('\r', stderr);
  say(stderr, line);
  std::fflush(stderr);
  drawn_width_ = length;
}

}  // namespace tetmend::apps
