// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>

#include "figure/drawing_file.h"
#include "figure/markup.h"

namespace tetmend::figure {

namespace {

/// Up to two decimals, without zeros at the end.
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

/// fill="#rrggbb" fill-opacity="0.5"
std::string paint(std::string_view property, const Colour& colour) {
  std::string text =
      fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", property, colour.red, colour.green, colour.blue);
  if (colour.alpha < 255) {
    text += fmt::format(" {}-opacity=\"{}\"", property, number(colour.alpha / 255.0));
  }
  return text;
}

std::string stroke(const Pen& pen) {
  std::string text =
      paint("stroke", pen.colour) +
      fmt::format(" stroke-width=\"{}\" stroke-linejoin=\"round\"", number(pen.width));
  if (pen.dashed) {
    text += fmt::format(" stroke-dasharray=\"{0} {0}\"", number(dash_length(pen)));
  }
  return text;
}

std::string path(const std::vector<Place>& places) {
  std::string text;
  for (const Place& p : places) {
    text += fmt::format("{}{},{}", text.empty() ? "" : " ", number(p.x), number(p.y));
  }
  return text;
}

class SvgWriter {
 public:
  void operator()(const Area& area) {
    out_ += fmt::format("<polygon points=\"{}\"{}{}/>\n", path(area.corners),
                        paint("fill", area.fill), area.outline ? stroke(*area.outline) : "");
  }
  void operator()(const Stroke& line) {
    out_ += fmt::format("<polyline points=\"{}\" fill=\"none\"{}/>\n", path(line.places),
                        stroke(line.pen));
  }
  void operator()(const Dot& dot) {
    out_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", number(dot.middle.x),
                        number(dot.middle.y), number(dot.radius), paint("fill", dot.fill));
  }
  void operator()(const Text& text) {
    constexpr std::array<std::string_view, 3> kAnchors = {"start", "middle", "end"};
    if (text.text.empty()) return;
    if (text.patch.alpha > 0) (*this)(patch_behind(text));
    const std::string_view style = text.font == Font::bold      ? " font-weight=\"bold\""
                                   : text.font == Font::oblique ? " font-style=\"oblique\""
                                                                : "";
    out_ += fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\"{} text-anchor=\"{}\" textLength=\"{}\" "
        "lengthAdjust=\"spacingAndGlyphs\"{}>{}</text>\n",
        number(text.at.x), number(text.at.y), number(text.size), style,
        kAnchors[static_cast<std::size_t>(text.anchor)],
        number(text_width(text.text, text.size, text.font)), paint("fill", text.colour),
        escaped(printable(text.text)));
  }

  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

}  // namespace

std::string svg_of(const Drawing& drawing) {
  SvgWriter writer;
  for (const Shape& shape : drawing.shapes) std::visit(writer, shape);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}pt\" height=\"{1}pt\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, 'Nimbus Sans', 'Liberation Sans', "
      "sans-serif\" xml:space=\"preserve\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
      number(drawing.width), number(drawing.height), escaped(printable(drawing.title)),
      writer.take());
}

}  // namespace tetmend::figure
