// SPDX-License-Identifier: MIT
// Live mode: schedule, parameters, buttons, and how far the run has come.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "kernel/error.h"
#include "kernel/grouped.h"
#include "kernel/spaced.h"
#include "viewer/live/operator_schedule.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/parameter_field.h"
#include "viewer/ui/slider.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr const char* kTraceFile = "tetmend-live.trace";

/// Runs `work`; an error becomes the message of the document.
template <class Work>
void carefully(Document& document, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    document.message = {error.what(), true};
  }
}

void choose_schedule(Document& document) {
  LiveRun& live = document.live;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##schedule", live.schedule_name().c_str())) return;
  for (const std::string_view name : builtin_schedule_names()) {
    if (ImGui::Selectable(name.data(), live.schedule_name() == name)) {
      carefully(document, [&] { live.choose_schedule(std::string(name)); });
    }
  }
  for (const std::string& name : live.plugin_operators()) {
    const std::string schedule = std::string(kOperatorPrefix) + name;
    if (ImGui::Selectable(schedule.c_str(), live.schedule_name() == schedule)) {
      carefully(document, [&] { live.choose_schedule(schedule); });
    }
  }
  if (ImGui::Selectable("a file ...")) document.question = FileQuestion::schedule;
  ImGui::EndCombo();
}

/// The new value, or nothing.
std::string edit_number(const ScheduleParameter& parameter, const std::string& text) {
  constexpr double kWide = 100;  // no slider for ranges beyond that
  const std::string field = name_field(parameter.name);
  const char* name = field.c_str();
  double value = std::stod(text);
  bool changed = false;
  if (parameter.kind == ScheduleParameter::Kind::integer) {
    auto whole = static_cast<std::int64_t>(value);
    const auto low = static_cast<std::int64_t>(parameter.low);
    const auto high = static_cast<std::int64_t>(parameter.high);
    constexpr std::int64_t kStep = 1;
    changed = parameter.high - parameter.low > kWide
                  ? ImGui::InputScalar(name, ImGuiDataType_S64, &whole, &kStep)
                  : slider(name, ImGuiDataType_S64, &whole, &low, &high, "%lld",
                           ImGuiSliderFlags_AlwaysClamp);
    value = static_cast<double>(whole);
  } else {
    changed = parameter.high - parameter.low > kWide
                  ? ImGui::InputDouble(name, &value)
                  : slider(name, ImGuiDataType_Double, &value, &parameter.low, &parameter.high,
                           "%.3g", ImGuiSliderFlags_AlwaysClamp);
  }
  if (!changed) return {};
  return fmt::format("{}", std::clamp(value, parameter.low, parameter.high));
}

std::string edit_flag(const ScheduleParameter& parameter, const std::string& text) {
  bool on = text == "true";
  if (!ImGui::Checkbox(name_field(parameter.name).c_str(), &on)) return {};
  return on ? "true" : "false";
}

std::string edit_choice(const ScheduleParameter& parameter, const std::string& text) {
  std::string chosen;
  if (!ImGui::BeginCombo(name_field(parameter.name).c_str(), text.c_str())) return chosen;
  for (const std::string& choice : parameter.choices) {
    if (ImGui::Selectable(choice.c_str(), choice == text)) chosen = choice;
  }
  ImGui::EndCombo();
  return chosen;
}

void edit_parameter(Document& document, const ScheduleParameter& parameter) {
  using Kind = ScheduleParameter::Kind;
  const std::string text = document.live.value_of(parameter);
  const std::string value = parameter.kind == Kind::flag     ? edit_flag(parameter, text)
                            : parameter.kind == Kind::choice ? edit_choice(parameter, text)
                                                             : edit_number(parameter, text);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s: %s\n%s; default %s", parameter.name.c_str(), parameter.help.c_str(),
                      parameter.range().c_str(), parameter.initial_text().c_str());
  }
  if (!value.empty()) carefully(document, [&] { document.live.set(parameter.name, value); });
}

void edit_parameters(Document& document) {
  for (const ScheduleParameter& parameter : document.live.info().parameters) {
    edit_parameter(document, parameter);
  }
  bool record = !document.live.trace.empty();
  if (ImGui::Checkbox("record", &record)) document.live.trace = record ? kTraceFile : "";
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the next run, into the file %s", kTraceFile);
}

/// Runs a command, as its key does.
void button(Session& session, const char* text, std::string_view command) {
  const Command& what = find_command(command);
  if (ImGui::Button(text)) run_from_window(what, session);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s (%s)", what.help.data(), what.keys.data());
  ImGui::SameLine();
}

void buttons_after_run(Session& session) {
  if (ImGui::Button("Run on")) {
    carefully(session.document, [&] { session.document.run_live(LiveRun::From::shown); });
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("from the mesh that is shown");
  ImGui::SameLine();
  button(session, "Debug this run", "live_debug");
}

void buttons(Session& session, LiveState state) {
  const bool is_held = state == LiveState::paused;
  if (is_held || state == LiveState::running || state == LiveState::stopping) {
    if (is_held) {
      button(session, "Go on", "live_continue");
    } else {
      button(session, "Pause", "live_pause");
    }
    button(session, "Call", "live_step_call");
    button(session, "Change", "live_step");
    button(session, "Pass", "live_step_pass");
    ImGui::NewLine();
    button(session, "Stop", "live_stop");
    if (is_held) button(session, "Debug", "live_debug");
  } else {
    button(session, "Run", "live_run");
    if (session.document.live.input() != nullptr) buttons_after_run(session);
    ImGui::NewLine();
    button(session, "Start paused", "live_start");
  }
  ImGui::NewLine();
}

void tell_progress(const LiveProgress& run) {
  if (run.state == LiveState::idle) return;
  const std::string state(to_string(run.state));
  wrapped_text(fmt::format("{}, {:.1f} s, {} of {} calls accepted", state, run.seconds,
                           grouped(run.accepted), grouped(run.attempts)));
  const bool is_at_work = run.state == LiveState::running || run.state == LiveState::paused ||
                          run.state == LiveState::stopping;
  if (is_at_work) {
    const std::string phase = fmt::format("{} {}", run.round, spaced(run.phase));
    ImGui::ProgressBar(static_cast<float>(run.share), {-1, 0}, phase.c_str());
  }
  if (!run.breakpoint.empty()) ImGui::TextWrapped("breakpoint: %s", run.breakpoint.c_str());
  if (run.state == LiveState::paused && run.last) {
    const LiveCall& call = *run.last;
    std::string text = fmt::format("call {}, {}{}", call.number, call.is_inside ? "in it " : "",
                                   spaced(call.operator_name));
    if (call.is_inside) text += fmt::format(" on level {}", call.level);
    if (call.is_under_way) {
      text += " begins";
    } else {
      text += fmt::format(": {}, worst {:.4f}, now {:.4f}", to_string(call.verdict), call.before,
                          call.after);
    }
    wrapped_text(fmt::format("{}, at {:.4g} {:.4g} {:.4g}", text, call.place.x(), call.place.y(),
                             call.place.z()));
  }
  if (!run.error.empty()) ImGui::TextWrapped("%s", run.error.c_str());
  if (!run.notes.empty()) ImGui::TextWrapped("%s", run.notes.back().c_str());
}

/// One value at the beginning and one after each pass.
template <class Value>
void draw_curve(const char* name, const LiveProgress& run, const Value& value) {
  std::vector<float> values = {static_cast<float>(value(run.before))};
  for (const LivePass& pass : run.passes) values.push_back(static_cast<float>(value(pass.after)));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  ImGui::PlotLines(name, values.data(), static_cast<int>(values.size()), 0, nullptr, *least, *most,
                   {ImGui::GetContentRegionAvail().x, 2 * ImGui::GetFontSize()});
}

void draw_run_curves(const LiveProgress& run) {
  if (run.passes.empty()) return;
  const QualityIndicators& last = run.passes.back().after;
  ImGui::TextDisabled("bad tets, logarithmic: %zu, now %zu", run.before.n_bad, last.n_bad);
  draw_curve("##bad", run,
             [](const QualityIndicators& q) { return std::log1p(static_cast<double>(q.n_bad)); });
  ImGui::TextDisabled("worst quality: %.4f, now %.4f", run.before.q_worst, last.q_worst);
  draw_curve("##worst", run, [](const QualityIndicators& q) { return q.q_worst; });
}

/// The last pass first.
void list_passes(const LiveProgress& run) {
  constexpr ImGuiTableFlags kLooks = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  if (run.passes.empty()) return;
  const float height = 8 * ImGui::GetTextLineHeightWithSpacing();
  if (!ImGui::BeginTable("##passes", 4, kLooks, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
  std::size_t most = 0;
  double longest = 0;
  for (const LivePass& pass : run.passes) {
    most = std::max(most, pass.after.n_bad);
    longest = std::max(longest, pass.seconds);
  }
  number_column("bad", grouped(most));
  number_column("worst", "0.0000");
  number_column("s", fmt::format("{:.2f}", longest));
  headers_row(1);
  for (auto pass = run.passes.rbegin(); pass != run.passes.rend(); ++pass) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Text("%u %s", pass->round, spaced(pass->name).c_str());
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("round %u, %s\n%zu of %zu calls accepted", pass->round, pass->name.c_str(),
                        pass->accepted, pass->attempts);
    }
    ImGui::TableNextColumn();
    right_aligned(grouped(pass->after.n_bad));
    ImGui::TableNextColumn();
    right_aligned(fmt::format("{:.4f}", pass->after.q_worst));
    ImGui::TableNextColumn();
    right_aligned(fmt::format("{:.2f}", pass->seconds));
  }
  ImGui::EndTable();
}

/// How a run is watched: speed, camera, breakpoints.
void watch(Session& session) {
  LiveRun& live = session.document.live;
  const float none = 0;
  const float most = 100;
  auto speed = static_cast<float>(live.speed());
  const char* text = speed > 0 ? nullptr : "at once";
  if (slider(name_field("changes a second").c_str(), ImGuiDataType_Float, &speed, &none, &most,
             "%.1f", ImGuiSliderFlags_Logarithmic, text)) {
    carefully(session.document, [&] { live.set_speed(speed < 0.1F ? 0 : speed); });
  }
  ImGui::Checkbox("the camera goes to each change", &session.document.follow_changes_live);
  static std::string typed;
  ImGui::SetNextItemWidth(-6 * ImGui::GetFontSize());
  const bool is_entered = ImGui::InputTextWithHint("##breakpoint", "edge 3 17 and refused", &typed,
                                                   ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if (ImGui::Button("breakpoint") || is_entered) {
    run_from_window(find_command("breakpoint"), session, {typed});
  }
  std::size_t gone = live.breakpoints.size();
  for (std::size_t i = 0; i < live.breakpoints.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Checkbox(to_text(live.breakpoints[i].condition).c_str(), &live.breakpoints[i].on)) {
      live.tell_breakpoints();
    }
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 1.5F * ImGui::GetFontSize());
    if (ImGui::SmallButton("x")) gone = i;
    ImGui::PopID();
  }
  if (gone == live.breakpoints.size()) return;
  live.breakpoints.erase(live.breakpoints.begin() + static_cast<std::ptrdiff_t>(gone));
  live.tell_breakpoints();
}

}  // namespace

void draw_live_panel(Session& session) {
  choose_schedule(session.document);
  edit_parameters(session.document);
  const LiveProgress run = session.document.live.progress();
  buttons(session, run.state);
  if (session.document.debugger() == nullptr || session.document.debugs_live()) watch(session);
  tell_progress(run);
  draw_run_curves(run);
  list_passes(run);
}

}  // namespace tetmend::viewer::ui
