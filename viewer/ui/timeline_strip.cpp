// SPDX-License-Identifier: MIT
#include "viewer/ui/timeline_strip.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "explain/icicle.h"
#include "explain/outcome_look.h"
#include "kernel/grouped.h"
#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/drawing_canvas.h"

namespace tetmend::viewer::ui {

namespace {

/// A rectangle of the strip, with events from left to right.
struct Band {
  ImVec2 corner;
  ImVec2 size;
  double begin = 0, end = 1;

  float x(std::uint64_t position) const {
    const double share = (static_cast<double>(position) - begin) / std::max(end - begin, 1.0);
    return corner.x + size.x * static_cast<float>(std::clamp(share, 0.0, 1.0));
  }
  float y(double share) const {
    return corner.y + size.y * static_cast<float>(1 - std::clamp(share, 0.0, 1.0));
  }
  std::uint64_t position(float at) const {
    const double share = std::clamp((at - corner.x) / std::max(size.x, 1.0F), 0.0F, 1.0F);
    return static_cast<std::uint64_t>(std::llround(begin + share * (end - begin)));
  }
};

void frame(const Band& band) {
  ImGui::GetWindowDrawList()->AddRectFilled(
      band.corner, {band.corner.x + band.size.x, band.corner.y + band.size.y},
      ImGui::GetColorU32(ImGuiCol_FrameBg));
}

void cursor_line(const Band& band, std::uint64_t position) {
  const float x = band.x(position);
  ImGui::GetWindowDrawList()->AddLine({x, band.corner.y}, {x, band.corner.y + band.size.y},
                                      ImGui::GetColorU32(ImGuiCol_Text), 2);
}

/// Text only where there is room for it.
void write_inside(float left, float right, float y, const std::string& text, ImU32 colour) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  if (size.x + 6 < right - left) {
    ImGui::GetWindowDrawList()->AddText({left + 3, y}, colour, text.c_str());
  }
}

void draw_passes(const Band& band, const TraceFile& file) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  bool is_odd = false;
  for (const TracedPass& pass : file.passes()) {
    const float left = band.x(pass.events.begin);
    const float right = band.x(pass.events.end);
    if (right <= left) continue;
    if (is_odd) {
      list->AddRectFilled({left, band.corner.y}, {right, band.corner.y + band.size.y},
                          ImGui::GetColorU32(ImGuiCol_Text, 0.06F));
    }
    is_odd = !is_odd;
    list->AddLine({left, band.corner.y}, {left, band.corner.y + band.size.y},
                  ImGui::GetColorU32(ImGuiCol_Text, 0.25F));
    write_inside(left, right, band.corner.y + 1,
                 fmt::format("{} {}", spaced(file.name(pass.name)), pass.round),
                 ImGui::GetColorU32(ImGuiCol_TextDisabled));
  }
}

void draw_curves(const Band& band, const Timeline& timeline) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  std::size_t most = 1;
  double best = 1e-9;
  for (const auto& s : timeline.samples) {
    most = std::max(most, s.n_bad);
    best = std::max(best, s.q_worst);
  }
  // Room above for the names of the passes.
  const double names = ImGui::GetTextLineHeight() + 3;
  const double used = std::max(0.4, 1 - names / std::max(1.0, double{band.size.y}));
  std::vector<ImVec2> bad;
  std::vector<ImVec2> worst;
  // The number holds from one event on to the next: steps, one at a pixel at most.
  const auto step = [](std::vector<ImVec2>& curve, float x, float y) {
    if (!curve.empty()) curve.emplace_back(x, curve.back().y);
    curve.emplace_back(x, y);
  };
  for (float x = 0; x <= band.size.x; ++x) {
    const auto& s = timeline.at(band.position(band.corner.x + x));
    const float left = band.corner.x + x;
    step(bad, left, band.y(used * static_cast<double>(s.n_bad) / static_cast<double>(most)));
    step(worst, left, band.y(used * std::max(s.q_worst, 0.0) / best));
  }
  const float width = ImGui::GetFontSize() / 9;
  list->AddPolyline(bad.data(), static_cast<int>(bad.size()), to_imgui(kBadColour), 0, width);
  list->AddPolyline(worst.data(), static_cast<int>(worst.size()), to_imgui(kWorstColour), 0, width);
}

void draw_marks(const Band& band, const Debugger& debugger) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float size = 0.35F * ImGui::GetFontSize();
  for (const auto& mark : debugger.bookmarks) {
    const float x = band.x(mark.first);
    const float y = band.corner.y + band.size.y;
    list->AddTriangleFilled({x, y - 1.6F * size}, {x - size, y}, {x + size, y},
                            to_imgui(kConstraintColour));
  }
}

/// Dragging goes there.
void seek_by_mouse(Session& session, const char* id, const Band& band) {
  ImGui::SetCursorScreenPos(band.corner);
  ImGui::InvisibleButton(id, band.size);
  if (!ImGui::IsItemActive()) return;
  const std::uint64_t to = band.position(ImGui::GetIO().MousePos.x);
  if (to != session.document.debugger()->position()) {
    run_from_window(find_command("seek"), session, {to});
  }
}

void draw_timeline(Session& session, const Band& band) {
  const Debugger& debugger = *session.document.debugger();
  frame(band);
  draw_passes(band, debugger.file());
  draw_curves(band, debugger.timeline());
  draw_marks(band, debugger);
  cursor_line(band, debugger.position());
  seek_by_mouse(session, "##timeline", band);
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
    const auto& s = debugger.timeline().at(band.position(ImGui::GetIO().MousePos.x));
    ImGui::SetTooltip("event %llu: %zu bad tets, worst quality %.4f",
                      static_cast<unsigned long long>(s.position), s.n_bad, s.q_worst);
  }
}

/// A mark on white, and operator and target beside it, where there is room.
void name_bar(const Debugger& debugger, const IcicleBar& bar, ImVec2 corner, const ImVec2& size,
              bool is_pointed) {
  constexpr float kSmallest = 0.6F;
  constexpr float kMark = 0.7F;
  const Call& call = debugger.file().calls()[bar.call];
  const Outcome outcome = outcome_of(call);
  const float font = ImGui::GetFontSize();
  const float mark = std::min(font, size.y - 1);
  if (mark < kSmallest * font || size.x < 1.4F * mark) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 inside = {corner.x + 1, corner.y + 1};
  list->AddRectFilled(inside, {inside.x + mark, inside.y + mark}, IM_COL32_WHITE, 2);
  figure::Drawing drawing;
  const double margin = (1 - kMark) / 2 * mark;
  add_mark(drawing, outcome, {inside.x + margin, inside.y + margin}, kMark * mark);
  paint(drawing, *list);
  const BarName name = name_in_bar(
      short_name(debugger.file(), call), format_target(call), size.x - mark, size.y, font,
      [](const std::string& text) { return double{ImGui::CalcTextSize(text.c_str()).x}; });
  const bool is_pale = is_pointed || outcome == Outcome::undone;
  const auto text_size = static_cast<float>(name.size);
  ImVec2 at = {inside.x + mark + 0.2F * text_size, corner.y + (mark - text_size) / 2};
  at.y = std::max(at.y, corner.y);
  for (const std::string& line : name.lines) {
    list->AddText(ImGui::GetFont(), text_size, at, is_pale ? IM_COL32_BLACK : IM_COL32_WHITE,
                  line.c_str());
    at.y += text_size;
  }
}

void draw_bar(const Debugger& debugger, const Band& band, const IcicleBar& bar, float height,
              bool is_pointed) {
  const Call& call = debugger.file().calls()[bar.call];
  const float left = band.corner.x + band.size.x * static_cast<float>(bar.left);
  const float right = band.corner.x + band.size.x * static_cast<float>(bar.right);
  const float top = band.corner.y + height * static_cast<float>(bar.row);
  const Outcome outcome = outcome_of(call);
  ImDrawList* list = ImGui::GetWindowDrawList();
  figure::Drawing shares;
  add_shares(shares, bar.ended, {left, top}, std::max(right - 1 - left, 1.0F), height - 1);
  paint(shares, *list);
  if (bar.count == 1 && outcome == Outcome::undone) {
    figure::Drawing hatching;
    add_hatching(hatching, {left, top}, right - 1 - left, height - 1);
    paint(hatching, *list);
  }
  if (is_pointed && bar.count == 1) {
    list->AddRectFilled({left, top}, {right - 1, top + height - 1}, to_imgui(kPointedColour), 2);
  }
  if (debugger.call() == bar.call && bar.count == 1) {
    list->AddRect({left, top}, {right - 1, top + height - 1}, ImGui::GetColorU32(ImGuiCol_Text), 2,
                  0, 2);
  }
  if (bar.count > 1) return;
  name_bar(debugger, bar, {left, top}, {right - 1 - left, height - 1}, is_pointed);
}

/// The window of the icicles: the outermost call at hand, or the pass.
CallWindow window_of(const Debugger& debugger) {
  if (debugger.stack().empty()) return pass_around(debugger.file(), debugger.position());
  return call_window(debugger.file(), debugger.stack().front());
}

/// The last item has the icicles: the wheel zooms at the mouse, dragging moves. True while it drags.
bool zoom_by_mouse(Session& session, const Band& band, const CallWindow& shown) {
  Debugger& debugger = *session.document.debugger();
  const CallWindow whole = window_of(debugger);
  const ImGuiIO& io = ImGui::GetIO();
  const double width = std::max(band.size.x, 1.0F);
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    constexpr double kStep = 0.8;
    const double at = (io.MousePos.x - band.corner.x) / width;
    debugger.zoom = zoomed(whole, shown, at, std::pow(kStep, io.MouseWheel));
  }
  if (!ImGui::IsItemActive() && !ImGui::IsItemDeactivated()) return false;
  const bool drags = ImGui::GetMouseDragDelta(0).x != 0;
  if (drags && ImGui::IsItemActive()) {
    const double events = static_cast<double>(shown.end - shown.begin) / width;
    debugger.zoom = panned(whole, shown, std::llround(-io.MouseDelta.x * events));
  }
  return drags;
}

void draw_icicles(Session& session, const Band& band, const CallWindow& window) {
  const Debugger& debugger = *session.document.debugger();
  frame(band);
  constexpr double kThinnest = 3;  // pixels
  const auto bars = lay_out_icicle(debugger.file(), window,
                                   kThinnest / static_cast<double>(std::max(band.size.x, 1.0F)));
  const auto height = static_cast<float>(icicle_row_height(bars, band.size.y));
  ImGui::GetWindowDrawList()->PushClipRect(
      band.corner, {band.corner.x + band.size.x, band.corner.y + band.size.y}, true);
  const std::uint32_t pointed = session.document.pointed().call;
  for (const IcicleBar& bar : bars) draw_bar(debugger, band, bar, height, bar.call == pointed);
  cursor_line(band, debugger.position());
  ImGui::GetWindowDrawList()->PopClipRect();
  ImGui::SetCursorScreenPos(band.corner);
  ImGui::InvisibleButton("##icicles", band.size);
  const bool is_moved = zoom_by_mouse(session, band, window);
  if (!ImGui::IsItemHovered() || is_moved) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const IcicleBar* bar =
      bar_at(bars, (mouse.x - band.corner.x) / band.size.x,
             static_cast<unsigned>(std::max(0.0F, (mouse.y - band.corner.y) / height)));
  if (bar == nullptr) return;
  const Call& call = debugger.file().calls()[bar->call];
  session.document.hovering = session.document.pointed_call(bar->call);
  ImGui::SetTooltip("call %u: %s %s, level %u, %s%s", bar->call,
                    short_name(debugger.file(), call).c_str(), format_target(call).c_str(),
                    call.level, outcome_text(call, debugger.end()).c_str(),
                    bar->count > 1 ? fmt::format(", and {} more", bar->count - 1).c_str() : "");
  if (ImGui::IsMouseReleased(0)) run_from_window(find_command("enter"), session, {bar->call});
}

/// While the mouse drags, the window stays: else what is under the mouse would be another place.
CallWindow held_window(const Debugger& debugger) {
  ImGuiStorage* storage = ImGui::GetStateStorage();
  const ImGuiID call_id = ImGui::GetID("##held call");
  const ImGuiID place_id = ImGui::GetID("##held place");
  if (!ImGui::IsMouseDown(0)) {
    storage->SetInt(call_id, debugger.stack().empty() ? -1 : static_cast<int>(debugger.stack()[0]));
    storage->SetInt(place_id, static_cast<int>(debugger.position()));
    return window_of(debugger);
  }
  const int call = storage->GetInt(call_id, -1);
  const auto calls = static_cast<int>(debugger.file().calls().size());
  if (call >= 0 && call < calls) {
    return call_window(debugger.file(), static_cast<std::uint32_t>(call));
  }
  return pass_around(debugger.file(), static_cast<std::uint64_t>(storage->GetInt(place_id, 0)));
}

/// Where the window of the strip lies in the trace; dragging goes there.
void draw_overview(Session& session, const Band& band, const CallWindow& window) {
  const Debugger& debugger = *session.document.debugger();
  frame(band);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {band.x(window.begin), band.corner.y},
      {std::max(band.x(window.end), band.x(window.begin) + 2), band.corner.y + band.size.y},
      ImGui::GetColorU32(ImGuiCol_Header));
  cursor_line(band, debugger.position());
  seek_by_mouse(session, "##overview", band);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the whole trace, and the part of it below");
}

std::string name_of(const Debugger& debugger, const CallWindow& window) {
  const TraceFile& file = debugger.file();
  if (!debugger.stack().empty()) {
    const std::uint32_t call = debugger.stack().front();
    return fmt::format("call {}, {} {}", call, short_name(file, file.calls()[call]),
                       format_target(file.calls()[call]));
  }
  const CallWindow whole = window_of(debugger);
  const bool is_trace = whole.begin == 0 && whole.end == file.event_count();
  const bool is_whole = window.begin == whole.begin && window.end == whole.end;
  if (is_trace) return is_whole ? "the whole trace" : "a part of the trace";
  return is_whole ? "the pass at hand" : "a part of the pass at hand";
}

void draw_legend(const Debugger& debugger, const CallWindow& window) {
  const auto& s = debugger.timeline().at(debugger.position());
  const std::string event = fmt::format("event {}", grouped(debugger.position()));
  const std::string all = fmt::format(" of {}", grouped(debugger.end()));
  const std::string bad = fmt::format("  bad tets {}", grouped(s.n_bad));
  const std::string worst = fmt::format("  worst quality {:.4f}", s.q_worst);
  const float gaps = 2 * ImGui::GetStyle().ItemSpacing.x;
  const bool is_wide = ImGui::CalcTextSize((event + all + bad + worst).c_str()).x + gaps <
                       ImGui::GetContentRegionAvail().x;
  ImGui::TextUnformatted((is_wide ? event + all : event).c_str());
  ImGui::SameLine();
  coloured_text(kBadColour, bad);
  ImGui::SameLine();
  coloured_text(kWorstColour, worst);
  const std::string below = fmt::format("  below: {}, events {} to {}", name_of(debugger, window),
                                        grouped(window.begin), grouped(window.end));
  ImGui::SameLine();
  if (ImGui::CalcTextSize(below.c_str()).x > ImGui::GetContentRegionAvail().x) {
    return ImGui::NewLine();
  }
  ImGui::TextDisabled("%s", below.c_str());
}

}  // namespace

/// Curves and icicles have one range and one cursor; where it lies in the trace is above.
void draw_timeline_strip(Session& session) {
  const Debugger& debugger = *session.document.debugger();
  const CallWindow whole = held_window(debugger);
  const CallWindow& zoom = debugger.zoom;
  const bool is_zoomed = zoom.begin < zoom.end && zoom.first_call == whole.first_call &&
                         zoom.last_call == whole.last_call;
  const CallWindow window = is_zoomed ? zoom : whole;
  draw_legend(debugger, window);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const float overview = 0.6F * ImGui::GetFontSize();
  const float height = room.y - overview - 2 * gap;
  const float upper = 0.36F * height;
  const auto begin = static_cast<double>(window.begin);
  const auto end = static_cast<double>(window.end);
  draw_overview(session, {at, {room.x, overview}, 0, static_cast<double>(debugger.end())}, window);
  const float top = at.y + overview + gap;
  draw_timeline(session, {{at.x, top}, {room.x, upper}, begin, end});
  draw_icicles(session, {{at.x, top + upper + gap}, {room.x, height - upper}, begin, end}, window);
}

}  // namespace tetmend::viewer::ui
