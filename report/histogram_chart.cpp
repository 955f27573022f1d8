// SPDX-License-Identifier: MIT
//   grey area: before | coloured line: after | a column over each bin takes the mouse
#include "report/histogram_chart.h"

#include <algorithm>

#include <fmt/format.h>

#include "explain/page_text.h"
#include "kernel/grouped.h"
#include "report/figures.h"
#include "report/svg.h"

namespace tetmend::report {

namespace {

constexpr double kHistogramWidth = 360;
constexpr double kHistogramHeight = 190;
constexpr Frame kHistogramPlot = {.left = 40, .top = 10, .right = 352, .bottom = 160};
using Counts = std::vector<std::size_t>;

/// The bins that are shown: [begin, end).
struct Shown {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

Shown find_shown(const HistogramContent& content) {
  constexpr std::size_t kFewest = 8;
  const std::size_t all = content.before.size();
  const auto is_empty = [&](std::size_t i) { return content.before[i] + content.after[i] == 0; };
  Shown shown{0, all};
  while (shown.end > 0 && is_empty(shown.end - 1)) --shown.end;
  while (shown.begin < shown.end && is_empty(shown.begin)) ++shown.begin;
  if (shown.begin > 0) --shown.begin;
  shown.end = std::min(all, std::max(shown.end + 1, shown.begin + kFewest));
  shown.begin = shown.end >= kFewest ? std::min(shown.begin, shown.end - kFewest) : 0;
  return shown;
}

class HistogramChart {
 public:
  explicit HistogramChart(const HistogramContent& content)
      : content_(content), shown_(find_shown(content)) {
    for (std::size_t i = shown_.begin; i < shown_.end; ++i) {
      most_ = std::max({most_, content.before[i], content.after[i]});
    }
  }

  std::string draw() const {
    std::string text = bad_zones();
    text +=
        fmt::format(R"(<g class="scale-log">{}{}{}</g>)", y_axis(true),
                    steps(content_.before, "before", true), steps(content_.after, "after", true));
    text +=
        fmt::format(R"(<g class="scale-even">{}{}{}</g>)", y_axis(false),
                    steps(content_.before, "before", false), steps(content_.after, "after", false));
    text += x_axis();
    for (std::size_t i = shown_.begin; i < shown_.end; ++i) text += column(i);
    return drawing(kHistogramWidth, kHistogramHeight, "histogram",
                   fmt::format("{}: {} before and after", content_.title, content_.unit), text);
  }

 private:
  double x(std::size_t edge) const {
    return kHistogramPlot.x(static_cast<double>(edge - shown_.begin) /
                            static_cast<double>(shown_.size()));
  }
  double y(double count, bool is_log) const {
    const auto most = static_cast<double>(std::max<std::size_t>(most_, 1));
    return kHistogramPlot.y(is_log ? log_share(count, most) : count / most);
  }

  std::string steps(const Counts& counts, std::string_view classes, bool is_log) const {
    std::string path =
        fmt::format("M{} {}", coordinate(x(shown_.begin)), coordinate(kHistogramPlot.bottom));
    for (std::size_t i = shown_.begin; i < shown_.end; ++i) {
      path += fmt::format("V{}H{}", coordinate(y(static_cast<double>(counts[i]), is_log)),
                          coordinate(x(i + 1)));
    }
    return fmt::format(R"(<path class="{}" d="{}V{}Z"/>)", classes, path,
                       coordinate(kHistogramPlot.bottom));
  }

  std::string y_axis(bool is_log) const {
    const auto most = static_cast<double>(std::max<std::size_t>(most_, 1));
    std::string text;
    for (const double tick : is_log ? decade_ticks(most, 4) : round_ticks(most, 4)) {
      const double at = y(tick, is_log);
      text += line_between(kHistogramPlot.left, at, kHistogramPlot.right, at, "grid");
      text += text_at(kHistogramPlot.left - 4, at + 4, "end", "tick", tick_text(tick));
    }
    return text;
  }

  /// So many bins from tick to tick that their texts stay apart.
  std::size_t tick_step() const {
    constexpr double kCharacter = 7;
    std::size_t longest = 0;
    for (std::size_t i = shown_.begin; i <= shown_.end; ++i) {
      longest = std::max(longest, short_number(content_.edges[i]).size());
    }
    const double room = kHistogramPlot.width() / (kCharacter * static_cast<double>(longest + 1));
    std::size_t step = 1;
    while (static_cast<double>(shown_.size()) / static_cast<double>(step) > std::min(room, 8.0)) {
      step *= 2;
    }
    return step;
  }

  std::string x_axis() const {
    std::string text = line_between(kHistogramPlot.left, kHistogramPlot.bottom,
                                    kHistogramPlot.right, kHistogramPlot.bottom, "axis");
    const std::size_t step = tick_step();
    for (std::size_t i = shown_.begin; i <= shown_.end; ++i) {
      if (i % step != 0) continue;
      text += line_between(x(i), kHistogramPlot.bottom, x(i), kHistogramPlot.bottom + 4, "axis");
      text += text_at(x(i), kHistogramPlot.bottom + 15, "middle", "tick",
                      short_number(content_.edges[i]));
    }
    using Better = HistogramContent::Better;
    if (content_.better == Better::right) {
      text += text_at(kHistogramPlot.right, kHistogramHeight - 2, "end", "better", "better \u2192");
    } else if (content_.better == Better::left) {
      text +=
          text_at(kHistogramPlot.left, kHistogramHeight - 2, "start", "better", "\u2190 better");
    }
    return text;
  }

  std::string zone(double from, double to) const {
    return fmt::format(R"(<rect class="miss" x="{}" y="{}" width="{}" height="{}"/>)",
                       coordinate(from), coordinate(kHistogramPlot.top), coordinate(to - from),
                       coordinate(kHistogramPlot.height()));
  }

  /// Precondition: bins of one width.
  std::string bad_zones() const {
    if (content_.bad_below == content_.bad_above) return {};
    const double low = content_.edges[shown_.begin];
    const double high = content_.edges[shown_.end];
    const auto place = [&](double value) { return kHistogramPlot.x((value - low) / (high - low)); };
    std::string text;
    if (content_.bad_below > low) text += zone(kHistogramPlot.left, place(content_.bad_below));
    if (content_.bad_above < high) text += zone(place(content_.bad_above), kHistogramPlot.right);
    return text;
  }

  std::string range(std::size_t i) const {
    const std::string from = short_number(content_.edges[i]);
    const std::string to = short_number(content_.edges[i + 1]);
    if (content_.is_open && i == 0) return "below " + to;
    if (content_.is_open && i + 1 == content_.before.size()) return from + " or more";
    return fmt::format("{} to {}", from, to);
  }

  std::string column(std::size_t i) const {
    return fmt::format(
        R"(<rect class="bin" data-bin="{}" x="{}" y="{}" width="{}" height="{}"><title>{}: )"
        "{} {} before, {} after</title></rect>",
        i, coordinate(x(i)), coordinate(kHistogramPlot.top), coordinate(x(i + 1) - x(i)),
        coordinate(kHistogramPlot.height()), range(i), grouped(content_.before[i]), content_.unit,
        grouped(content_.after[i]));
  }

  const HistogramContent& content_;
  Shown shown_;
  std::size_t most_ = 0;
};

}  // namespace

std::string histogram_chart(const HistogramContent& content) {
  return fmt::format(
      R"(<figure class="chart" data-histogram="{}"><figcaption><b>{}</b><span>{}</span></figcaption>{}</figure>)"
      "\n",
      explain::escaped(content.name), explain::escaped(content.title),
      explain::escaped(content.help), HistogramChart(content).draw());
}

}  // namespace tetmend::report
