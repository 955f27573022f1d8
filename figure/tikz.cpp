// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>

#include "figure/drawing_file.h"

namespace tetmend::figure {

namespace {

/// Up to two decimals.
std::string decimal(double value) {
  const std::string text = fmt::format("{:.2f}", value);
  return text == "-0.00" ? "0.00" : text;
}

std::string at(const Place& place) {
  return fmt::format("({},{})", decimal(place.x), decimal(place.y));
}

/// In the words of xcolor; `property` is fill, draw or text.
std::string coloured(std::string_view property, const Colour& colour) {
  std::string text = fmt::format("{}={{rgb,255:red,{};green,{};blue,{}}}", property, colour.red,
                                 colour.green, colour.blue);
  if (colour.alpha < 255) {
    text += fmt::format(",{} opacity={}", property, decimal(colour.alpha / 255.0));
  }
  return text;
}

std::string drawn(const Pen& pen) {
  std::string text = coloured("draw", pen.colour) +
                     fmt::format(",line width={}bp,line join=round", decimal(pen.width));
  if (pen.dashed) {
    text += fmt::format(",dash pattern=on {0}bp off {0}bp", decimal(dash_length(pen)));
  }
  return text;
}

std::string joined(const std::vector<Place>& places) {
  std::string text;
  for (const Place& place : places) text += (text.empty() ? "" : " -- ") + at(place);
  return text;
}

/// Characters that TeX takes for commands.
std::string escaped_for_tex(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '~':
        result += "\\textasciitilde{}";
        break;
      case '^':
        result += "\\textasciicircum{}";
        break;
      case '<':
        result += "\\textless{}";
        break;
      case '>':
        result += "\\textgreater{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        result += '\\';
        [[fallthrough]];
      default:
        result += c;
    }
  }
  return result;
}

class TikzWriter {
 public:
  void operator()(const Area& area) {
    out_ += fmt::format("\\path[{}{}] {} -- cycle;\n", coloured("fill", area.fill),
                        area.outline ? "," + drawn(*area.outline) : "", joined(area.corners));
  }
  void operator()(const Stroke& line) {
    out_ += fmt::format("\\path[{}] {};\n", drawn(line.pen), joined(line.places));
  }
  void operator()(const Dot& dot) {
    out_ += fmt::format("\\path[{}] {} circle[radius={}bp];\n", coloured("fill", dot.fill),
                        at(dot.middle), decimal(dot.radius));
  }
  void operator()(const Text& text) {
    constexpr std::array<std::string_view, 3> kAnchors = {"base west", "base", "base east"};
    if (text.text.empty()) return;
    if (text.patch.alpha > 0) (*this)(patch_behind(text));
    const std::string_view style = text.font == Font::bold      ? "\\bfseries"
                                   : text.font == Font::oblique ? "\\slshape"
                                                                : "";
    out_ += fmt::format(
        "\\node[anchor={},inner sep=0,{},font=\\fontsize{{{}bp}}{{{}bp}}\\sffamily{}] at {} "
        "{{{}}};\n",
        kAnchors[static_cast<std::size_t>(text.anchor)], coloured("text", text.colour),
        decimal(text.size), decimal(1.2 * text.size), style, at(text.at),
        escaped_for_tex(printable(text.text)));
  }

  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

}  // namespace

std::string tikz_of(const Drawing& drawing) {
  TikzWriter writer;
  for (const Shape& shape : drawing.shapes) std::visit(writer, shape);
  return fmt::format(
      "% {}\n% \\input{{this file}} where \\usepackage{{tikz}} is.\n"
      "\\begin{{tikzpicture}}[x=1bp,y=-1bp]\n\\useasboundingbox (0,0) rectangle ({},{});\n"
      "{}\\end{{tikzpicture}}\n",
      printable(drawing.title), decimal(drawing.width), decimal(drawing.height), writer.take());
}

}  // namespace tetmend::figure
