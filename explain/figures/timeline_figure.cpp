// SPDX-License-Identifier: MIT
// Number of bad tets and worst quality over the events of a trace; below, calls as icicles.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/figures/figure_parts.h"
#include "explain/figures/figures.h"
#include "explain/icicle.h"
#include "explain/outcome_look.h"

namespace tetmend::explain {

using figure::Anchor;
using figure::Colour;
using figure::Drawing;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kPlotWidth = 400;
constexpr double kPlotHeight = 120;
constexpr double kBarHeight = 11;
constexpr double kMarkRoom = 10.6;  // at the left end of a bar
constexpr double kAxisRoom = 40;
constexpr Pen kFrame{figure::kBlack, 0.5};
constexpr Pen kBadPen{figure::kBadColour, 1.2};
constexpr Pen kWorstPen{figure::kWorstColour, 1.2};

/// A rectangle of the page with events from left to right, and numbers upwards.
struct Plot {
  Place corner;
  double width = 0, height = 0;
  double begin = 0, end = 1;
  double highest = 1;

  double x(double event) const {
    return corner.x + width * (event - begin) / std::max(end - begin, 1.0);
  }
  double x(std::uint64_t event) const { return x(static_cast<double>(event)); }
  double y(double value) const { return corner.y + height * (1 - value / highest); }
  double bottom() const { return corner.y + height; }
};

void add_frame(Drawing& drawing, const Plot& plot) {
  const double right = plot.corner.x + plot.width;
  drawing.add(figure::Stroke{{plot.corner,
                              {plot.corner.x, plot.bottom()},
                              {right, plot.bottom()},
                              {right, plot.corner.y},
                              plot.corner},
                             kFrame});
}

/// Gives the y below it.
double add_event_axis(Drawing& drawing, const Plot& plot) {
  constexpr unsigned kTicks = 8;
  for (const double event : figure::ticks(plot.begin, std::max(plot.end, plot.begin + 1), kTicks)) {
    const double x = plot.x(event);
    drawing.line({x, plot.bottom()}, {x, plot.bottom() + 3}, kFrame);
    drawing.add(figure::centred({x, plot.bottom() + 8}, figure::tick_text(event), kNumberSize));
  }
  const double y = plot.bottom() + 18;
  drawing.add(figure::centred({plot.corner.x + plot.width / 2, y}, "event", kTextSize));
  return y + 7;
}

void add_value_axis(Drawing& drawing, const Plot& plot, bool is_right, const Colour& colour,
                    const std::string& name) {
  constexpr unsigned kTicks = 5;
  const double x = plot.corner.x + (is_right ? plot.width : 0);
  const double out = is_right ? 3 : -3;
  for (const double value : figure::ticks(0, plot.highest, kTicks)) {
    drawing.line({x, plot.y(value)}, {x + out, plot.y(value)}, kFrame);
    Text text =
        figure::centred({x + 1.7 * out, plot.y(value)}, figure::tick_text(value), kNumberSize);
    text.anchor = is_right ? Anchor::start : Anchor::end;
    text.colour = colour;
    drawing.add(std::move(text));
  }
  drawing.add(Text{{x, plot.corner.y - 4},
                   name,
                   kTextSize,
                   figure::Font::regular,
                   is_right ? Anchor::end : Anchor::start,
                   colour});
}

/// The numbers jump from sample to sample. Places between equal ones are left out.
template <class Value>
void add_curve(Drawing& drawing, const Plot& plot, const Timeline& timeline, const Pen& pen,
               Value value) {
  figure::Stroke curve{{}, pen};
  double last = 0;
  for (const Timeline::Sample& sample : timeline.samples) {
    const double now = value(sample);
    const double x = plot.x(sample.position);
    if (curve.places.empty()) {
      curve.places.push_back({x, plot.y(now)});
    } else if (now != last) {
      curve.places.push_back({x, plot.y(last)});
      curve.places.push_back({x, plot.y(now)});
    }
    last = now;
  }
  curve.places.push_back({plot.x(timeline.samples.back().position), plot.y(last)});
  drawing.add(std::move(curve));
}

/// Every other one is shaded; names where there is room for them.
void add_passes(Drawing& drawing, const Plot& plot, const TraceFile& file) {
  bool is_odd = false;
  for (const TracedPass& pass : file.passes()) {
    const double left = plot.x(pass.events.begin);
    const double right = plot.x(pass.events.end);
    if (is_odd) {
      drawing.rectangle({left, plot.corner.y}, right - left, plot.height, {232, 235, 240, 255});
    }
    is_odd = !is_odd;
    const std::string name = fmt::format("{} {}", file.name(pass.name), pass.round);
    if (figure::text_width(name, kNumberSize) + 4 > right - left) continue;
    drawing.add(Text{{left + 2, plot.corner.y + kNumberSize + 1},
                     name,
                     kNumberSize,
                     figure::Font::regular,
                     Anchor::start,
                     figure::kGrey});
  }
}

std::string bar_text(const TraceFile& file, const IcicleBar& bar, double room) {
  const Call& call = file.calls()[bar.call];
  for (const std::string& text :
       {fmt::format("{} {}", short_name(file, call), format_target(call)), format_target(call)}) {
    if (figure::text_width(text, kNumberSize) + 4 <= room) return text;
  }
  return {};
}

/// Gives the outcomes that are seen.
std::set<Outcome> add_bars(Drawing& drawing, const Plot& plot, const TraceFile& file,
                           const std::vector<IcicleBar>& bars) {
  std::set<Outcome> seen;
  for (const IcicleBar& bar : bars) {
    const Outcome outcome = outcome_of(file.calls()[bar.call]);
    for (std::size_t i = 0; i < kOutcomeCount; ++i) {
      if (bar.ended[i] > 0) seen.insert(static_cast<Outcome>(i));
    }
    const double left = plot.corner.x + plot.width * bar.left;
    const double right = plot.corner.x + plot.width * bar.right;
    const double top = plot.corner.y + kBarHeight * bar.row;
    const double wide = std::max(right - left - 0.3, 0.3);
    add_shares(drawing, bar.ended, {left, top + 0.4}, wide, kBarHeight - 0.8);
    if (bar.count > 1) continue;
    if (outcome == Outcome::undone)
      add_hatching(drawing, {left, top + 0.4}, wide, kBarHeight - 0.8);
    if (wide < kMarkRoom) continue;
    drawing.rectangle({left + 1, top + 1.4}, kMarkRoom - 2, kBarHeight - 2.8, figure::kWhite);
    add_mark(drawing, outcome, {left + 2, top + 2.2}, kMarkRoom - 4);
    const std::string name = bar_text(file, bar, wide - kMarkRoom);
    if (name.empty()) continue;
    Text text = figure::centred({left + kMarkRoom + 1, top + kBarHeight / 2}, name, kNumberSize);
    text.anchor = Anchor::start;
    text.colour = outcome == Outcome::undone ? figure::kBlack : figure::kWhite;
    drawing.add(std::move(text));
  }
  return seen;
}

/// Gives the y below them.
double add_icicles(Drawing& drawing, const TraceFile& file, Place corner, const CallWindow& window,
                   double inside) {
  constexpr double kThinnest = 0.8;
  const std::vector<IcicleBar> bars = lay_out_icicle(file, window, kThinnest / kPlotWidth);
  unsigned rows = 0;
  for (const IcicleBar& bar : bars) rows = std::max(rows, bar.row + 1);
  if (rows == 0) return corner.y;
  const Plot plot{corner, kPlotWidth, kBarHeight * rows, static_cast<double>(window.begin),
                  static_cast<double>(window.end)};
  const std::set<Outcome> seen = add_bars(drawing, plot, file, bars);
  add_frame(drawing, plot);
  const double y = add_event_axis(drawing, plot);
  std::vector<LegendEntry> legend;
  for (const Outcome outcome : seen) {
    legend.push_back({outcome, std::string(outcome_name(outcome))});
  }
  return add_legend(drawing, {kMargin, y + 4}, inside, legend);
}

}  // namespace

Drawing draw_timeline(const TraceFile& file, const Timeline& timeline,
                      const std::optional<std::uint32_t>& call) {
  Drawing drawing;
  drawing.width = 2 * kMargin + 2 * kAxisRoom + kPlotWidth;
  const double inside = drawing.width - 2 * kMargin;
  drawing.title =
      call ? fmt::format("{}, in its run", figure_title(file, *call))
           : fmt::format("Run of {} events and {} calls", file.event_count(), file.calls().size());
  double y = add_paragraph(drawing, {kMargin, kMargin}, inside, drawing.title, kTitleSize,
                           figure::Font::bold);
  Plot plot{{kMargin + kAxisRoom, y + 16},
            kPlotWidth,
            kPlotHeight,
            0,
            static_cast<double>(file.event_count())};
  std::size_t most = 1;
  double best = 1e-9;
  for (const Timeline::Sample& sample : timeline.samples) {
    most = std::max(most, sample.n_bad);
    best = std::max(best, sample.q_worst);
  }
  add_passes(drawing, plot, file);
  constexpr double kRoomForNames = 1.15;
  plot.highest = kRoomForNames * static_cast<double>(most);
  add_value_axis(drawing, plot, false, figure::kBadColour, "bad tets");
  add_curve(drawing, plot, timeline, kBadPen,
            [](const Timeline::Sample& s) { return static_cast<double>(s.n_bad); });
  plot.highest = kRoomForNames * best;
  add_value_axis(drawing, plot, true, figure::kWorstColour, "worst quality");
  add_curve(drawing, plot, timeline, kWorstPen,
            [](const Timeline::Sample& s) { return std::max(s.q_worst, 0.0); });
  const CallWindow window = call ? call_window(file, *call) : whole_trace(file);
  if (call) {  // where it lies
    const double left = plot.x(window.begin);
    drawing.rectangle({left, plot.corner.y}, std::max(plot.x(window.end) - left, 0.8), plot.height,
                      figure::faint(figure::kSelectionColour, 0.6));
  }
  add_frame(drawing, plot);
  y = add_event_axis(drawing, plot);
  y = add_icicles(drawing, file, {plot.corner.x, y + 8}, window, inside);
  drawing.height = y + kMargin;
  return drawing;
}

}  // namespace tetmend::explain
