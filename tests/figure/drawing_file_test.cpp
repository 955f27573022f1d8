// SPDX-License-Identifier: MIT
#include "figure/drawing_file.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::figure;
using namespace tetmend::test;

namespace {

Drawing example() {
  Drawing drawing{200, 100, "a < b & \"c\"", {}};
  drawing.add(Area{{{10, 10}, {50, 10}, {30, 40}}, {255, 0, 0, 128}, Pen{kBlack, 1.5}});
  drawing.line({0, 0}, {200, 100}, {{0, 128, 0, 255}, 2, true});
  drawing.add(Dot{{100, 50}, 5, kBlack});
  drawing.add(Text{{20, 90}, "p <(1)\\", 8, Font::bold});
  return drawing;
}

bool contains(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

/// The marks of the page, unpacked.
std::string marks_of(const std::string& pdf) {
  const std::size_t begin = pdf.find("stream\n") + 7;
  const std::size_t end = pdf.find("\nendstream");
  std::string marks(100'000, '\0');
  uLongf size = marks.size();
  const int result = uncompress(reinterpret_cast<Bytef*>(marks.data()), &size,
                                reinterpret_cast<const Bytef*>(pdf.data() + begin),
                                static_cast<uLong>(end - begin));
  REQUIRE(result == Z_OK);
  marks.resize(size);
  return marks;
}

}  // namespace

TEST_CASE("SVG has each shape, and marks of its own are escaped") {
  const std::string svg = svg_of(example());
  CHECK(contains(svg, "width=\"200pt\" height=\"100pt\" viewBox=\"0 0 200 100\""));
  CHECK(contains(svg, "<title>a &lt; b &amp; &quot;c&quot;</title>"));
  CHECK(contains(svg,
                 "<polygon points=\"10,10 50,10 30,40\" fill=\"#ff0000\" fill-opacity=\"0.5\" "
                 "stroke=\"#000000\" stroke-width=\"1.5\""));
  CHECK(contains(svg, "stroke-dasharray=\"5 5\""));
  CHECK(contains(svg, "<circle cx=\"100\" cy=\"50\" r=\"5\""));
  CHECK(contains(svg, "font-weight=\"bold\""));
  CHECK(contains(svg, ">p &lt;(1)\\</text>"));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(svg_of(example()) == svg);
}

TEST_CASE("PDF counts y upwards, quotes words, and names each opacity") {
  const std::string pdf = pdf_of(example());
  CHECK(pdf.starts_with("%PDF-1.4\n"));
  CHECK(contains(pdf, "/MediaBox [0 0 200.00 100.00]"));
  CHECK(contains(pdf, "/Gca128 << /ca 0.502 >>"));
  CHECK(contains(pdf, "/Title (a < b & \"c\")"));
  const std::string marks = marks_of(pdf);
  CHECK(contains(marks, "10.000 90.000 m\n50.000 90.000 l\n30.000 60.000 l\nb\n"));
  CHECK(contains(marks, "[5.00 5.00] 0 d"));
  CHECK(contains(marks, "BT /F1 8.00 Tf 20.000 10.000 Td (p <\\(1\\)\\\\) Tj ET"));
  CHECK(pdf_of(example()) == pdf);
}

TEST_CASE("the table of a PDF says where its objects are") {
  const std::string pdf = pdf_of(example());
  const std::size_t table = std::stoul(pdf.substr(pdf.find("startxref\n") + 10));
  REQUIRE(pdf.substr(table, 7) == "xref\n0 ");
  std::size_t at = pdf.find("n \n", table);
  for (unsigned object = 1; at != std::string::npos; at = pdf.find("n \n", at + 1), ++object) {
    const std::size_t place = std::stoul(pdf.substr(at - 17, 10));
    CHECK(pdf.substr(place, 7) == std::to_string(object) + " 0 obj");
  }
}

TEST_CASE("a patch lies behind its words, and words of nothing leave no mark") {
  Drawing drawing{50, 50, "t", {}};
  Text text = centred({25, 25}, "12", 8);
  text.patch = kWhite;
  drawing.add(text);
  drawing.add(Text{{1, 1}, "", 8});
  const std::string svg = svg_of(drawing);
  CHECK(count_of(svg, "<text") == 1);
  CHECK(svg.find("<polygon") < svg.find("<text"));
  CHECK(count_of(svg, "<polygon") == 1);
}

TEST_CASE("a file is written whole under .svg or .pdf, and under no other name") {
  const test::TempFolder folder;
  write_drawing(folder / "x.svg", example());
  write_drawing(folder / "x.pdf", example());
  CHECK(test::read_text(folder / "x.svg") == svg_of(example()));
  CHECK(test::read_text(folder / "x.pdf") == pdf_of(example()));
  CHECK_THROWS_WITH_AS(write_drawing(folder / "x.gif", example()),
                       doctest::Contains("x.gif: figures are written as .svg, .pdf or .tex"),
                       Error);
  CHECK(folder.entries() == 2);
}

TEST_CASE("a drawing is a tikzpicture, and what TeX would take for a command is text") {
  Drawing drawing;
  drawing.width = 40;
  drawing.height = 30;
  drawing.title = "ring";
  drawing.add(Area{{{0, 0}, {10, 0}, {10, 10}}, Colour{255, 0, 0, 51}, Pen{kBlack, 1, true}});
  drawing.add(Dot{{5, 5}, 2, kBlack});
  drawing.add(Text{{20, 20}, "p_1 & 50 % {\\x}", 8});
  const std::string text = tikz_of(drawing);
  CHECK(text.starts_with("% ring\n"));
  CHECK(text.find("\\begin{tikzpicture}[x=1bp,y=-1bp]\n") != std::string::npos);
  CHECK(text.find("fill={rgb,255:red,255;green,0;blue,0},fill opacity=0.20") != std::string::npos);
  CHECK(text.find("(0.00,0.00) -- (10.00,0.00) -- (10.00,10.00) -- cycle;") != std::string::npos);
  CHECK(text.find("{p\\_1 \\& 50 \\% \\{\\textbackslash{}x\\}}") != std::string::npos);
  CHECK(text.ends_with("\\end{tikzpicture}\n"));
}
