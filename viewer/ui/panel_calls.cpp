// SPDX-License-Identifier: MIT
// The tree of calls: level, target, degree, quality, and how each ended, as a mark.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "explain/outcome_look.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

/// How the call has ended here: what is to come is not told.
void show_mark_here(const Debugger& debugger, const Call& call) {
  if (debugger.position() <= call.events.begin) {
    return ImGui::Dummy({ImGui::GetFontSize(), ImGui::GetFontSize()});
  }
  show_mark(debugger.position() >= call.events.end ? outcome_of(call) : Outcome::unfinished);
}

/// Of "5 -> 4" what is so now, while the call is under way.
std::string until_now(const std::string& text, bool is_done) {
  return is_done ? text : text.substr(0, text.find(" -> "));
}

/// Pointed at, or its target is.
bool is_lit(const Pointed& pointed, std::uint32_t number, const Call& call) {
  if (pointed.call != kNoCall) return pointed.call == number;
  return pointed.vertices.size() == call.target_size && pointed.contains(call.target());
}

/// The marks, in rows of three.
void explain_marks() {
  constexpr std::array<std::pair<Outcome, const char*>, kOutcomeCount> kMeanings = {
      {{Outcome::accepted, "for good"},
       {Outcome::undone, "undone later"},
       {Outcome::rejected, "tried, undone"},
       {Outcome::no_improvement, "nothing better"},
       {Outcome::limit, "limit reached"},
       {Outcome::constrained, "constrained"},
       {Outcome::not_applicable, "not applicable"},
       {Outcome::deferred, "deferred"},
       {Outcome::unfinished, "under way"}}};
  const float width = ImGui::GetContentRegionAvail().x / 3;
  for (std::size_t i = 0; i < kMeanings.size(); ++i) {
    if (i % 3 != 0)
      ImGui::SameLine(width * static_cast<float>(i % 3) + ImGui::GetCursorStartPos().x);
    show_mark(kMeanings[i].first);
    ImGui::SameLine(0, 0.2F * ImGui::GetFontSize());
    ImGui::TextUnformatted(kMeanings[i].second);
  }
}

void draw_row(Session& session, const CallRow& row) {
  Debugger& debugger = *session.document.debugger();
  const Call& call = debugger.file().calls()[row.call];
  ImGui::PushID(static_cast<int>(row.call));
  ImGui::TableNextRow();
  if (is_lit(session.document.pointed(), row.call, call)) {
    Colour light = kPointedColour;
    light.alpha = 110;
    ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, to_imgui(light));
  }
  ImGui::TableNextColumn();
  const float step = 0.5F * ImGui::GetFontSize();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + step * static_cast<float>(row.indent));
  if (row.has_children) {
    if (ImGui::SmallButton(row.is_open ? "-" : "+")) debugger.fold(row.call);
  } else if (row.indent > 0) {  // calls of one level stand below each other
    const float sign = ImGui::CalcTextSize("+").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::Dummy({sign, ImGui::GetTextLineHeight()});
  }
  if (row.has_children || row.indent > 0) ImGui::SameLine(0, 0.3F * ImGui::GetFontSize());
  show_mark_here(debugger, call);
  ImGui::SameLine(0, 0.2F * ImGui::GetFontSize());
  const std::string name =
      fmt::format("{} {} {}", call.level, short_name(debugger.file(), call), numbers_of(call));
  if (fitted_row(name, debugger.call() == row.call,
                 ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap)) {
    run_from_window(find_command("enter"), session, {row.call});
  }
  if (ImGui::IsItemHovered()) {
    session.document.hovering = session.document.pointed_call(row.call);
    const std::string tried =
        call.accepted() || call.worst_before == 0 || debugger.position() < call.events.end
            ? ""
            : fmt::format("\ntried: {:.4f} -> {:.4f}", call.worst_before, call.worst_after);
    ImGui::SetTooltip("%s\ncall %u, %s%s", name.c_str(), row.call,
                      outcome_text(call, debugger.position()).c_str(), tried.c_str());
  }
  const CallFacts& facts = debugger.facts(row.call);
  const bool is_done = debugger.position() >= call.events.end;
  for (const std::string& text : {degree_text(facts), quality_text(call, facts)}) {
    ImGui::TableNextColumn();
    right_aligned(until_now(text, is_done));
  }
  ImGui::PopID();
}

/// Keeps the row of the call at hand in view after a step.
void scroll_to(const std::vector<CallRow>& rows, const Debugger& debugger) {
  const auto here = static_cast<int>(debugger.position());
  int* shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("##shown"), -1);
  if (*shown == here) return;
  *shown = here;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].call != debugger.call()) continue;
    const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    const float top = height * static_cast<float>(i);
    if (top < ImGui::GetScrollY() ||
        top > ImGui::GetScrollY() + ImGui::GetWindowHeight() - 3 * height) {
      ImGui::SetScrollY(top - ImGui::GetWindowHeight() / 3);
    }
  }
}

/// Leaves room in the column for what stands below, so that the ring of the panel Shell is in sight.
float table_height() {
  constexpr float kLeastRows = 7;
  constexpr float kMostRows = 22;
  const float row = ImGui::GetTextLineHeightWithSpacing();
  const float frame = ImGui::GetFrameHeightWithSpacing();
  constexpr float kHeadings = 5;     // of panels
  constexpr float kRunToFrames = 4;  // place, two rows of buttons, checkboxes
  const float below = 3 * row + (kHeadings + kRunToFrames) * frame + row +
                      kRingShare * ImGui::GetContentRegionAvail().x + frame +
                      (kChordRows + 1) * row;
  const float room = ImGui::GetWindowHeight() - ImGui::GetCursorPosY() - below;
  return std::clamp(room, kLeastRows * row, kMostRows * row);
}

/// The longest numbers of the rows that are in sight: what they leave is for the names. In the table.
std::pair<std::string, std::string> longest_numbers(Debugger& debugger,
                                                    const std::vector<CallRow>& rows) {
  const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const auto first = static_cast<std::size_t>(ImGui::GetScrollY() / height);
  const auto count = static_cast<std::size_t>(ImGui::GetWindowHeight() / height) + 1;
  std::pair<std::string, std::string> longest;
  for (std::size_t i = first; i < std::min(first + count, rows.size()); ++i) {
    const CallRow& row = rows[i];
    const Call& call = debugger.file().calls()[row.call];
    const CallFacts& facts = debugger.facts(row.call);
    const auto take = [](std::string& most, const std::string& text) {
      if (text.size() > most.size()) most = text;
    };
    const bool is_done = debugger.position() >= call.events.end;
    take(longest.first, until_now(degree_text(facts), is_done));
    take(longest.second, until_now(quality_text(call, facts), is_done));
  }
  return longest;
}

void list_rows(Session& session, float height) {
  Debugger& debugger = *session.document.debugger();
  const std::vector<CallRow>& rows = debugger.rows();
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  if (!ImGui::BeginTable("##calls", 3, kLooks, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("level, operator, target", ImGuiTableColumnFlags_WidthStretch);
  const auto [degree, quality] = longest_numbers(debugger, rows);
  number_column("degree", degree);
  number_column("worst q", quality);
  headers_row(1);
  scroll_to(rows, debugger);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      draw_row(session, rows[static_cast<std::size_t>(i)]);
    }
  }
  ImGui::EndTable();
}

}  // namespace

void draw_calls_panel(Session& session) {
  list_rows(session, table_height() + spare_room());
  explain_marks();
}

namespace {

/// What the rows of a small tree need, so that no name is cut.
float width_of_tree(Debugger& debugger) {
  constexpr float kBeside = 3.4F;  // the sign to unfold, the mark, gaps; in sizes of the text
  constexpr float kIndent = 0.5F;
  const float font = ImGui::GetFontSize();
  float names = 0, degrees = 0, qualities = 0;
  const auto take = [](float& most, const std::string& text) {
    most = std::max(most, ImGui::CalcTextSize(text.c_str()).x);
  };
  for (const CallRow& row : debugger.rows()) {
    const Call& call = debugger.file().calls()[row.call];
    const CallFacts& facts = debugger.facts(row.call);
    float name = 0;
    take(name,
         fmt::format("{} {} {}", call.level, short_name(debugger.file(), call), numbers_of(call)));
    names = std::max(names, name + (kBeside + kIndent * static_cast<float>(row.indent)) * font);
    take(degrees, degree_text(facts));
    take(qualities, quality_text(call, facts));
  }
  take(degrees, "degree");
  return names + degrees + qualities + 6 * ImGui::GetStyle().CellPadding.x;
}

}  // namespace

void draw_tree(Session& session) {
  constexpr std::size_t kFew = 40;
  constexpr float kLeast = 0.6F;
  Debugger& debugger = *session.document.debugger();
  ImGui::SetWindowFontScale(1);
  if (debugger.rows().size() <= kFew) {
    const float share = ImGui::GetContentRegionAvail().x / width_of_tree(debugger);
    ImGui::SetWindowFontScale(std::clamp(share, kLeast, 1.0F));
  }
  list_rows(session, ImGui::GetContentRegionAvail().y);
}

}  // namespace tetmend::viewer::ui
