// SPDX-License-Identifier: MIT
// The whole of a run: who was asked how often and how that ended; and the calls of a condition.
#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "explain/call_facts.h"
#include "kernel/grouped.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

/// A click lists the calls.
void count_cell(std::size_t count, const std::string& condition, std::string& chosen) {
  ImGui::TableNextColumn();
  if (count == 0) return ImGui::TextDisabled(" ");
  const std::string text = grouped(count);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::PushID(condition.c_str());
  if (ImGui::Selectable(text.c_str())) chosen = condition;
  ImGui::PopID();
  tooltip_below("lists: " + condition);
}

void number_cell(const std::string& text) {
  ImGui::TableNextColumn();
  right_aligned(text);
}

/// Nothing for 0, as count_cell() has it.
std::string some(std::size_t count) {
  return count == 0 ? std::string() : grouped(count);
}

/// The same row of the other run; null: it has none.
const LedgerRow* row_there(std::string_view name, const std::vector<LedgerRow>& rows) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const LedgerRow& row) { return row.operator_name == name; });
  return found == rows.end() ? nullptr : &*found;
}

/// "1,024 (+12)": what the other run had, and how much more that is.
std::string there_text(std::size_t here, std::size_t there) {
  const auto more = static_cast<std::int64_t>(there) - static_cast<std::int64_t>(here);
  return fmt::format("{} ({:+})", grouped(there), more);
}

void show_endings(const LedgerRow& row, const LedgerRow* there, std::string& chosen) {
  const auto all = static_cast<double>(std::max<std::size_t>(1, row.total().calls));
  for (std::size_t i = 0; i < kEndingCount; ++i) {
    const LedgerCell& cell = row.cells[i];
    if (cell.calls == 0 && (there == nullptr || there->cells[i].calls == 0)) continue;
    const auto ending = static_cast<CallEnding>(i);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Indent();
    const std::string name(name_of(ending));
    ImGui::TextUnformatted(in_lines(name, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::Unindent();
    tooltip_below(std::string(kEndingWords[i].reason));
    count_cell(cell.calls,
               fmt::format("operator {} and ending {}", row.operator_name, word_of(ending)),
               chosen);
    number_cell(fmt::format("{:.1f} %", 100 * static_cast<double>(cell.calls) / all));
    number_cell(fmt::format("{:.3f} s", cell.seconds));
    number_cell(there == nullptr ? "" : there_text(cell.calls, there->cells[i].calls));
  }
}

/// Its name, whole, in two lines where there is no room for one. True: unfolded.
bool show_operator(const std::string& name) {
  const ImVec2 padding = {0.1F * ImGui::GetFontSize(), ImGui::GetStyle().FramePadding.y};
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::GetTreeNodeToLabelSpacing();
  const bool is_unfolded = ImGui::TreeNodeEx(name.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen,
                                             "%s", in_lines(short_name(name), room).c_str());
  ImGui::PopStyleVar();
  tooltip_below(name);
  return is_unfolded;
}

/// Rows of operators, who refused most first; unfolded, a row for each way to end.
void show_ledger_rows(Debugger& debugger, std::string& chosen) {
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg;
  const ImVec2 padding = {0.2F * ImGui::GetFontSize(), ImGui::GetStyle().CellPadding.y};
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, padding);  // names have the room
  const bool is_open = ImGui::BeginTable("##ledger", 5, kLooks);
  ImGui::PopStyleVar();
  if (!is_open) return;
  std::vector<LedgerRow> rows = debugger.ledger().by_operator();
  std::stable_sort(rows.begin(), rows.end(), [](const LedgerRow& a, const LedgerRow& b) {
    return a.refused().calls > b.refused().calls;
  });
  ImGui::TableSetupColumn("operator", ImGuiTableColumnFlags_WidthStretch);
  std::size_t most = 0;
  std::vector<LedgerRow> other;
  if (debugger.other() != nullptr) other = debugger.other()->comparison().b.by_operator();
  for (const auto* of_run : {&rows, &other}) {
    for (const LedgerRow& row : *of_run) most = std::max(most, row.total().calls);
  }
  const std::string longest = grouped(most);
  for (const char* title : {"calls", "for good", "undone", "refused"}) {
    const float width =
        std::max(ImGui::CalcTextSize(longest.c_str()).x, ImGui::CalcTextSize(title).x);
    ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthFixed, width);
  }
  headers_row(1);
  for (const LedgerRow& row : rows) {
    const std::string name(row.operator_name);
    const LedgerRow* there = row_there(name, other);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool is_unfolded = show_operator(name);
    const std::string of = fmt::format("operator {}", name);
    count_cell(row.total().calls, of, chosen);
    count_cell(row.cell(CallEnding::for_good).calls, of + " and accepted for good", chosen);
    count_cell(row.cell(CallEnding::undone).calls, of + " and undone", chosen);
    count_cell(row.refused().calls, of + " and refused", chosen);
    if (there != nullptr) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("    there");
      number_cell(some(there->total().calls));
      number_cell(some(there->cell(CallEnding::for_good).calls));
      number_cell(some(there->cell(CallEnding::undone).calls));
      number_cell(some(there->refused().calls));
    }
    if (is_unfolded) show_endings(row, there, chosen);
  }
  ImGui::EndTable();
}

void show_nearness(const LedgerRow& all) {
  wrapped_text(fmt::format(
      "Of the refused, {} lacked less than {} in the quality of their worst tet; in {} it was good "
      "enough, and others were not; in {} {}.",
      grouped(all.nearness[1] + all.nearness[2]), kNearness[1], grouped(all.nearness[0]),
      grouped(all.nearness.back()), kNothingCompared));
}

constexpr const char* kLacking = "lacking";

/// In a narrow column: a number, or a word that explain_lacking() explains.
std::string lacking_text(const Call& call) {
  if (call.accepted()) return {};
  return call.has_qualities() || !call.verdict ? call.missing_in_words() : "-";
}

/// What the words of the list mean, where it has them: the nearest come first.
void explain_lacking(const TraceFile& file, const std::vector<std::uint32_t>& found) {
  if (found.empty()) return;
  const Call& first = file.calls()[found.front()];
  const Call& last = file.calls()[found.back()];
  std::string text = "lacking: in the quality of the worst tet";
  if (lacking_text(first) == "others") {
    text += "; others: it was good enough, others were not";
  }
  if (lacking_text(last) == "-") text += fmt::format("; -: {}", kNothingCompared);
  wrapped_text(text);
}

void show_found_row(Session& session, std::uint32_t number) {
  const Debugger& debugger = *session.document.debugger();
  const Call& call = debugger.file().calls()[number];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  show_mark(outcome_of(call));
  ImGui::SameLine();
  ImGui::PushID(static_cast<int>(number));
  const std::string name = short_name(debugger.file(), call);
  if (fitted_row(fmt::format("{} {} {}", number, name, numbers_of(call)), debugger.call() == number,
                 ImGuiSelectableFlags_SpanAllColumns)) {
    run_from_window(find_command("enter"), session, {number});
  }
  if (ImGui::IsItemHovered()) {
    session.document.hovering = session.document.pointed_call(number);
    tooltip_below(fmt::format("{} {} {}: {}\n{}", number, name, format_target(call),
                              call.verdict_in_words(), debugger.file().reason(call)));
  }
  ImGui::PopID();
  number_cell(lacking_text(call));
}

}  // namespace

void draw_ledger_panel(Session& session) {
  Debugger& debugger = *session.document.debugger();
  const LedgerRow& all = debugger.ledger().all;
  wrapped_text(
      fmt::format("{} calls: {} accepted for good, {} accepted and undone with a caller, "
                  "{} refused. {} of {} edits lasted.",
                  grouped(all.total().calls), grouped(all.cell(CallEnding::for_good).calls),
                  grouped(all.cell(CallEnding::undone).calls), grouped(all.refused().calls),
                  grouped(debugger.ledger().lasting), grouped(debugger.ledger().edits)));
  if (debugger.other() != nullptr) draw_other_run(session);
  std::string chosen;
  show_ledger_rows(debugger, chosen);
  show_nearness(all);
  if (ImGui::SmallButton(debugger.other() != nullptr ? "another run ..."
                                                     : "beside another run ...")) {
    run_from_window(find_command("against"), session);
  }
  if (chosen.empty()) return;
  debugger.typed_condition = chosen;
  run_from_window(find_command("list_calls"), session, {chosen});
}

void draw_found_panel(Session& session) {
  Debugger& debugger = *session.document.debugger();
  const FoundCalls& found = *debugger.found();
  const bool is_over = ImGui::SmallButton("x");
  ImGui::SameLine();
  wrapped_text(fmt::format("{}: {} calls, the nearest to being accepted first",
                           to_text(found.condition), grouped(found.calls.size())));
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  constexpr float kRows = 8;
  if (ImGui::BeginTable("##found", 2, kLooks, {0, kRows * ImGui::GetTextLineHeightWithSpacing()})) {
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("call", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn(kLacking, ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize(kLacking).x);
    headers_row(1);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(found.calls.size()));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        show_found_row(session, found.calls[static_cast<std::size_t>(i)]);
      }
    }
    ImGui::EndTable();
    explain_lacking(debugger.file(), found.calls);
  }
  if (is_over) debugger.forget_found();
}

}  // namespace tetmend::viewer::ui
