// SPDX-License-Identifier: MIT
#include "viewer/ui/interface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <utility>

#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "kernel/error.h"
#include "kernel/grouped.h"
#include "viewer/commands/menu.h"
#include "viewer/overlay.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/dialog_buttons.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/timeline_strip.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

constexpr float kFontSize = 16;  // pixels at scale 1
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Panels that come up ask for no focus: with a question open that is not drawn yet, the library ends
/// the program by an assertion.
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoFocusOnAppearing;

ImFont* load_font(float scale) {
  static constexpr std::array<ImWchar, 7> kLetters = {0x20,   0xFF,   0x2013, 0x2026,
                                                      0x221E, 0x221E, 0};
  ImFontConfig config;
  config.OversampleH = 2;
  config.GlyphRanges = kLetters.data();
  ImFontAtlas* fonts = ImGui::GetIO().Fonts;
  const float size = std::round(kFontSize * scale);
  if (std::filesystem::exists(kFont)) return fonts->AddFontFromFileTTF(kFont, size, &config);
  config.SizePixels = size;
  return fonts->AddFontDefault(&config);
}

bool has_subject(const Panel& panel, const Document& document) {
  switch (panel.subject) {
    case Subject::mesh:
      return document.has_mesh();
    case Subject::trace:
      return document.debugger() != nullptr;
    case Subject::lesson:
      return document.debugger() != nullptr && document.debugger()->lesson().has_value();
  }
  return false;
}

bool is_shown(const Panel& panel, const Document& document) {
  if (!has_subject(panel, document)) return false;
  return panel.is_there == nullptr || panel.is_there(document);
}

/// Text for the name of a key, as menus print it.
const char* c_text(std::string_view literal) {
  return literal.data();  // all of them are literals
}

Choice lessons_menu() {
  if (!ImGui::BeginMenu("Lessons")) return {};
  close_by_escape();
  Choice choice = list_lessons([](const char* title) { return ImGui::MenuItem(title); });
  ImGui::EndMenu();
  return choice;
}

Choice recent_menu(const Document& document) {
  Choice choice;
  if (!begin_submenu("Opened lately", !document.recent.empty())) return choice;
  for (const std::string& file : document.recent) {
    if (ImGui::MenuItem(file.c_str())) choice = {&find_command("open"), {file}};
  }
  ImGui::EndMenu();
  return choice;
}

Choice menu(Document& document) {
  Choice choice;
  if (!ImGui::BeginMainMenuBar()) return choice;
  for (const char* title : {"File", "View", "Show", "Select", "Trace", "Run", "Help"}) {
    if (!ImGui::BeginMenu(title)) continue;
    close_by_escape();
    const Command& quit = find_command("quit");
    const auto offer = [&](const Command& command) {
      if (ImGui::MenuItem(menu_text(command).c_str(), c_text(command.keys),
                          is_on(command, document).value_or(false),
                          is_possible(command, document))) {
        choice.command = &command;
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", c_text(command.help));
    };
    for (const Command& command : commands()) {
      if (command.menu != title || &command == &quit) continue;
      if (begins_group(command)) ImGui::Separator();
      offer(command);
    }
    if (quit.menu == title) {  // the last
      Choice again = recent_menu(document);
      if (again.command != nullptr) choice = std::move(again);
      ImGui::Separator();
      offer(quit);
    }
    ImGui::EndMenu();
  }
  Choice lesson = lessons_menu();
  if (lesson.command != nullptr) choice = std::move(lesson);
  ImGui::EndMainMenuBar();
  return choice;
}

ImVec2 corner_of(const Area& area) {
  return {area.x, area.y};
}

/// A window that fills an area. False: it is empty; then do not end it.
bool begin_area(const char* name, const Area& area, ImGuiWindowFlags more = 0) {
  if (area.is_empty()) return false;
  ImGui::SetNextWindowPos(corner_of(area));
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::Begin(name, nullptr, kFixed | more);
  return true;
}

/// The panel has the answer to what was asked for last, and nobody has seen it yet.
bool is_news(const Panel& panel, const Debugger* debugger) {
  if (debugger == nullptr) return false;
  using News = Debugger::News;
  return (debugger->news == News::history && panel.draw == &draw_history_panel) ||
         (debugger->news == News::found && panel.draw == &draw_found_panel) ||
         (debugger->news == News::pair && panel.draw == &draw_both_panel);
}

/// A panel stays open or folded whatever its heading says.
std::string heading_of(const Panel& panel, const Document& document) {
  const std::string_view said = panel.heading ? panel.heading(document) : panel.title;
  return fmt::format("{}###{}", said, panel.title);
}

/// `has_steps_elsewhere`: where the trace is, and the way on, stands below all panels.
void list_panels(Session& session, const std::function<bool(const Panel&)>& is_wanted,
                 bool has_steps_elsewhere = false) {
  const bool has_trace = session.document.debugger() != nullptr;
  for (const Panel& panel : panels()) {
    if (!is_wanted(panel) || !is_shown(panel, session.document)) continue;
    if (has_steps_elsewhere && panel.draw == &draw_step_panel) continue;
    ImGui::PushID(has_trace ? "trace" : "mesh");
    const bool is_main = !has_trace || panel.subject != Subject::mesh;
    if (is_main && (panel.is_needed == nullptr || panel.is_needed(session.document))) {
      ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    }
    const bool comes_into_sight = is_news(panel, session.document.debugger());
    const bool is_of_pick = panel.draw == &draw_selection_panel;
    const bool is_told = is_of_pick && std::exchange(session.document.tells_pick, false);
    if (comes_into_sight || is_told) ImGui::SetNextItemOpen(true);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool is_open = ImGui::CollapsingHeader(heading_of(panel, session.document).c_str());
    ImGui::PopID();
    if (!is_open) continue;
    ImGui::PushID(panel.title);
    panel.draw(session);
    ImGui::PopID();
    ImGui::Spacing();
    if (!comes_into_sight || session.document.debugger() == nullptr) continue;
    session.document.debugger()->news = Debugger::News::none;
    ImGui::ScrollToRect(ImGui::GetCurrentWindow(),
                        {corner, {corner.x, ImGui::GetCursorScreenPos().y}},
                        ImGuiScrollFlags_KeepVisibleEdgeY);
  }
}

void list_side(Session& session, Side side) {
  list_panels(session, [&](const Panel& panel) { return panel.side == side; });
}

/// Panels of a trace where there is one column. Where one enters a call or leaves all, or asks for
/// something, the tab for that comes to the front. `has_code`: the algorithm has a tab, too.
void list_in_tabs(Session& session, bool enters, bool leaves, bool is_in_call, bool has_code) {
  if (!ImGui::BeginTabBar("##tabs")) return;
  const Debugger::News news = session.document.debugger()->news;
  const bool is_told = news == Debugger::News::history || news == Debugger::News::pair;
  enters = is_told || (enters && news == Debugger::News::none);
  leaves = news == Debugger::News::found || (leaves && news == Debugger::News::none);
  const auto tab = [&](const char* title, bool comes, auto... is_wanted) {
    const ImGuiTabItemFlags flags = comes ? ImGuiTabItemFlags_SetSelected : 0;
    if (!ImGui::BeginTabItem(title, nullptr, flags)) return;
    if (comes && news == Debugger::News::none) ImGui::SetScrollY(0);
    (list_panels(session, is_wanted, is_in_call), ...);
    ImGui::EndTabItem();
  };
  const auto is_mesh = [](const Panel& panel) { return panel.subject == Subject::mesh; };
  const auto is_shell = [](const Panel& panel) { return panel.draw == &draw_shell_panel; };
  tab("Calls", leaves, [&](const Panel& panel) {
    return panel.side == Side::left && !is_mesh(panel) && !is_shell(panel);
  });
  const auto is_to_act = [](const Panel& panel) {
    return panel.draw == &draw_trial_panel || panel.draw == &draw_parameters_panel;
  };
  tab("Call", enters, is_to_act, is_shell, [&](const Panel& panel) {
    return panel.side == Side::right && !is_mesh(panel) && !is_to_act(panel);
  });
  if (has_code && ImGui::BeginTabItem("Algorithm")) {
    draw_algorithm_panel(session);
    ImGui::EndTabItem();
  }
  tab("Mesh", false, is_mesh);
  ImGui::EndTabBar();
}

/// Takes the lower part of an area. It stays where it is, whatever is above.
Area dock(Area& area, float height) {
  area.height -= height;
  return {area.x, area.y + area.height, area.width, height};
}

Area dock_algorithm(const Session& session, Area& area, float share) {
  return dock(area, std::min(algorithm_height(session), share * area.height));
}

/// What stands below the panels of a trace, whatever they show.
struct Docked {
  float algorithm = 0;  // of the height of the column; 0: it has a tab
  float event_lines = 0;
};

/// The lower the column is, the less: the ring is to have room above.
Docked docked_in(const Layout& layout) {
  constexpr float kHigh = 44, kLow = 34;  // in lines of text
  if (!layout.is_one_column) return {0.42F, 0};
  const float lines = layout.right.height / ImGui::GetFontSize();
  if (lines >= kHigh) return {0.3F, 5.6F};
  if (lines >= kLow) return {0.25F, 4};
  return {0, 3.2F};
}

/// In tabs, what has happened and the way on would be out of sight where the ring is seen.
void dock_place(Session& session, Area& area, float event_lines) {
  if (begin_area("##event", dock(area, event_lines * ImGui::GetTextLineHeightWithSpacing()))) {
    if (session.document.debugger()->lesson()) {
      draw_lesson_step(session);
    } else {
      draw_last_event(session);
    }
    draw_stack(session);
    ImGui::End();
  }
  const float height = 2 * ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().WindowPadding.y;
  if (begin_area("##steps", dock(area, height), ImGuiWindowFlags_NoScrollbar)) {
    constexpr bool kShort = true;
    draw_step_buttons(session, kShort);
    ImGui::End();
  }
}

/// The ring is a square: the rest of a wide column is for what stands beside it.
Area take_left(Area& area) {
  constexpr float kMost = 0.44F;
  const float width = std::round(std::min(kMost * area.width, area.height));
  const Area left = {area.x, area.y, width, area.height};
  area.x += width;
  area.width -= width;
  return left;
}

/// What is spoken of, one below the other, the algorithm last, or in a wide column side by side; nothing
/// needs to be scrolled to.
void teach_column(Session& session, const Layout& layout) {
  constexpr float kMostOfColumn = 0.5F;
  constexpr float kWide = 1.15F;
  const auto shows = [&](Focus focus) {
    return std::find(layout.focus.begin(), layout.focus.end(), focus) != layout.focus.end();
  };
  const auto ring = [](Session& s) { draw_ring(s, false); };
  const auto ring_alone = [](Session& s) { draw_ring(s); };
  const auto code = [](Session& s) {
    constexpr bool kWhole = true;
    draw_algorithm_panel(s, kWhole);
  };
  struct Part {
    Focus focus;
    const char* name;
    void (*draw)(Session&);
  };
  std::vector<Part> parts;
  for (const Part& part :
       {Part{Focus::tree, "##tree", &draw_tree}, Part{Focus::ring, "##teaching", ring},
        Part{Focus::tables, "##tables", &draw_tables}}) {
    if (shows(part.focus)) parts.push_back(part);
  }
  // Beside others the ring has the room that words would take.
  if (parts.size() == 1 && shows(Focus::ring)) parts[0].draw = ring_alone;
  const auto show = [&](const Part& part, const Area& area) {
    if (!begin_area(part.name, area)) return;
    part.draw(session);
    ImGui::End();
  };
  const Part algorithm = {Focus::algorithm, "##code", code};
  Area column = layout.right;
  const bool is_pair = parts.size() + (shows(Focus::algorithm) ? 1 : 0) == 2;
  if (is_pair && shows(Focus::ring) && column.width > kWide * column.height) {
    show({Focus::ring, "##teaching", ring}, take_left(column));
    std::erase_if(parts, [](const Part& part) { return part.focus == Focus::ring; });
  }
  if (shows(Focus::algorithm)) {
    show(algorithm, parts.empty() ? column : dock_algorithm(session, column, kMostOfColumn));
  }
  const float height = column.height / static_cast<float>(std::max<std::size_t>(parts.size(), 1));
  for (const Part& part : parts) {
    show(part, {column.x, column.y, column.width, height});
    column.y += height;
  }
}

void teach(Session& session, const Layout& layout) {
  teach_column(session, layout);
  if (begin_area("##lesson", layout.strip)) {
    if (session.document.debugger()->lesson()) {
      draw_lesson_text(session);
    } else {
      draw_last_event(session);
      constexpr std::size_t kMostCalls = 3;
      draw_stack(session, kMostCalls);
    }
    ImGui::End();
  }
  if (begin_area("##bar", layout.bar, ImGuiWindowFlags_NoScrollbar)) {
    draw_lesson_bar(session);
    ImGui::End();
  }
}

/// An error is not to be overlooked, and what is long would be cut.
bool needs_toast(const Message& message, float width) {
  constexpr float kMost = 0.75F;
  if (message.text.empty()) return false;
  return message.is_error || message.is_to_be_seen ||
         ImGui::CalcTextSize(message.text.c_str()).x > kMost * width;
}

/// Over the picture, until the next act: what the status line does not say, and what can be taken
/// back.
void show_toast(Document& document, const Area& canvas, float width) {
  const bool is_said = needs_toast(document.message, width);
  if (!is_said && !document.offer) return;
  constexpr float kLetters = 44;
  const float margin = ImGui::GetFontSize();
  const float most = std::max(canvas.width - 2 * margin, 8 * margin);
  ImGui::SetNextWindowPos({canvas.x + canvas.width / 2, canvas.y + margin / 2}, ImGuiCond_Always,
                          {0.5F, 0});
  ImGui::SetNextWindowSize({std::min(most, kLetters * margin), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("##toast", nullptr,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  if (is_said) {
    const bool is_dark = document.view.theme == "dark";
    const ImVec4 red = is_dark ? ImVec4{1, 0.55F, 0.5F, 1} : ImVec4{0.72F, 0.1F, 0.1F, 1};
    const ImVec4 ink = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, document.message.is_error ? red : ink);
    wrapped_text(document.message.text);
    ImGui::PopStyleColor();
  }
  if (document.offer) {
    wrapped_text(document.offer->text);
    if (ImGui::Button(document.offer->button.c_str())) {
      const Offer offer = std::move(*document.offer);
      document.offer.reset();
      guarded(document, [&] { offer.take_back(document); });
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void show_status(Session& session, const Area& area, float scale) {
  const Document& document = session.document;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 3 * scale});
  if (begin_area("##status", area, ImGuiWindowFlags_NoScrollbar)) {
    if (document.has_mesh()) {
      const Scene& scene = session.document.scene();
      const bool is_elsewhere = needs_toast(document.message, area.width);
      if (!is_elsewhere) ImGui::TextUnformatted(document.message.text.c_str());
      if (!is_elsewhere) ImGui::SameLine();
      ImGui::TextDisabled("  shown: %s  %s", grouped(scene.tets_shown).c_str(), scene.note.c_str());
    } else {
      ImGui::TextDisabled("drop a mesh or a trace here, or press Ctrl+O; F1 shows all keys");
    }
    ImGui::End();
  }
  ImGui::PopStyleVar();
}

/// Over all the rest.
void show_opening(const Opening& opening) {
  constexpr float kWidth = 24;  // of letters
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({kWidth * ImGui::GetFontSize(), 0});
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("##opening", nullptr,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted(opening.file().filename().string().c_str());
  ImGui::ProgressBar(static_cast<float>(opening.share()), {-1, 0}, opening.stage().data());
  ImGui::TextDisabled("%.0f s", opening.seconds());
  ImGui::End();
  ImGui::PopStyleVar();
}

/// Words over the picture are as large as those of the panels.
OverlayLook overlay_look(float scale) {
  OverlayLook look;
  look.scale = scale;
  look.text_size = ImGui::GetFontSize();
  look.text_width = [](const std::string& text, double size) {
    const auto pixels = static_cast<float>(size);
    return static_cast<double>(ImGui::GetFont()->CalcTextSizeA(pixels, 1e9F, 0, text.c_str()).x);
  };
  return look;
}

void point_by_mouse(Document& document, const ImVec2& mouse) {
  constexpr float kReach = 0.75F;
  const glm::dvec2 at = document.to_canvas(mouse.x, mouse.y);
  const bool is_inside =
      at.x >= 0 && at.y >= 0 && at.x < document.canvas.width && at.y < document.canvas.height;
  if (!is_inside || !document.has_mesh()) return;
  document.hovering = document.find_named(mouse.x, mouse.y, kReach * ImGui::GetFontSize());
}

}  // namespace

Interface::Interface(float scale) : scale_(scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  load_font(scale);
  large_ = load_font(kTeachingText * scale);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Interface::apply_theme(const std::string& theme) {
  if (theme == theme_) return;
  theme_ = theme;
  ImGuiStyle style;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.FramePadding = {6, 3};
  style.ItemSpacing = {8, 5};
  style.ScaleAllSizes(scale_);
  if (theme == "dark") {
    ImGui::StyleColorsDark(&style);
    style.Colors[ImGuiCol_WindowBg] = {0.13F, 0.14F, 0.16F, 1};
    style.Colors[ImGuiCol_MenuBarBg] = {0.10F, 0.11F, 0.13F, 1};
    style.Colors[ImGuiCol_TextDisabled] = {0.62F, 0.65F, 0.70F, 1};
  } else {
    ImGui::StyleColorsLight(&style);
    style.Colors[ImGuiCol_WindowBg] = {0.965F, 0.97F, 0.975F, 1};
    style.Colors[ImGuiCol_FrameBg] = {0.88F, 0.90F, 0.93F, 1};
    style.Colors[ImGuiCol_TextDisabled] = {0.36F, 0.40F, 0.46F, 1};
    style.Colors[ImGuiCol_CheckMark] = {0.10F, 0.38F, 0.78F, 1};  // links have it, too: 5 to 1
  }
  style.Colors[ImGuiCol_PopupBg].w = 1;  // nothing shines through
  ImGui::GetStyle() = style;
}

void Interface::arrange(Document& document) const {
  const Canvas window = document.window;
  document.resize(window);
  const Area canvas = lay_out(document, scale_).canvas;
  document.canvas_corner = {static_cast<int>(canvas.x), static_cast<int>(canvas.y)};
  document.canvas = {std::max(static_cast<int>(canvas.width), 1),
                     std::max(static_cast<int>(canvas.height), 1)};
}

void Interface::build(Session& session) {
  Document& document = session.document;
  apply_theme(document.view.theme);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  const Layout layout = lay_out(document, scale_);
  document.hovering = {};
  session.is_drawing = true;
  ImFont* font = layout.is_teaching ? large_ : ImGui::GetFont();
  Choice choice;
  const bool is_whole = guarded(document, [&] {
    if (document.show_panels) {
      choice = menu(document);
      if (!document.has_mesh() && document.opening() == nullptr) {
        Choice at_start = start_page_.draw(document, scale_, large_);
        if (at_start.command != nullptr) choice = std::move(at_start);
      }
      show_status(session, layout.status, scale_);
    }
    if (document.show_keys) keys_page_.draw(session, scale_);
    browser_.draw(session, scale_);
    place_dialog_.draw(session);
    unsaved_dialog_.draw(session);
    if (document.opening() != nullptr) show_opening(*document.opening());
    show_toast(document, layout.canvas, static_cast<float>(document.window.width));
  });
  if (!is_whole) ImGui::ErrorCheckEndFrameRecover(nullptr);
  if (layout.is_teaching) large_->Scale = layout.text / kTeachingText;
  ImGui::PushFont(font);
  const bool is_done = guarded(document, [&] {
    if (!ImGui::GetIO().WantCaptureMouse) {
      point_by_mouse(document, ImGui::GetIO().MousePos);
    }
    if (document.show_panels) panels_around(session, layout);
    choices_.draw(session);
    OverlayLook look = overlay_look(scale_);
    look.has_triad = document.show_panels;
    paint(draw_overlay(document, look), *ImGui::GetBackgroundDrawList());
  });
  if (!is_done) ImGui::ErrorCheckEndFrameRecover(nullptr);
  ImGui::PopFont();
  large_->Scale = 1;  // the start page has it, too
  document.hovered = document.hovering;
  ImGui::Render();
  session.is_drawing = false;
  do_asked(session);
  if (choice.command != nullptr) run_from_window(*choice.command, session, choice.arguments);
}

void Interface::draw() const {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Interface::panels_around(Session& session, const Layout& layout) {
  if (layout.is_teaching) return teach(session, layout);
  if (begin_area("##left", layout.left)) {
    list_side(session, Side::left);
    note_spare_room();
    ImGui::End();
  }
  Area right = layout.right;
  const bool has_trace = session.document.debugger() != nullptr;
  const bool is_in_call = has_trace && session.document.debugger()->call() != kNoCall;
  const bool enters = is_in_call && !was_in_call_;
  const bool leaves = !is_in_call && was_in_call_;
  was_in_call_ = is_in_call;
  const Docked docked = docked_in(layout);
  if (has_trace && !right.is_empty() && docked.algorithm > 0) {
    if (begin_area("##algorithm", dock_algorithm(session, right, docked.algorithm))) {
      draw_algorithm_panel(session);
      ImGui::End();
    }
  }
  if (layout.is_one_column && is_in_call) dock_place(session, right, docked.event_lines);
  if (begin_area("##right", right)) {
    if (layout.is_one_column && has_trace) {
      list_in_tabs(session, enters, leaves, is_in_call, docked.algorithm == 0);
    } else {
      if (layout.is_one_column) list_side(session, Side::left);
      list_side(session, Side::right);
      note_spare_room();
    }
    ImGui::End();
  }
  if (has_trace && begin_area("##strip", layout.strip, ImGuiWindowFlags_NoScrollbar)) {
    draw_timeline_strip(session);
    ImGui::End();
  }
}

}  // namespace tetmend::viewer::ui
