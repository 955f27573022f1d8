// SPDX-License-Identifier: MIT
#include "explain/icicle.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetmend::explain {

CallWindow whole_trace(const TraceFile& file) {
  return {0, file.event_count(), 0, static_cast<std::uint32_t>(file.calls().size())};
}

CallWindow pass_around(const TraceFile& file, std::uint64_t position) {
  for (const TracedPass& pass : file.passes()) {
    if (pass.events.begin < position && position <= pass.events.end) {
      return {pass.events.begin, pass.events.end, pass.first_call, pass.last_call};
    }
  }
  return whole_trace(file);
}

CallWindow call_window(const TraceFile& file, std::uint32_t call) {
  const Call& c = file.calls()[call];
  return {c.events.begin, c.events.end, call, c.subtree_end};
}

CallWindow zoomed(const CallWindow& whole, const CallWindow& shown, double at, double factor) {
  constexpr double kFewest = 8;  // events
  const auto all = static_cast<double>(whole.end - whole.begin);
  const auto now = static_cast<double>(shown.end - shown.begin);
  const double events = std::clamp(now * factor, std::min(kFewest, all), all);
  const double fixed = static_cast<double>(shown.begin - whole.begin) + at * now;
  const double begin = std::clamp(fixed - at * events, 0.0, all - events);
  CallWindow made = whole;
  made.begin += static_cast<std::uint64_t>(std::llround(begin));
  made.end = std::min(whole.end, made.begin + static_cast<std::uint64_t>(std::llround(events)));
  return made;
}

CallWindow panned(const CallWindow& whole, const CallWindow& shown, std::int64_t events) {
  const std::uint64_t room = whole.end - whole.begin - (shown.end - shown.begin);
  const std::int64_t wanted = static_cast<std::int64_t>(shown.begin - whole.begin) + events;
  const std::int64_t begin = std::clamp<std::int64_t>(wanted, 0, static_cast<std::int64_t>(room));
  CallWindow made = whole;
  made.begin += static_cast<std::uint64_t>(begin);
  made.end = made.begin + (shown.end - shown.begin);
  return made;
}

std::vector<IcicleBar> lay_out_icicle(const TraceFile& file, const CallWindow& window,
                                      double thinnest) {
  std::vector<IcicleBar> bars;
  if (window.first_call >= window.last_call) return bars;
  std::vector<std::size_t> last_in_row;  // bars of joined calls grow
  const double events = static_cast<double>(std::max<std::uint64_t>(1, window.end - window.begin));
  const auto place = [&](std::uint64_t event) {
    return static_cast<double>(std::clamp(event, window.begin, window.end) - window.begin) / events;
  };
  const unsigned top = file.calls()[window.first_call].depth;
  for (std::uint32_t k = window.first_call; k < window.last_call;) {
    const Call& call = file.calls()[k];
    if (call.events.end <= window.begin) {
      k = call.subtree_end;
      continue;
    }
    if (call.events.begin >= window.end) break;
    IcicleBar bar{place(call.events.begin), place(call.events.end), call.depth - top, k, 1, {}};
    bar.ended[static_cast<std::size_t>(outcome_of(call))] = 1;
    if (bar.row >= last_in_row.size()) last_in_row.resize(bar.row + 1, bars.size());
    const bool is_thin = bar.right - bar.left < thinnest;
    IcicleBar* before = nullptr;
    if (const std::size_t i = last_in_row[bar.row]; i < bars.size() && bars[i].row == bar.row) {
      before = &bars[i];
    }
    // Joined while the bar that results is short, so that many make no long blur.
    constexpr double kLongest = 4;  // of the thinnest
    const bool joins = is_thin && before != nullptr && bar.left - before->right < thinnest &&
                       before->right - before->left < kLongest * thinnest &&
                       (before->count > 1 || before->right - before->left < thinnest);
    if (joins) {
      before->right = std::max(before->right, bar.right);
      ++before->count;
      ++before->ended[static_cast<std::size_t>(outcome_of(call))];
    } else {
      last_in_row[bar.row] = bars.size();
      bars.push_back(bar);
    }
    k = is_thin ? call.subtree_end : k + 1;
  }
  return bars;
}

double icicle_row_height(const std::vector<IcicleBar>& bars, double band) {
  unsigned deepest = 0;
  for (const IcicleBar& bar : bars) deepest = std::max(deepest, bar.row);
  return band / (deepest + 1.0);
}

namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// As few lines as can be, none wider than that; a word that is wider stands alone.
std::vector<std::string> in_lines(const std::string& text, double width,
                                  const std::function<double(const std::string&)>& width_of) {
  std::vector<std::string> lines;
  for (const std::string& word : words_of(text)) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && width_of(longer) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace

BarName name_in_bar(const std::string& operator_name, const std::string& target, double width,
                    double height, double text,
                    const std::function<double(const std::string&)>& width_of) {
  constexpr double kMargin = 0.2;  // of the text, on each side
  constexpr double kSmallest = 0.6;
  constexpr double kStep = 0.1;
  for (const bool has_operator : {true, false}) {
    for (double share = 1; share > kSmallest - kStep / 2; share -= kStep) {
      const double size = share * text;
      const double room = (width - 2 * kMargin * size) / share;  // in texts of the usual size
      std::vector<std::string> lines;
      if (has_operator) lines = in_lines(operator_name, room, width_of);
      for (std::string& line : in_lines(target, room, width_of)) lines.push_back(std::move(line));
      // In one line, if that has room.
      const std::string whole = (has_operator ? operator_name + " " : "") + target;
      if (width_of(whole) <= room) lines = {whole};
      const bool is_narrow = std::all_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return width_of(line) <= room;
      });
      if (is_narrow && static_cast<double>(lines.size()) * size <= height) return {lines, size};
    }
  }
  return {};
}

const IcicleBar* bar_at(const std::vector<IcicleBar>& bars, double x, unsigned row) {
  const auto found = std::find_if(bars.begin(), bars.end(), [&](const IcicleBar& bar) {
    return bar.row == row && bar.left <= x && x <= bar.right;
  });
  return found == bars.end() ? nullptr : &*found;
}

}  // namespace tetmend::explain
