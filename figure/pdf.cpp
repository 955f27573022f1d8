// SPDX-License-Identifier: MIT
#include <array>
#include <map>
#include <new>

#include <fmt/format.h>
#include <zlib.h>

#include "figure/drawing_file.h"

namespace tetmend::figure {

namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 9);
  if (result != Z_OK) throw std::bad_alloc();  // there is no other reason
  packed.resize(size);
  return packed;
}

/// A text as PDF quotes it.
std::string in_parentheses(std::string_view text) {
  std::string result = "(";
  for (const char c : printable(text)) {
    if (c == '(' || c == ')' || c == '\\') result += '\\';
    result += c;
  }
  return result + ")";
}

constexpr std::array<std::string_view, 3> kFonts = {"Helvetica", "Helvetica-Bold",
                                                    "Helvetica-Oblique"};

/// The marks on the page. PDF counts y upwards.
class PageWriter {
 public:
  explicit PageWriter(double height) : height_(height) {}

  void operator()(const Area& area) {
    fill(area.fill);
    if (area.outline) pen(*area.outline);
    path(area.corners);
    out_ += area.outline ? "b\n" : "h f\n";
  }
  void operator()(const Stroke& line) {
    pen(line.pen);
    path(line.places);
    out_ += "S\n";
  }
  void operator()(const Dot& dot) {
    constexpr double kArc = 0.5523;  // of the radius: a Bezier curve as a quarter of a circle
    const double r = dot.radius;
    const auto at = [&](double x, double y) {
      return fmt::format("{:.3f} {:.3f} ", dot.middle.x + r * x, height_ - dot.middle.y + r * y);
    };
    fill(dot.fill);
    out_ += at(1, 0) + "m\n";
    out_ += at(1, kArc) + at(kArc, 1) + at(0, 1) + "c\n";
    out_ += at(-kArc, 1) + at(-1, kArc) + at(-1, 0) + "c\n";
    out_ += at(-1, -kArc) + at(-kArc, -1) + at(0, -1) + "c\n";
    out_ += at(kArc, -1) + at(1, -kArc) + at(1, 0) + "c\nh f\n";
  }
  void operator()(const Text& text) {
    if (text.text.empty()) return;
    if (text.patch.alpha > 0) (*this)(patch_behind(text));
    fill(text.colour);
    out_ += fmt::format("BT /F{} {:.2f} Tf {:.3f} {:.3f} Td {} Tj ET\n",
                        static_cast<unsigned>(text.font), text.size, box_of(text).left,
                        height_ - text.at.y, in_parentheses(text.text));
  }

  /// Names of graphics states, by opacity of lines and areas.
  const std::map<unsigned, std::string>& opacities() const { return opacities_; }
  const std::string& marks() const { return out_; }

 private:
  void path(const std::vector<Place>& places) {
    const char* word = "m";
    for (const Place& p : places) {
      out_ += fmt::format("{:.3f} {:.3f} {}\n", p.x, height_ - p.y, word);
      word = "l";
    }
  }
  void colour(const Colour& c, std::string_view word) {
    out_ += fmt::format("{:.3f} {:.3f} {:.3f} {}\n", c.red / 255.0, c.green / 255.0, c.blue / 255.0,
                        word);
  }
  void opacity(unsigned alpha, std::string_view kind) {
    const unsigned key = alpha + (kind == "ca" ? 0U : 256U);
    const auto added = opacities_.try_emplace(key, fmt::format("G{}{}", kind, alpha));
    out_ += fmt::format("/{} gs\n", added.first->second);
  }
  void fill(const Colour& c) {
    colour(c, "rg");
    opacity(c.alpha, "ca");
  }
  void pen(const Pen& pen) {
    colour(pen.colour, "RG");
    opacity(pen.colour.alpha, "CA");
    const std::string dashes = pen.dashed ? fmt::format("{0:.2f} {0:.2f}", dash_length(pen)) : "";
    out_ += fmt::format("{:.3f} w 1 j [{}] 0 d\n", pen.width, dashes);
  }

  double height_;
  std::string out_;
  std::map<unsigned, std::string> opacities_;
};

/// Numbered objects and the table of where they are.
class PdfFile {
 public:
  void object(const std::string& content) {
    places_.push_back(bytes_.size());
    bytes_ += fmt::format("{} 0 obj\n{}\nendobj\n", places_.size(), content);
  }
  std::string end(unsigned root, unsigned info) {
    const std::size_t table = bytes_.size();
    bytes_ += fmt::format("xref\n0 {}\n0000000000 65535 f \n", places_.size() + 1);
    for (const std::size_t place : places_) bytes_ += fmt::format("{:010} 00000 n \n", place);
    bytes_ +=
        fmt::format("trailer\n<< /Size {} /Root {} 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n",
                    places_.size() + 1, root, info, table);
    return std::move(bytes_);
  }

 private:
  std::string bytes_ = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";  // the second line: not only text
  std::vector<std::size_t> places_;
};

std::string resources(const PageWriter& page) {
  std::string text = "/Resources << /Font <<";
  for (std::size_t i = 0; i < kFonts.size(); ++i) {
    text += fmt::format(
        " /F{} << /Type /Font /Subtype /Type1 /BaseFont /{} /Encoding /WinAnsiEncoding >>", i,
        kFonts[i]);
  }
  text += " >> /ExtGState <<";
  for (const auto& [key, name] : page.opacities()) {
    text +=
        fmt::format(" /{} << /{} {:.3f} >>", name, key < 256 ? "ca" : "CA", (key % 256) / 255.0);
  }
  return text + " >> >>";
}

}  // namespace

std::string pdf_of(const Drawing& drawing) {
  PageWriter page(drawing.height);
  Drawing paper;
  paper.rectangle({0, 0}, drawing.width, drawing.height, kWhite);
  for (const Shape& shape : paper.shapes) std::visit(page, shape);
  for (const Shape& shape : drawing.shapes) std::visit(page, shape);
  PdfFile file;
  file.object("<< /Type /Catalog /Pages 2 0 R >>");
  file.object("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
  file.object(
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.2f} {:.2f}] /Contents 4 0 R\n"
                  "/Group << /Type /Group /S /Transparency /CS /DeviceRGB >>\n{} >>",
                  drawing.width, drawing.height, resources(page)));
  const std::string packed = deflated(page.marks());
  file.object(fmt::format("<< /Length {} /Filter /FlateDecode >>\nstream\n{}\nendstream",
                          packed.size(), packed));
  file.object(fmt::format("<< /Title {} /Producer (tetmend) >>", in_parentheses(drawing.title)));
  return file.end(1, 5);
}

}  // namespace tetmend::figure
