// SPDX-License-Identifier: MIT
#include "report/progress_chart.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "explain/page_text.h"
#include "kernel/grouped.h"
#include "report/svg.h"

namespace tetmend::report {

namespace {

using explain::escaped;

constexpr double kProgressWidth = 560;
constexpr double kProgressHeight = 300;
constexpr Frame kProgressPlot = {.left = 52, .top = 26, .right = 508, .bottom = 262};

struct PassPoint {
  std::string name;
  std::size_t round = 0;
  double begin = 0, end = 0;  ///< seconds of improving
  std::size_t attempts = 0, accepted = 0;
  std::size_t bad_before = 0, bad_after = 0;
  double worst = 0;  ///< quality, 1: the goal is just met
};

/// Bad tets that passes may work on: protected ones do not count in their figures.
std::size_t bad_at_first(const Figures& figures) {
  const std::size_t all = figures.count("before.n_bad");
  const std::size_t kept = figures.count("protected.bad_tets") + figures.count("layers.bad_tets");
  return all - std::min(all, kept);
}

std::vector<PassPoint> read_passes(const Figures& figures) {
  std::vector<PassPoint> passes;
  double time = 0;
  std::size_t bad = bad_at_first(figures);
  for (const nlohmann::json& entry : figures.at("passes")) {
    const Figures of(entry);
    PassPoint pass{.name = of.text("name"), .round = of.count("round"), .begin = time};
    pass.end = time += of.number("seconds");
    pass.attempts = of.count("attempts");
    pass.accepted = of.count("accepted");
    pass.bad_before = bad;
    pass.bad_after = bad = of.count("n_bad");
    pass.worst = std::isnan(of.number("q_worst")) ? 0 : of.number("q_worst");
    passes.push_back(std::move(pass));
  }
  return passes;
}

class ProgressChart {
 public:
  explicit ProgressChart(std::vector<PassPoint> passes) : passes_(std::move(passes)) {
    time_ = std::max(passes_.back().end, 1e-9);
    for (const PassPoint& pass : passes_) {
      most_bad_ = std::max({most_bad_, pass.bad_before, pass.bad_after});
      best_ = std::max(best_, pass.worst);
    }
  }

  std::string draw() const {
    return drawing(kProgressWidth, kProgressHeight, "progress",
                   "Bad tets and worst quality over time",
                   rounds() + axes() + bad_line() + worst_line() + columns());
  }

 private:
  double x(double seconds) const { return kProgressPlot.x(seconds / time_); }
  double y_bad(std::size_t count) const {
    return kProgressPlot.y(log_share(static_cast<double>(count),
                                     static_cast<double>(std::max<std::size_t>(most_bad_, 1))));
  }
  double y_worst(double quality) const { return kProgressPlot.y(std::max(quality, 0.0) / best_); }

  /// Every second round lies on a stripe.
  std::string rounds() const {
    std::string text;
    for (std::size_t i = 0; i < passes_.size();) {
      std::size_t end = i;
      while (end < passes_.size() && passes_[end].round == passes_[i].round) ++end;
      const double left = x(passes_[i].begin);
      const double width = x(passes_[end - 1].end) - left;
      if (passes_[i].round % 2 == 1) {
        text += fmt::format(R"(<rect class="stripe" x="{}" y="{}" width="{}" height="{}"/>)",
                            coordinate(left), coordinate(kProgressPlot.top), coordinate(width),
                            coordinate(kProgressPlot.height()));
      }
      if (width > 50 && passes_[i].round > 0) {
        text += text_at(left + width / 2, kProgressPlot.bottom - 6, "middle", "tick",
                        fmt::format("round {}", passes_[i].round));
      }
      i = end;
    }
    return text;
  }

  std::string axes() const {
    std::string text = line_between(kProgressPlot.left, kProgressPlot.bottom, kProgressPlot.right,
                                    kProgressPlot.bottom, "axis");
    for (const double tick : round_ticks(time_, 5)) {
      text +=
          line_between(x(tick), kProgressPlot.bottom, x(tick), kProgressPlot.bottom + 4, "axis");
      text += text_at(x(tick), kProgressPlot.bottom + 17, "middle", "tick", short_number(tick));
    }
    text +=
        text_at(kProgressPlot.right, kProgressHeight - 4, "end", "tick", "seconds of improving");
    std::vector<double> counts =
        decade_ticks(static_cast<double>(std::max<std::size_t>(most_bad_, 1)), 4);
    counts.insert(counts.begin(), 0);
    for (const double tick : counts) {
      const double at = y_bad(static_cast<std::size_t>(tick));
      text += line_between(kProgressPlot.left, at, kProgressPlot.right, at, "grid");
      text += text_at(kProgressPlot.left - 5, at + 4, "end", "tick bad-ink", tick_text(tick));
    }
    for (const double tick : round_ticks(best_, 4)) {
      text += text_at(kProgressPlot.right + 5, y_worst(tick) + 4, "start", "tick worst-ink",
                      short_number(tick));
    }
    text += text_at(4, 14, "start", "bad-ink", "bad tets (logarithmic)");
    return text +
           text_at(kProgressWidth - 4, 14, "end", "worst-ink", "worst quality (1: the goal)");
  }

  std::string bad_line() const {
    std::string path = fmt::format("M{} {}", coordinate(kProgressPlot.left),
                                   coordinate(y_bad(passes_.front().bad_before)));
    for (const PassPoint& pass : passes_) {
      path += fmt::format("L{} {}", coordinate(x(pass.end)), coordinate(y_bad(pass.bad_after)));
    }
    return fmt::format(R"(<path class="bad-line" d="{}"/>)", path);
  }

  std::string worst_line() const {
    std::string path;
    for (const PassPoint& pass : passes_) {
      path += fmt::format("{}{} {}", path.empty() ? 'M' : 'L', coordinate(x(pass.end)),
                          coordinate(y_worst(pass.worst)));
    }
    return fmt::format(R"(<path class="worst-line" d="{}"/>)", path);
  }

  std::string columns() const {
    constexpr double kNarrowest = 1.5;  // that a mouse finds
    std::string text;
    for (const PassPoint& pass : passes_) {
      const std::string round = pass.round > 0 ? fmt::format(", round {}", pass.round) : "";
      text += fmt::format(
          R"(<rect class="bin" x="{}" y="{}" width="{}" height="{}"><title>{}{}: {} s; )"
          "{} tried, {} kept; bad tets {} to {}; worst quality {}</title></rect>",
          coordinate(x(pass.begin)), coordinate(kProgressPlot.top),
          coordinate(std::max(x(pass.end) - x(pass.begin), kNarrowest)),
          coordinate(kProgressPlot.height()), escaped(pass.name), round,
          short_number(pass.end - pass.begin), grouped(pass.attempts), grouped(pass.accepted),
          grouped(pass.bad_before), grouped(pass.bad_after), short_number(pass.worst));
    }
    return text;
  }

  std::vector<PassPoint> passes_;
  double time_ = 0;
  std::size_t most_bad_ = 0;
  double best_ = 1;
};

/// All passes of one name.
struct PassTotal {
  std::string name;
  std::size_t calls = 0, attempts = 0, accepted = 0;
  double gone = 0;  ///< bad tets; negative: more than before
  double seconds = 0;
};

std::vector<PassTotal> total_by_name(const std::vector<PassPoint>& passes) {
  std::vector<PassTotal> totals;
  for (const PassPoint& pass : passes) {
    auto total = std::find_if(totals.begin(), totals.end(),
                              [&](const PassTotal& t) { return t.name == pass.name; });
    if (total == totals.end()) total = totals.insert(total, PassTotal{.name = pass.name});
    ++total->calls;
    total->attempts += pass.attempts;
    total->accepted += pass.accepted;
    total->gone += static_cast<double>(pass.bad_before) - static_cast<double>(pass.bad_after);
    total->seconds += pass.end - pass.begin;
  }
  return totals;
}

/// A name that may go on in the next line after each underscore.
std::string breakable(const std::string& name) {
  std::string html;
  for (const char c : escaped(name)) html += c == '_' ? std::string("_<wbr>") : std::string(1, c);
  return html;
}

/// The name of a pass. A long one, of many operators, can be unfolded.
std::string folded(const std::string& name) {
  constexpr std::ptrdiff_t kMost = 4;
  const auto open = name.find('(');
  const std::ptrdiff_t count = std::count(name.begin(), name.end(), ',') + 1;
  if (open == std::string::npos || count <= kMost) return breakable(name);
  const std::string first = name.substr(open + 1, name.find(',') - open - 1);
  return fmt::format("<details><summary>{} of {} operators, {} first</summary>{}</details>",
                     breakable(name.substr(0, open)), count, breakable(first), breakable(name));
}

std::string bar(std::string_view classes, double share) {
  return fmt::format(
      R"(<svg class="bar" viewBox="0 0 100 6" preserveAspectRatio="none" aria-hidden="true">)"
      R"(<rect class="{}" width="{}" height="6"/></svg>)",
      classes, coordinate(100 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

std::string progress_chart(const Figures& figures) {
  std::vector<PassPoint> passes = read_passes(figures);
  return passes.empty() ? std::string() : ProgressChart(std::move(passes)).draw();
}

std::string pass_table(const Figures& figures) {
  const std::vector<PassTotal> totals = total_by_name(read_passes(figures));
  if (totals.empty()) return "<p>The schedule made no pass.</p>\n";
  double time = 1e-9;
  for (const PassTotal& total : totals) time += total.seconds;
  std::string rows;
  for (const PassTotal& total : totals) {
    const double kept = total.attempts == 0 ? 0
                                            : static_cast<double>(total.accepted) /
                                                  static_cast<double>(total.attempts);
    rows +=
        fmt::format(R"(<tr data-pass="{0}"><th scope="row">{9}</th><td data-sum="calls">{1}</td>)"
                    R"(<td data-sum="attempts">{2}</td><td data-sum="accepted">{3}{4}</td>)"
                    R"(<td data-sum="gone">{5}{6}</td><td data-sum="seconds">{7}{8}</td></tr>)"
                    "\n",
                    escaped(total.name), total.calls, grouped(total.attempts),
                    grouped(total.accepted), bar("kept", kept), total.gone < 0 ? "\u2212" : "",
                    grouped(static_cast<std::size_t>(std::abs(total.gone))),
                    fmt::format("{:.3f}", total.seconds), bar("cost", total.seconds / time),
                    folded(total.name));
  }
  return fmt::format(
      "<table class=\"passes\"><thead><tr><th>pass</th><th>calls</th><th>tried</th><th>kept</th>"
      "<th>bad tets gone</th><th>seconds</th></tr></thead><tbody>\n{}</tbody></table>\n",
      rows);
}

}  // namespace tetmend::report
