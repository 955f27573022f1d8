// SPDX-License-Identifier: MIT
// The skirt polygon of a call, before and after, side by side.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "explain/figures/figure_parts.h"
#include "explain/figures/figures.h"
#include "explain/figures/ring_drawing.h"
#include "kernel/error.h"

namespace tetmend::explain {

using figure::Drawing;

namespace {

constexpr double kLine = 0.6;  // points: see RingLook::line

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
  const std::string end = explain_end(file, study);
  const std::string locks = locks_text(shell);
  if (end.find(locks) == std::string::npos) text += ' ' + locks;  // once
  if (!end.empty()) text += ' ' + end;
  return text;
}

std::vector<LegendEntry> ring_legend(const CallStudy& study, bool has_chords) {
  std::vector<LegendEntry> legend = {{skirt_pen(kLine), "skirt polygon"}};
  if (has_chords) {
    legend.push_back({chord_pen(kLine, true), "chord with a better pocket"});
    legend.push_back({chord_pen(kLine, false), "no better than the old tets"});
  }
  if (study.covering && !study.covering->triangles.empty()) {
    legend.push_back({pocket_pen(kLine), "triangle of a pocket"});
    if (!study.covering->core.empty()) legend.push_back({core_pen(kLine), "side of the core"});
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
  const Call& call = file.calls()[study.call];
  const bool refused = !call.accepted() && call.has_searched();
  std::vector<PolygonView> stages = {polygon_at(study, 0, false)};
  if (study.covering) stages.push_back(polygon_at(study, study.first_edit, false));
  PolygonView last = polygon_at(study, file.event_count(), refused);
  const bool is_seen = last.stage == PolygonStage::before || last.stage == PolygonStage::earlier ||
                       (study.covering && last.covering == &*study.covering);
  if (!is_seen) stages.push_back(std::move(last));
  // Wide enough that the numbers of the slices have room.
  const double side = std::max(190.0, 13.5 * static_cast<double>(shell.ring.size()));
  constexpr double kBetween = 20;
  constexpr double kShare = 1.03;  // of the side that names and polygon take, with a gap below
  Drawing drawing;
  drawing.title = figure_title(file, study.call);
  drawing.width = figure_width(drawing.title, stages.size(), side, kBetween);
  const double inside = drawing.width - 2 * kMargin;
  const double top = add_paragraph(drawing, {kMargin, kMargin}, inside, drawing.title, kTitleSize,
                                   figure::Font::bold);
  double bottom = top;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const double left = kMargin + static_cast<double>(i) * (side + kBetween);
    RingLook look;
    look.middle = {left + side / 2, top + kShare * side / 2};
    look.half = side / 2;
    look.name_size = kTextSize;
    look.number_size = kNumberSize;
    look.line = kLine;
    LinkedDrawing panel = draw_polygon(stages[i], look);
    for (figure::Shape& shape : panel.drawing.shapes) drawing.add(std::move(shape));
    bottom = std::max(bottom, add_paragraph(drawing, {left, top + kShare * side}, side,
                                            capitalised(stages[i].caption)));
  }
  bottom = add_legend(drawing, {kMargin, bottom + 6}, inside,
                      ring_legend(study, !chords_of(shell).empty()));
  bottom = add_quality_bar(drawing, {kMargin, bottom + 4});
  bottom = add_paragraph(drawing, {kMargin, bottom + 2}, inside, ring_notes(file, study));
  drawing.height = bottom + kMargin;
  return drawing;
}

}  // namespace tetmend::explain
