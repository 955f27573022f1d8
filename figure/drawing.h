// SPDX-License-Identifier: MIT
// A drawing on a page: areas, lines, dots and words, for paper (SVG, PDF) and on top of pictures.
//
//   Lengths are points of 1/72 inch; on a screen they are pixels. The origin is the upper left
//   corner, y counts downwards. Later shapes cover earlier ones.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "figure/colour.h"

namespace tetmend::figure {

struct Place {
  double x = 0, y = 0;
  friend bool operator==(const Place&, const Place&) = default;
};

struct Pen {
  Colour colour = kBlack;
  double width = 0.75;
  bool dashed = false;
};

/// A closed polygon. For pictures it must be convex.
struct Area {
  std::vector<Place> corners;
  Colour fill;
  std::optional<Pen> outline;
};

/// From the first place to the last.
struct Stroke {
  std::vector<Place> places;
  Pen pen;
};

struct Dot {
  Place middle;
  double radius = 2;
  Colour fill;
};

enum class Font : unsigned char { regular, bold, oblique };
enum class Anchor : unsigned char { start, middle, end };

struct Text {
  Place at;  ///< on the base line: the beginning, middle or end of the text
  std::string text;
  double size = 8;
  Font font = Font::regular;
  Anchor anchor = Anchor::start;
  Colour colour = kBlack;
  /// A patch behind it, so that it can be read on any colour; clear: none.
  Colour patch{255, 255, 255, 0};
};

using Shape = std::variant<Area, Stroke, Dot, Text>;

struct Drawing {
  double width = 0, height = 0;
  std::string title;  ///< what the file says it shows
  std::vector<Shape> shapes;

  void add(Shape shape);
  void rectangle(Place corner, double width_of_it, double height_of_it, const Colour& fill);
  void line(Place from, Place to, const Pen& pen) { add(Stroke{{from, to}, pen}); }
};

/// Of Helvetica, whose widths Arial and their free equivalents share. Letters beyond ASCII count as
/// "?", which is what printable() makes of them.
double text_width(std::string_view text, double size, Font font = Font::regular);

/// What figures show of a text: each letter beyond printable ASCII as "?".
std::string printable(std::string_view utf8);

/// What a text covers: its left, right, upper and lower edge.
struct Box {
  double left = 0, right = 0, top = 0, bottom = 0;
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};
Box box_of(const Text& text);

/// The patch behind a text, a little larger than it.
Area patch_behind(const Text& text);
/// Of each dash and each gap of a dashed line.
double dash_length(const Pen& pen);

/// Text whose middle is at `at`, in both directions.
Text centred(Place at, std::string text, double size, Font font = Font::regular);

/// Lines that are no wider than `width`, broken at blanks; a longer word stays whole.
std::vector<std::string> wrap(std::string_view text, double width, double size,
                              Font font = Font::regular);

/// Round numbers from low to high, about `count`: multiples of 1, 2 or 5 times a power of ten.
/// Precondition: low < high, both finite.
std::vector<double> ticks(double low, double high, unsigned count);
/// As short as it can be: "20000", "0.25".
std::string tick_text(double value);

}  // namespace tetmend::figure
