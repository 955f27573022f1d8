// SPDX-License-Identifier: MIT
// The skirt polygon of a call, before and after, side by side.
#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "explain/figures/figure_parts.h"
#include "explain/figures/figures.h"
#include "kernel/error.h"

namespace tetmend::explain {

using figure::Area;
using figure::Drawing;
using figure::faint;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kRadius = 0.76;  // of the polygon, in units of half a panel
constexpr double kNames = 0.88;   // of the circle on which the names of its corners are
constexpr Pen kSkirtPen{figure::kSkirtColour, 1.8};
constexpr Pen kPocketPen{figure::kChordColour, 1.3};
constexpr Pen kCorePen{figure::kCoreColour, 2.4};

/// One polygon. Areas, then lines, then words: finish() puts them on top of each other.
class RingPanel {
 public:
  RingPanel(const ShellPicture& shell, Place middle, double half)
      : shell_(shell), middle_(middle), half_(half) {}

  /// Those of a refused search are dashed where their pockets are no better than the old tets.
  void chords() {
    const std::vector<Chord> chords = chords_of(shell_);
    for (auto chord = chords.rbegin(); chord != chords.rend(); ++chord) {  // the best on top
      const bool is_better = chord->best()[0] > shell_.floor;
      line(corner(chord->from), corner(chord->to),
           {faint(figure::kChordColour, is_better ? 0.9 : 0.45), 1, !is_better});
    }
  }

  void covering(const FlatCovering& covering, bool dashed) {
    if (covering.core.size() >= 3) core(covering);
    for (const FlatCovering::Triangle& t : covering.triangles) triangle(t, dashed);
    for (const FlatCovering::Side& side : covering.core) {
      if (covering.triangles.empty()) continue;
      Pen pen = kCorePen;
      pen.dashed = dashed;
      line(corner(side.from), corner(side.to), pen);
    }
  }

  void finish(Drawing& drawing) {
    LabelPlacer placer;
    for (figure::Shape& area : areas_) drawing.add(std::move(area));
    for (std::size_t i = 0; i < shell_.ring.size(); ++i) {
      drawing.line(corner(i), corner((i + 1) % shell_.ring.size()), kSkirtPen);
    }
    for (figure::Shape& stroke : lines_) drawing.add(std::move(stroke));
    for (std::size_t i = 0; i < shell_.ring.size(); ++i) {
      Text name = figure::centred(on_circle(i, kNames), fmt::format("{}", shell_.ring[i].index()),
                                  kTextSize, figure::Font::bold);
      placer.occupy(figure::box_of(name));
      drawing.add(std::move(name));
    }
    constexpr std::array<double, 3> kSizes = {kNumberSize, 5.5, 4.5};
    for (Number& number : numbers_) {
      placer.place(drawing, std::move(number.text), number.places, kSizes);
    }
  }

 private:
  struct Number {
    Text text;
    std::vector<Place> places;
  };

  Place on_circle(std::size_t i, double radius) const {
    const Eigen::Vector2d at = shell_.place(i);
    return {middle_.x + half_ * radius * at.x(), middle_.y - half_ * radius * at.y()};
  }
  Place corner(std::size_t i) const { return on_circle(i, kRadius); }

  void line(Place from, Place to, const Pen& pen) {
    lines_.emplace_back(figure::Stroke{{from, to}, pen});
  }

  void number(Quality quality, std::vector<Place> places, bool is_name = false) {
    Text text{{}, is_name ? "ab" : quality_number(quality), kNumberSize};
    if (is_name) text.font = figure::Font::oblique;
    text.patch = {255, 255, 255, 200};
    numbers_.push_back({std::move(text), std::move(places)});
  }

  static Place mix(const Place& p, const Place& q, double t) {
    return {(1 - t) * p.x + t * q.x, (1 - t) * p.y + t * q.y};
  }

  /// Each side of the core with the edge ab, a tet, is a slice from its middle.
  void core(const FlatCovering& covering) {
    Place middle;
    for (const auto& side : covering.core) {
      const double share = 1.0 / static_cast<double>(covering.core.size());
      middle.x += share * corner(side.from).x;
      middle.y += share * corner(side.from).y;
    }
    number(0, {middle}, true);
    for (const auto& side : covering.core) {
      areas_.emplace_back(Area{
          {middle, corner(side.from), corner(side.to)}, faint(tet_colour(side.quality), 0.75), {}});
      line(middle, corner(side.from), {faint(figure::kSupportingEdgeColour, 0.6), 0.8});
      const Place on_side = mix(corner(side.from), corner(side.to), 0.5);
      number(side.quality, {mix(middle, on_side, 0.68), mix(middle, on_side, 0.8),
                            mix(middle, on_side, 0.56), mix(middle, on_side, 0.9)});
    }
  }

  void triangle(const FlatCovering::Triangle& t, bool dashed) {
    const std::array<Place, 3> c = {corner(t.corners[0]), corner(t.corners[1]),
                                    corner(t.corners[2])};
    areas_.emplace_back(
        Area{{c[0], c[1], c[2]}, faint(tet_colour(t.quality), dashed ? 0.35 : 0.75), {}});
    Pen pen = kPocketPen;
    pen.dashed = dashed;
    for (unsigned i = 0; i < 3; ++i) line(c[i], c[(i + 1) % 3], pen);
    const Place middle = mix(mix(c[0], c[1], 0.5), c[2], 1.0 / 3);
    std::vector<Place> places = {middle};
    for (const double away : {0.2, 0.35, 0.5, -0.15}) {
      for (const Place& p : c) places.push_back(mix(middle, p, away));
    }
    number(t.quality, std::move(places));
  }

  const ShellPicture& shell_;
  Place middle_;
  double half_;
  std::vector<figure::Shape> areas_, lines_;
  std::vector<Number> numbers_;
};

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// What stands below the panels.
std::string ring_notes(const TraceFile& file, const CallStudy& study) {
  const ShellPicture& shell = *study.picture;
  std::string text = fmt::format(
      "a = {}, b = {}; the skirt polygon has the numbers of its vertices, p_1 = {} on top, "
      "counterclockwise. A slice is a tet, a triangle a tet with a and one with b; the number is "
      "the quality of the worse.",
      shell.a.index(), shell.b.index(), shell.ring.front().index());
  if (const std::string locks = locks_text(shell); !locks.empty()) text += ' ' + locks;
  if (const std::string end = explain_end(file, study); !end.empty()) text += ' ' + end;
  return text;
}

std::vector<LegendEntry> ring_legend(const CallStudy& study, bool has_chords) {
  std::vector<LegendEntry> legend = {{kSkirtPen, "skirt polygon"}};
  if (has_chords) {
    legend.push_back({Pen{figure::kChordColour, 1}, "chord with a better pocket"});
    legend.push_back(
        {Pen{faint(figure::kChordColour, 0.45), 1, true}, "no better than the old tets"});
  }
  if (study.covering && !study.covering->triangles.empty()) {
    legend.push_back({kPocketPen, "triangle of a pocket"});
    if (!study.covering->core.empty()) legend.push_back({kCorePen, "side of the core"});
  }
  return legend;
}

}  // namespace

Drawing draw_ring(const TraceFile& file, const CallStudy& study) {
  if (!study.picture || study.picture->ring.size() < 3) {
    throw Error(fmt::format("call {} has no ring to draw: its target is no edge or face inside",
                            study.call));
  }
  const ShellPicture& shell = *study.picture;
  const bool refused = !file.calls()[study.call].accepted();
  const PolygonStage last = stage_of(study, file.event_count(), refused);
  std::vector<PolygonStage> stages = {PolygonStage::before};
  if (last != PolygonStage::before) stages.push_back(last);
  // Wide enough that the numbers of the slices have room.
  const double side = std::max(190.0, 13.5 * static_cast<double>(shell.ring.size()));
  constexpr double kBetween = 20;
  constexpr double kShare = 0.96;  // of the side that names and polygon take
  Drawing drawing;
  drawing.title = figure_title(file, study.call);
  drawing.width = figure_width(drawing.title, stages.size(), side, kBetween);
  const double inside = drawing.width - 2 * kMargin;
  const double top = add_paragraph(drawing, {kMargin, kMargin}, inside, drawing.title, kTitleSize,
                                   figure::Font::bold);
  double bottom = top;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const double left = kMargin + static_cast<double>(i) * (side + kBetween);
    RingPanel panel(shell, {left + side / 2, top + kShare * side / 2}, side / 2);
    const bool is_made = stages[i] == PolygonStage::made;
    if (stages[i] == PolygonStage::before) panel.covering(shell.before, false);
    if (!is_made) panel.chords();
    if (is_made) panel.covering(*study.covering, false);
    if (stages[i] == PolygonStage::best_triangulation) panel.covering(shell.full, true);
    panel.finish(drawing);
    bottom = std::max(bottom, add_paragraph(drawing, {left, top + kShare * side}, side,
                                            capitalised(caption_of(study, stages[i]))));
  }
  bottom = add_legend(drawing, {kMargin, bottom + 6}, inside,
                      ring_legend(study, !chords_of(shell).empty()));
  bottom = add_quality_bar(drawing, {kMargin, bottom + 4});
  bottom = add_paragraph(drawing, {kMargin, bottom + 2}, inside, ring_notes(file, study));
  drawing.height = bottom + kMargin;
  return drawing;
}

}  // namespace tetmend::explain
