// SPDX-License-Identifier: MIT
// What all drawings of a report share: numbers, ticks, axes. Colours are classes of the style sheet.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tetmend::report {

/// A place on a drawing, with two decimals at most.
std::string coordinate(double value);

/// A rectangle in the units of a drawing, y downwards.
struct Frame {
  double left = 0, top = 0, right = 0, bottom = 0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
  /// The place of a share of its width or height; 0 is left or at the bottom.
  double x(double share) const { return left + share * width(); }
  double y(double share) const { return bottom - share * height(); }
};

/// <svg> of a size, with a name for those who do not see it, around `content`.
std::string drawing(double width, double height, std::string_view classes, std::string_view label,
                    std::string_view content);

/// @param anchor "start", "middle" or "end"
std::string text_at(double x, double y, std::string_view anchor, std::string_view classes,
                    std::string_view text);
std::string line_between(double x1, double y1, double x2, double y2, std::string_view classes);

/// Round numbers from 0 to `most`, about `wanted` of them. Precondition: most > 0.
std::vector<double> round_ticks(double most, int wanted);
/// 1, 10, 100, ... up to `most`, but only every second or third of them if they are many.
std::vector<double> decade_ticks(double most, int wanted);

/// 1200000 as 1.2M.
std::string tick_text(double value);

/// Logarithmic, but 0 for 0: from 0 to 1 for counts from 0 to `most`.
double log_share(double count, double most);

}  // namespace tetmend::report
