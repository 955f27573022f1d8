// SPDX-License-Identifier: MIT
#include "report/svg.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "explain/page_text.h"

namespace tetmend::report {

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string drawing(double width, double height, std::string_view classes, std::string_view label,
                    std::string_view content) {
  return fmt::format(R"(<svg class="{}" viewBox="0 0 {} {}" role="img" aria-label="{}">{}</svg>)",
                     classes, coordinate(width), coordinate(height), explain::escaped(label),
                     content);
}

std::string text_at(double x, double y, std::string_view anchor, std::string_view classes,
                    std::string_view text) {
  return fmt::format(R"(<text x="{}" y="{}" text-anchor="{}" class="{}">{}</text>)", coordinate(x),
                     coordinate(y), anchor, classes, explain::escaped(text));
}

std::string line_between(double x1, double y1, double x2, double y2, std::string_view classes) {
  return fmt::format(R"(<line x1="{}" y1="{}" x2="{}" y2="{}" class="{}"/>)", coordinate(x1),
                     coordinate(y1), coordinate(x2), coordinate(y2), classes);
}

std::vector<double> round_ticks(double most, int wanted) {
  const double rough = most / std::max(wanted, 1);
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * decade >= rough) step = factor * decade;
  }
  std::vector<double> ticks;
  constexpr double kRounding = 1e-9;
  for (int i = 0; i * step <= most * (1 + kRounding); ++i) ticks.push_back(i * step);
  return ticks;
}

std::vector<double> decade_ticks(double most, int wanted) {
  const int decades = static_cast<int>(std::floor(std::log10(std::max(most, 1.0))));
  const int step = std::max(1, (decades + wanted - 1) / std::max(wanted, 1));
  std::vector<double> ticks;
  for (int i = 0; i <= decades; i += step) ticks.push_back(std::pow(10.0, i));
  return ticks;
}

std::string tick_text(double value) {
  for (const auto& [unit, name] : {std::pair(1e9, "G"), {1e6, "M"}, {1e3, "k"}}) {
    if (value >= unit) return fmt::format("{:.3g}{}", value / unit, name);
  }
  return fmt::format("{:.3g}", value);
}

double log_share(double count, double most) {
  if (!(count > 0) || !(most > 0)) return 0;
  return std::log10(1 + count) / std::log10(1 + most);
}

}  // namespace tetmend::report
