// SPDX-License-Identifier: MIT
#include "figure/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace tetmend::figure {

namespace {

constexpr char kFirst = ' ';
constexpr char kLast = '~';
constexpr double kAscent = 0.72;  // of letters, in units of the size
constexpr double kDescent = 0.21;

using Widths = std::array<std::uint16_t, kLast - kFirst + 1>;

// In thousandths of the size, from blank to tilde: Adobe's metrics of the 14 standard fonts.
constexpr Widths kHelvetica = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};
constexpr Widths kHelveticaBold = {
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611, 975, 722, 722, 722, 722, 667,
    611, 778, 722, 278, 556, 722, 611, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 333, 278, 333, 584, 556, 333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556,
    278, 889, 611, 611, 611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584};

}  // namespace

void Drawing::add(Shape shape) {
  shapes.push_back(std::move(shape));
}

void Drawing::rectangle(Place corner, double width_of_it, double height_of_it, const Colour& fill) {
  const double right = corner.x + width_of_it;
  const double bottom = corner.y + height_of_it;
  add(Area{{corner, {right, corner.y}, {right, bottom}, {corner.x, bottom}}, fill, {}});
}

std::string printable(std::string_view utf8) {
  std::string text;
  for (const char c : utf8) {
    if (c >= kFirst && c <= kLast) {
      text += c;
    } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {  // no later byte of a letter
      text += '?';
    }
  }
  return text;
}

double text_width(std::string_view text, double size, Font font) {
  const Widths& widths = font == Font::bold ? kHelveticaBold : kHelvetica;
  unsigned sum = 0;
  for (const char c : printable(text)) sum += widths[static_cast<std::size_t>(c - kFirst)];
  return size * sum / 1000.0;
}

Box box_of(const Text& text) {
  const double width = text_width(text.text, text.size, text.font);
  const double share = text.anchor == Anchor::start ? 0 : text.anchor == Anchor::middle ? 0.5 : 1;
  const double left = text.at.x - share * width;
  return {left, left + width, text.at.y - kAscent * text.size, text.at.y + kDescent * text.size};
}

Area patch_behind(const Text& text) {
  constexpr double kMargin = 0.12;  // in units of the size
  const Box box = box_of(text);
  const double m = kMargin * text.size;
  return {{{box.left - m, box.top - m},
           {box.right + m, box.top - m},
           {box.right + m, box.bottom + m},
           {box.left - m, box.bottom + m}},
          text.patch,
          {}};
}

double dash_length(const Pen& pen) {
  constexpr double kShortest = 2.5;
  return std::max(kShortest, 2.5 * pen.width);
}

Text centred(Place at, std::string text, double size, Font font) {
  at.y += kAscent * size / 2;
  return {at, std::move(text), size, font, Anchor::middle, kBlack, {255, 255, 255, 0}};
}

std::vector<std::string> wrap(std::string_view text, double width, double size, Font font) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (lines.back().empty() || text_width(longer, size, font) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::vector<double> ticks(double low, double high, unsigned count) {
  const double rough = (high - low) / std::max(count, 1U);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double share = rough / power;
  const double step = power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
  std::vector<double> values;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    values.push_back(i == 0 ? 0 : i * step);
  }
  return values;
}

std::string tick_text(double value) {
  constexpr double kMostPlain = 1e7;
  if (value == std::floor(value) && std::abs(value) < kMostPlain) {
    return fmt::format("{:.0f}", value);
  }
  return fmt::format("{:.4g}", value);
}

}  // namespace tetmend::figure
