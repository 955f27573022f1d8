// SPDX-License-Identifier: MIT
// Another run beside the one that is looked at: both over one axis of time, and the same place in both.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "explain/outcome_look.h"
#include "kernel/grouped.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr Colour kThereColour{0, 114, 178};  // beside red also for who sees no red

/// When the event at hand happened, as calls and passes tell it.
double seconds_at(const TraceFile& file, std::uint64_t position) {
  double seconds = 0;
  const auto note = [&](const EventRange& events) {
    if (events.begin < position) seconds = std::max(seconds, events.begin_seconds);
    if (events.end <= position) seconds = std::max(seconds, events.end_seconds);
  };
  for (const TracedPass& pass : file.passes()) note(pass.events);
  const auto calls = file.calls();
  const auto after =
      std::upper_bound(calls.begin(), calls.end(), position,
                       [](std::uint64_t at, const Call& call) { return at <= call.events.begin; });
  if (after != calls.begin()) note((after - 1)->events);
  return seconds;
}

/// The end of the pass that had ended last by then.
std::uint64_t position_at(const TraceFile& file, double seconds) {
  std::uint64_t position = 0;
  for (const TracedPass& pass : file.passes()) {
    if (pass.events.end_seconds <= seconds) position = pass.events.end;
  }
  return position;
}

/// A rectangle with seconds from left to right and bad tets upwards.
struct Plot {
  ImVec2 corner, size;
  double seconds = 1;
  std::size_t most = 1;

  figure::Place place(double at, std::size_t n_bad) const {
    return {corner.x + size.x * at / seconds,
            corner.y + size.y * (1 - 0.9 * static_cast<double>(n_bad) / static_cast<double>(most))};
  }
};

/// The number holds until the next pass has ended: steps.
figure::Stroke curve_of(const std::vector<BadAtTime>& over, const Plot& plot,
                        const figure::Pen& pen) {
  figure::Stroke curve{{}, pen};
  for (const BadAtTime& each : over) {
    if (!curve.places.empty()) {
      curve.places.push_back({plot.place(each.seconds, 0).x, curve.places.back().y});
    }
    curve.places.push_back(plot.place(each.seconds, each.n_bad));
  }
  return curve;
}

std::string fate(const char* which, const std::vector<BadAtTime>& over) {
  return fmt::format("{} {} in {:.2f} s", which, grouped(over.back().n_bad), over.back().seconds);
}

/// A click goes to the pass that had ended by then.
void show_time(Session& session, const RunComparison& both) {
  constexpr float kLines = 4;
  const Debugger& debugger = *session.document.debugger();
  ImGui::TextUnformatted("bad tets:");
  ImGui::SameLine();
  coloured_text(kBadColour, fate("here", both.over_a));
  ImGui::SameLine();
  coloured_text(kThereColour, fate("there", both.over_b));
  Plot plot{ImGui::GetCursorScreenPos(),
            {ImGui::GetContentRegionAvail().x, kLines * ImGui::GetTextLineHeight()}};
  plot.seconds = std::max({both.over_a.back().seconds, both.over_b.back().seconds, 1e-9});
  for (const auto* over : {&both.over_a, &both.over_b}) {
    for (const BadAtTime& each : *over) plot.most = std::max(plot.most, each.n_bad);
  }
  ImGui::InvisibleButton("##time", plot.size);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(plot.corner, {plot.corner.x + plot.size.x, plot.corner.y + plot.size.y},
                      ImGui::GetColorU32(ImGuiCol_FrameBg));
  const double width = ImGui::GetFontSize() / 8;
  figure::Drawing drawing;
  drawing.shapes.emplace_back(curve_of(both.over_a, plot, {kBadColour, width, false}));
  drawing.shapes.emplace_back(curve_of(both.over_b, plot, {kThereColour, width, true}));
  const double now = plot.place(seconds_at(debugger.file(), debugger.position()), 0).x;
  const figure::Pen ink = {colour_of(ImGuiCol_Text), width, false};
  drawing.shapes.emplace_back(
      figure::Stroke{{{now, plot.corner.y}, {now, plot.corner.y + plot.size.y}}, ink});
  paint(drawing, *list);
  if (!ImGui::IsItemHovered()) return;
  const double at = plot.seconds * (ImGui::GetIO().MousePos.x - plot.corner.x) / plot.size.x;
  ImGui::SetTooltip("%.2f s", at);
  if (ImGui::IsMouseReleased(0)) {
    run_from_window(find_command("seek"), session, {position_at(debugger.file(), at)});
  }
}

/// A click looks at the place in both runs.
void list_pairs(Session& session, const OtherRun& other) {
  constexpr float kRows = 8;
  const auto& pairs = other.comparison().worse_in_a;
  std::optional<std::size_t> chosen;
  if (ImGui::BeginChild("##pairs", {0, kRows * ImGui::GetTextLineHeightWithSpacing()})) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(pairs.size()));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const TetPair& pair = pairs[static_cast<std::size_t>(i)];
        const std::string text = fmt::format("{:.4f} here, {:.4f} there: {}", pair.bad_quality,
                                             pair.good_quality, in_words(pair.bad));
        if (fitted_row(text, other.pair() == &pair)) chosen = static_cast<std::size_t>(i);
      }
    }
  }
  ImGui::EndChild();
  if (chosen) run_from_window(find_command("beside"), session, {*chosen});
}

/// The tet, through those with an edge of it; seen as the large picture is: what turns one turns all.
void show_place(const Document& document, const char* name, const std::vector<LocalTet>& tets,
                const Ball& ball, float side) {
  ImGui::BeginGroup();
  ImGui::Text("%s, with %zu around", name, tets.size() - 1);
  const ColourMap& map = find_colour_map(document.view.scene.map);
  const auto draw = [&](std::span<const LocalTet> some, double opacity) {
    paint(draw_tets(some, document.view.camera, ball, square_at_cursor(side), map, opacity).drawing,
          *ImGui::GetWindowDrawList());
  };
  constexpr double kAround = 0.25;
  draw(std::span(tets).subspan(1), kAround);
  draw(std::span(tets).first(1), 1);
  ImGui::Dummy({side, side});
  ImGui::EndGroup();
}

}  // namespace

void draw_other_run(Session& session) {
  const OtherRun& other = *session.document.debugger()->other();
  const RunComparison& both = other.comparison();
  wrapped_text(fmt::format(
      "Beside {}: {} tets are bad here, {} there. {} are bad here and good there, {} the other way "
      "round.",
      other.name().filename().string(), grouped(both.bad_in_a), grouped(both.bad_in_b),
      grouped(both.worse_in_a.size()), grouped(both.worse_in_b.size())));
  show_time(session, both);
  if (both.worse_in_a.empty() || !ImGui::TreeNode("bad here and good there")) return;
  list_pairs(session, other);
  ImGui::TreePop();
}

void draw_both_panel(Session& session) {
  constexpr float kShare = 0.44F;
  const Debugger& debugger = *session.document.debugger();
  const OtherRun& other = *debugger.other();
  const PlaceInBoth& place = *other.place();
  const TetPair& pair = *other.pair();
  wrapped_text(fmt::format("{}, quality {:.4f}, and there {}, quality {:.4f}, as the runs ended",
                           in_words(pair.bad), pair.bad_quality, in_words(pair.good),
                           pair.good_quality));
  const float width = ImGui::GetContentRegionAvail().x;
  show_place(session.document, "here", place.here, place.ball, kShare * width);
  ImGui::SameLine(0.5F * width);
  show_place(session.document, "there", place.there, place.ball, kShare * width);
  wrapped_text(fmt::format("there: {}", place.told));
}

}  // namespace tetmend::viewer::ui
