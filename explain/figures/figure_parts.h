// SPDX-License-Identifier: MIT
// What figures have in common: sizes of text, legends, labels that keep clear of each other.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "explain/call_facts.h"
#include "figure/drawing.h"
#include "kernel/quality.h"
#include "trace/trace_file.h"

namespace tetmend::explain {

// Points.
inline constexpr double kTitleSize = 10;
inline constexpr double kTextSize = 8;
inline constexpr double kNumberSize = 7;
inline constexpr double kLineHeight = 1.35;  ///< in units of the size
inline constexpr double kMargin = 10;

/// Bad tets red, the others by a colour map.
figure::Colour tet_colour(Quality quality,
                          const figure::ColourMap& map = figure::colour_maps().front());
/// As figures print it: "0.074".
std::string quality_number(double quality);

/// One entry of a legend: how it looks, and what it is.
struct LegendEntry {
  std::variant<figure::Pen, figure::Colour, Outcome> look;  ///< a line, a square, or a mark
  std::string text;
};
/// Entries side by side, in as many rows as they need. Gives the y below them.
double add_legend(figure::Drawing& drawing, figure::Place corner, double width,
                  std::span<const LegendEntry> entries);

/// The colours of tet_colour() with their numbers. Gives the y below it.
double add_quality_bar(figure::Drawing& drawing, figure::Place corner);

/// Lines of text from `top` on, no wider than `width`. Gives the y below them.
double add_paragraph(figure::Drawing& drawing, figure::Place top, double width,
                     const std::string& text, double size = kTextSize,
                     figure::Font font = figure::Font::regular);

/// Keeps labels from lying on each other.
class LabelPlacer {
 public:
  /// Puts the label at the first of these places where it is clear of all before it; if there is
  /// none, at the one that touches the fewest. `sizes`: the later only where the earlier found no
  /// place.
  void place(figure::Drawing& drawing, figure::Text label, std::span<const figure::Place> middles,
             std::span<const double> sizes);
  /// Labels keep away from here, too.
  void occupy(const figure::Box& box) { taken_.push_back(box); }
  std::size_t touched(const figure::Box& box) const;

 private:
  std::vector<figure::Box> taken_;
};

/// Of a figure with panels side by side: at least so wide that title and legend have room.
double figure_width(const std::string& title, std::size_t panels, double side, double between);

/// "Call 17: recursion edge 0 1, accepted".
std::string figure_title(const TraceFile& file, std::uint32_t call);

}  // namespace tetmend::explain
