// SPDX-License-Identifier: MIT
#include "explain/figures/ring_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "explain/figures/figure_parts.h"

namespace tetmend::explain {

using figure::Area;
using figure::faint;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kRadius = 0.76;  // of the polygon; less for long names
constexpr double kLeastRadius = 0.5;
constexpr double kNameGap = 0.05;  // between its corners and their names

// Below the number of a corner its place in the ring; in units of the number's size.
constexpr double kPlaceSize = 0.85;
constexpr double kIndexSize = 0.65;
constexpr double kPlaceBelow = 1.05;

Place mix(const Place& p, const Place& q, double t) {
  return {(1 - t) * p.x + t * q.x, (1 - t) * p.y + t * q.y};
}

class PolygonDrawer {
 public:
  PolygonDrawer(const ShellPicture& shell, const RingLook& look)
      : shell_(shell), look_(look), name_size_(look.name_size) {
    spread_names();
    radius_ = look_.half * std::max(radius_for_names(), kLeastRadius);
  }

  void chords() {
    const std::vector<Chord> chords = chords_of(shell_);
    for (auto chord = chords.rbegin(); chord != chords.rend(); ++chord) {  // the best on top
      const bool is_better = chord->best()[0] > shell_.floor;
      line(corner(chord->from), corner(chord->to), chord_pen(look_.line, is_better),
           {ends(chord->from, chord->to),
            fmt::format("chord {} - {}: worst quality of its pockets {:.4f} and {:.4f}{}",
                        shell_.ring[chord->from].index(), shell_.ring[chord->to].index(),
                        chord->on[0], chord->back[0],
                        is_better ? "" : "; not better than the old tets")});
    }
  }

  void covering(const FlatCovering& covering, bool dashed) {
    if (covering.core.size() >= 3) core(covering);
    for (const FlatCovering::Triangle& t : covering.triangles) triangle(t, dashed);
    if (covering.triangles.empty()) return;
    for (const FlatCovering::Side& side : covering.core) {
      Pen pen = core_pen(look_.line);
      pen.dashed = dashed;
      line(corner(side.from), corner(side.to), pen,
           {ends(side.from, side.to),
            fmt::format("side of the core {} - {}: {:.4f}", shell_.ring[side.from].index(),
                        shell_.ring[side.to].index(), side.quality)});
    }
  }

  /// The pocket of a cell of the tables, with the triangle that it has chosen at its chord.
  void cell(const TableCell& cell) {
    const unsigned k = shell_.tables.k(cell.i, cell.j);
    const auto edge = [&](unsigned from, unsigned to, double width) {
      line(corner(from), corner(to), {figure::kCellColour, width * look_.line},
           {ends(from, to), {}});
    };
    if (k < shell_.ring.size()) {
      areas_.emplace_back(
          Area{{corner(cell.i), corner(k), corner(cell.j)}, faint(figure::kCellColour, 0.28), {}},
          Meaning{{shell_.ring[cell.i], shell_.ring[k], shell_.ring[cell.j]}, {}});
      edge(cell.i, k, 2.5);
      edge(k, cell.j, 2.5);
    }
    edge(cell.i, cell.j, 5);
  }

  /// Areas, then lines, then words on top of each other.
  LinkedDrawing finish() {
    LinkedDrawing all;
    for (auto& [area, meaning] : areas_) all.add(std::move(area), std::move(meaning));
    const std::size_t m = shell_.ring.size();
    for (std::size_t i = 0; i < m; ++i) {
      all.add(figure::Stroke{{corner(i), corner((i + 1) % m)}, skirt_pen(look_.line)},
              {ends(i, (i + 1) % m), {}});
    }
    for (auto& [stroke, meaning] : lines_) all.add(std::move(stroke), std::move(meaning));
    if (name_size_ > 0) {
      leaders(all);
      words(all);
    }
    return all;
  }

 private:
  struct Number {
    Text text;
    std::vector<Place> places;
    Meaning meaning;
  };

  std::vector<VertexHandle> ends(std::size_t i, std::size_t j) const {
    return {shell_.ring[i], shell_.ring[j]};
  }
  Place corner(std::size_t i) const {
    const Eigen::Vector2d at = shell_.place(i);
    return {look_.middle.x + radius_ * at.x(), look_.middle.y - radius_ * at.y()};
  }

  std::string name_text(std::size_t i) const { return fmt::format("{}", shell_.ring[i].index()); }
  double half_width(std::size_t i) const {
    return figure::text_width(name_text(i), name_size_, figure::Font::bold) / 2;
  }
  double half_height() const { return (1 + kPlaceBelow) / 2 * name_size_; }
  /// Of the middle of a name from its corner.
  double distance_of_name(std::size_t i) const {
    const Eigen::Vector2d out = shell_.place(i);
    const double own = half_width(i) * std::abs(out.x()) + half_height() * std::abs(out.y());
    return kNameGap * look_.half + (1 + 2 * circle_of(i)) * own;
  }

  /// Of names that stand in turn on several circles: 0 is the inner one.
  unsigned circle_of(std::size_t i) const {
    const std::size_t m = shell_.ring.size();
    const bool is_odd = i + 1 == m && m % circles_ == 1 && circles_ > 1;
    return is_odd ? circles_ : static_cast<unsigned>(i % circles_);
  }

  /// Where names would lie on each other: smaller ones, or on several circles.
  void spread_names() {
    struct Try {
      unsigned circles;
      double share;
    };
    constexpr std::array<Try, 12> kTries = {{{1, 1},
                                             {1, 0.85},
                                             {2, 1},
                                             {2, 0.85},
                                             {1, 0.7},
                                             {2, 0.7},
                                             {3, 0.85},
                                             {3, 0.7},
                                             {2, 0.55},
                                             {3, 0.55},
                                             {3, 0.45},
                                             {4, 0.45}}};
    for (const Try& tried : kTries) {
      circles_ = tried.circles;
      name_size_ = tried.share * look_.name_size;
      const double radius = radius_for_names();
      radius_ = look_.half * std::max(radius, kLeastRadius);
      if (radius >= kLeastRadius && !names_overlap()) return;
    }
  }

  bool names_overlap() const {
    std::vector<figure::Box> boxes;
    for (std::size_t i = 0; i < shell_.ring.size(); ++i) {
      const figure::Box box = box_of_name(i);
      for (const figure::Box& other : boxes) {
        if (box.overlaps(other)) return true;
      }
      boxes.push_back(box);
    }
    return false;
  }

  figure::Box box_of_name(std::size_t i) const {
    const Place middle = middle_of_name(i);
    const double wide = half_width(i), high = half_height();
    return {middle.x - wide, middle.x + wide, middle.y - high, middle.y + high};
  }

  /// From corners to names that do not stand beside them.
  void leaders(LinkedDrawing& all) const {
    for (std::size_t i = 0; i < shell_.ring.size(); ++i) {
      if (circle_of(i) == 0) continue;
      const figure::Box box = box_of_name(i);
      const Place from = corner(i);
      const Place to = {std::clamp(from.x, box.left, box.right),
                        std::clamp(from.y, box.top, box.bottom)};
      all.add(figure::Stroke{{from, to}, {faint(look_.ink, 0.5), 0.75 * look_.line}},
              {{shell_.ring[i]}, {}});
    }
  }

  /// The largest with which all names lie in the square, clear of the polygon.
  double radius_for_names() const {
    double radius = kRadius;
    if (name_size_ <= 0) return radius;
    const auto shrink = [&](std::size_t i, double out, double half_size) {
      constexpr double kAcross = 0.3;  // there is room in this direction
      if (out < kAcross) return;
      const double room = look_.half - half_size - distance_of_name(i) * out;
      radius = std::min(radius, room / (look_.half * out));
    };
    for (std::size_t i = 0; i < shell_.ring.size(); ++i) {
      shrink(i, std::abs(shell_.place(i).x()), half_width(i));
      shrink(i, std::abs(shell_.place(i).y()), half_height());
    }
    return radius;
  }

  /// Outside of its corner, so far that it is clear of the polygon, and inside of the square.
  Place middle_of_name(std::size_t i) const {
    const Eigen::Vector2d out = shell_.place(i);
    const double away = distance_of_name(i);
    const auto inside = [&](double middle, double at, double own) {
      const double most = std::max(look_.half - own, 0.0);
      return std::clamp(at, middle - most, middle + most);
    };
    const Place from = corner(i);
    return {inside(look_.middle.x, from.x + away * out.x(), half_width(i)),
            inside(look_.middle.y, from.y - away * out.y(), half_height())};
  }

  /// The number of the vertex, and below it p_i as the paper has it.
  std::array<Text, 3> name_of(std::size_t i) const {
    const double size = name_size_;
    Place middle = middle_of_name(i);
    middle.y -= half_height() - size / 2;
    Text number = figure::centred(middle, name_text(i), size, figure::Font::bold);
    Text letter{{}, "p", kPlaceSize * size, figure::Font::oblique};
    Text index{{}, fmt::format("{}", i + 1), kIndexSize * size};
    const double letter_width = figure::text_width(letter.text, letter.size, letter.font);
    const double width = letter_width + figure::text_width(index.text, index.size);
    letter.at = {middle.x - width / 2, number.at.y + kPlaceBelow * size};
    index.at = {letter.at.x + letter_width, letter.at.y + 0.15 * size};
    std::array<Text, 3> name = {std::move(number), std::move(letter), std::move(index)};
    for (Text& text : name) text.colour = look_.ink;
    return name;
  }

  figure::Colour colour_of(Quality quality, double opacity) const {
    return faint(tet_colour(quality, *look_.map), opacity);
  }

  void line(Place from, Place to, const Pen& pen, Meaning meaning) {
    lines_.emplace_back(figure::Stroke{{from, to}, pen}, std::move(meaning));
  }

  void number(std::string words, std::vector<Place> places, Meaning meaning = {}) {
    Text text{{}, std::move(words), look_.number_size};
    if (!meaning.is_nothing()) text.font = figure::Font::oblique;  // a name
    text.colour = look_.ink;
    text.patch = look_.patch;
    numbers_.push_back({std::move(text), std::move(places), std::move(meaning)});
  }

  /// Each side of the core with the edge ab, a tet, is a slice from its middle.
  void core(const FlatCovering& covering) {
    Place middle;
    for (const auto& side : covering.core) {
      const double share = 1.0 / static_cast<double>(covering.core.size());
      middle.x += share * corner(side.from).x;
      middle.y += share * corner(side.from).y;
    }
    number("ab", {middle}, {{shell_.a, shell_.b}, {}});
    for (const auto& side : covering.core) {
      std::vector<VertexHandle> tet = ends(side.from, side.to);
      tet.insert(tet.end(), {shell_.a, shell_.b});
      areas_.emplace_back(
          Area{{middle, corner(side.from), corner(side.to)}, colour_of(side.quality, 0.75), {}},
          Meaning{std::move(tet), {}});
      line(middle, corner(side.from), {faint(figure::kSupportingEdgeColour, 0.6), look_.line},
           {{shell_.a, shell_.b, shell_.ring[side.from]}, {}});
      const Place on_side = mix(corner(side.from), corner(side.to), 0.5);
      number(quality_number(side.quality), {mix(middle, on_side, 0.68), mix(middle, on_side, 0.8),
                                            mix(middle, on_side, 0.56), mix(middle, on_side, 0.9)});
    }
  }

  void triangle(const FlatCovering::Triangle& t, bool dashed) {
    std::array<Place, 3> c;
    std::vector<VertexHandle> vertices;
    for (unsigned i = 0; i < 3; ++i) {
      c[i] = corner(t.corners[i]);
      vertices.push_back(shell_.ring[t.corners[i]]);
    }
    areas_.emplace_back(Area{{c[0], c[1], c[2]}, colour_of(t.quality, dashed ? 0.35 : 0.75), {}},
                        Meaning{std::move(vertices), {}});
    Pen pen = pocket_pen(look_.line);
    pen.dashed = dashed;
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned j = (i + 1) % 3;
      line(c[i], c[j], pen, {ends(t.corners[i], t.corners[j]), {}});
    }
    const Place middle = mix(mix(c[0], c[1], 0.5), c[2], 1.0 / 3);
    std::vector<Place> places = {middle};
    for (const double away : {0.2, 0.35, 0.5, -0.15}) {
      for (const Place& p : c) places.push_back(mix(middle, p, away));
    }
    number(quality_number(t.quality), std::move(places));
  }

  void words(LinkedDrawing& all) {
    LabelPlacer placer;
    for (std::size_t i = 0; i < shell_.ring.size(); ++i) {
      for (Text& text : name_of(i)) {
        placer.occupy(figure::box_of(text));
        all.add(std::move(text), {{shell_.ring[i]}, {}});
      }
    }
    const std::array<double, 3> sizes = {look_.number_size, 0.79 * look_.number_size,
                                         0.64 * look_.number_size};
    for (Number& number : numbers_) {
      placer.place(all.drawing, std::move(number.text), number.places, sizes);
      all.meanings.push_back(std::move(number.meaning));
    }
  }

  const ShellPicture& shell_;
  const RingLook& look_;
  double name_size_;  // as it is, and on how many circles
  unsigned circles_ = 1;
  double radius_ = 0;  // of the polygon
  std::vector<std::pair<figure::Shape, Meaning>> areas_, lines_;
  std::vector<Number> numbers_;
};

}  // namespace

Pen skirt_pen(double line) {
  return {figure::kSkirtColour, 3 * line};
}

Pen pocket_pen(double line) {
  return {figure::kChordColour, 2 * line};
}

Pen core_pen(double line) {
  return {figure::kCoreColour, 4 * line};
}

Pen chord_pen(double line, bool is_better) {
  return {faint(figure::kChordColour, is_better ? 0.9 : 0.45), 1.5 * line, !is_better};
}

LinkedDrawing draw_polygon(const PolygonView& view, const RingLook& look) {
  const ShellPicture& shell = *view.shell;
  PolygonDrawer drawer(shell, look);
  switch (view.stage) {
    case PolygonStage::found:
      drawer.covering(*view.covering, true);
      break;
    case PolygonStage::made:
      drawer.covering(*view.covering, false);
      break;
    case PolygonStage::best_triangulation:
      drawer.chords();
      drawer.covering(shell.full, true);
      break;
    case PolygonStage::before:
    case PolygonStage::now:
      drawer.covering(shell.before, false);
      drawer.chords();
      break;
    case PolygonStage::earlier:
      drawer.covering(shell.before, false);
      break;
  }
  if (view.cell) drawer.cell(*view.cell);
  return drawer.finish();
}

}  // namespace tetmend::explain
