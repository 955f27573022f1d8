// SPDX-License-Identifier: MIT
#include "explain/figures/figure_parts.h"

#include <algorithm>
#include <limits>
#include <regex>

#include <fmt/format.h>

#include "explain/outcome_look.h"
#include "explain/page.h"

namespace tetmend::explain {

using figure::Area;
using figure::Box;
using figure::Colour;
using figure::Drawing;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kBestQuality = 2;  // of colours: the regular tet, with the goal in the middle

}  // namespace

Colour tet_colour(Quality quality, const figure::ColourMap& map) {
  if (quality < kBadThreshold) return figure::kBadColour;
  return map.at(static_cast<double>(quality) / kBestQuality);
}

std::string quality_number(double quality) {
  return fmt::format("{:.3f}", quality);
}

double add_legend(Drawing& drawing, Place corner, double width,
                  std::span<const LegendEntry> entries) {
  constexpr double kSwatch = 14;
  constexpr double kGap = 4;
  constexpr double kBetween = 14;
  const double line = kTextSize * kLineHeight;
  Place at = corner;
  for (const LegendEntry& entry : entries) {
    const double needed = kSwatch + kGap + figure::text_width(entry.text, kTextSize);
    if (at.x > corner.x && at.x + needed > corner.x + width) at = {corner.x, at.y + line};
    const double middle = at.y + line / 2;
    if (const Pen* pen = std::get_if<Pen>(&entry.look)) {
      drawing.line({at.x, middle}, {at.x + kSwatch, middle}, *pen);
    } else if (const Outcome* outcome = std::get_if<Outcome>(&entry.look)) {
      add_mark(drawing, *outcome, {at.x + (kSwatch - kTextSize) / 2, middle - kTextSize / 2},
               kTextSize);
    } else {
      drawing.rectangle({at.x + (kSwatch - kTextSize) / 2, middle - kTextSize / 2}, kTextSize,
                        kTextSize, std::get<Colour>(entry.look));
    }
    Text text = figure::centred({at.x + kSwatch + kGap, middle}, entry.text, kTextSize);
    text.anchor = figure::Anchor::start;
    drawing.add(std::move(text));
    at.x += needed + kBetween;
  }
  return entries.empty() ? corner.y : at.y + line;
}

double add_quality_bar(Drawing& drawing, Place corner) {
  constexpr double kWidth = 150;
  constexpr double kHeight = 7;
  constexpr unsigned kSteps = 60;
  const std::string name = "quality of tets; bad below 1";
  drawing.add(Text{{corner.x, corner.y + kTextSize}, name, kTextSize});
  const double left = corner.x + figure::text_width(name, kTextSize) + 10;
  const double step = kWidth / kSteps;
  for (unsigned i = 0; i < kSteps; ++i) {
    const auto quality = static_cast<Quality>(kBestQuality * (i + 0.5) / kSteps);
    // A little wider, lest paper shows between two of them.
    const double wide = i + 1 < kSteps ? step + 0.3 : step;
    drawing.rectangle({left + step * i, corner.y + 1}, wide, kHeight, tet_colour(quality));
  }
  for (const double value : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    const double x = left + kWidth * value / kBestQuality;
    const double y = corner.y + 1 + kHeight;
    drawing.line({x, y}, {x, y + 2.5}, Pen{figure::kBlack, 0.5});
    drawing.add(figure::centred({x, y + 7}, figure::tick_text(value), kNumberSize));
  }
  return corner.y + kHeight + 14;
}

namespace {

/// "p_1" in it is as labels have it: a letter and an index below.
void add_line(Drawing& drawing, Place at, const std::string& line, double size, figure::Font font) {
  static const std::regex kName(R"(\b[A-Za-z]_[0-9]\b)");
  constexpr double kIndex = 0.7;  // both in units of the size
  constexpr double kBelow = 0.18;
  const auto add = [&](const std::string& text, double text_size, figure::Font text_font,
                       double below) {
    drawing.add(Text{{at.x, at.y + below}, text, text_size, text_font});
    at.x += figure::text_width(text, text_size, text_font);
  };
  std::string rest = line;
  for (std::smatch found; std::regex_search(rest, found, kName); rest = found.suffix()) {
    const std::string letter = found.str();
    if (found.position() > 0) add(found.prefix(), size, font, 0);
    add(letter.substr(0, 1), size, figure::Font::oblique, 0);
    add(letter.substr(2), kIndex * size, font, kBelow * size);
  }
  if (!rest.empty()) add(rest, size, font, 0);
}

}  // namespace

double add_paragraph(Drawing& drawing, Place top, double width, const std::string& text,
                     double size, figure::Font font) {
  double y = top.y;
  for (const std::string& line : figure::wrap(text, width, size, font)) {
    add_line(drawing, {top.x, y + size}, line, size, font);
    y += size * kLineHeight;
  }
  return y;
}

std::size_t LabelPlacer::touched(const Box& box) const {
  return static_cast<std::size_t>(std::count_if(
      taken_.begin(), taken_.end(), [&](const Box& other) { return box.overlaps(other); }));
}

void LabelPlacer::place(Drawing& drawing, Text label, std::span<const Place> middles,
                        std::span<const double> sizes) {
  Text best = label;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const double size : sizes) {
    for (const Place& middle : middles) {
      Text tried = figure::centred(middle, label.text, size, label.font);
      tried.colour = label.colour;
      tried.patch = label.patch;
      const std::size_t count = touched(figure::box_of(tried));
      if (count >= fewest) continue;
      fewest = count;
      best = std::move(tried);
    }
    if (fewest == 0) break;
  }
  taken_.push_back(figure::box_of(best));
  drawing.add(std::move(best));
}

double figure_width(const std::string& title, std::size_t panels, double side, double between) {
  constexpr double kLeast = 300;  // of the legend
  const double all = static_cast<double>(panels) * (side + between) - between;
  const double title_width = figure::text_width(title, kTitleSize, figure::Font::bold);
  return 2 * kMargin + std::max({all, title_width + 1, kLeast});
}

std::string figure_title(const TraceFile& file, std::uint32_t call) {
  return fmt::format("{}, {}", title_of_call(file, call), file.calls()[call].verdict_in_words());
}

}  // namespace tetmend::explain
