// SPDX-License-Identifier: MIT
#include "viewer/ui/interface.h"

#include <array>
#include <cmath>
#include <filesystem>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "explain/lesson_guide.h"
#include "kernel/error.h"
#include "viewer/overlay.h"
#include "viewer/ui/drawing_canvas.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/timeline_strip.h"

namespace tetmend::viewer::ui {

namespace {

constexpr float kFontSize = 16;  // pixels at scale 1
constexpr float kSideWidth = 290;
constexpr float kTraceSideWidth = 450;
constexpr float kMenuHeight = 24;
constexpr float kStatusHeight = 26;
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void load_font(float scale) {
  ImFontConfig config;
  config.OversampleH = 2;
  ImFontAtlas* fonts = ImGui::GetIO().Fonts;
  const float size = std::round(kFontSize * scale);
  if (std::filesystem::exists(kFont)) {
    fonts->AddFontFromFileTTF(kFont, size, &config);
  } else {
    config.SizePixels = size;
    fonts->AddFontDefault(&config);
  }
}

float side_width(const Document& document) {
  return document.debugger() != nullptr ? kTraceSideWidth : kSideWidth;
}

float strip_height(const Document& document) {
  return document.debugger() != nullptr ? kStripHeight : 0;
}

bool is_shown(const Panel& panel, const Document& document) {
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

/// Text for the name of a key, as menus print it.
const char* c_text(std::string_view literal) {
  return literal.data();  // all of them are literals
}

/// Of a menu. Runs when the layout is complete: it may take a picture.
struct Choice {
  const Command* command = nullptr;  // nothing was chosen
  nlohmann::json arguments = nlohmann::json::array();
};

/// An entry for each lesson; `entry` draws it and tells whether it was clicked.
Choice list_lessons(bool (*entry)(const char* title)) {
  Choice choice;
  const auto lessons = find_lessons();
  if (lessons.empty()) ImGui::TextDisabled("there are none here");
  for (const auto& file : lessons) {
    try {
      const Lesson lesson = read_lesson(file);
      if (entry(lesson.title.c_str())) choice = {&find_command("open"), {lesson.trace.string()}};
    } catch (const Error& error) {
      ImGui::TextDisabled("%s", error.what());
    }
  }
  return choice;
}

Choice lessons_menu() {
  if (!ImGui::BeginMenu("Lessons")) return {};
  Choice choice = list_lessons([](const char* title) { return ImGui::MenuItem(title); });
  ImGui::EndMenu();
  return choice;
}

/// While nothing is open.
Choice start_page() {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::Begin("##start", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextDisabled("drop a mesh or a trace here, or");
  Choice choice;
  if (ImGui::Button("Open a file ...")) choice.command = &find_command("open");
  ImGui::Spacing();
  ImGui::TextDisabled("lessons: traces with a text that leads through them");
  Choice lesson = list_lessons([](const char* title) { return ImGui::Button(title); });
  if (lesson.command != nullptr) choice = std::move(lesson);
  ImGui::End();
  return choice;
}

Choice menu() {
  Choice choice;
  if (!ImGui::BeginMainMenuBar()) return choice;
  for (const char* title : {"File", "View", "Show", "Select", "Trace", "Run"}) {
    if (!ImGui::BeginMenu(title)) continue;
    for (const Command& command : commands()) {
      if (command.menu != title) continue;
      if (ImGui::MenuItem(c_text(command.help), c_text(command.keys))) choice.command = &command;
    }
    ImGui::EndMenu();
  }
  Choice lesson = lessons_menu();
  if (lesson.command != nullptr) choice = std::move(lesson);
  ImGui::EndMainMenuBar();
  return choice;
}

}  // namespace

Interface::Interface(float scale) : scale_(scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  load_font(scale);
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
  }
  ImGui::GetStyle() = style;
}

void Interface::arrange(Document& document) const {
  const Canvas window = document.window;
  document.resize(window);
  if (!document.show_panels) return;
  const int side = static_cast<int>(side_width(document) * scale_);
  const int top = static_cast<int>(kMenuHeight * scale_);
  const int bottom = static_cast<int>((kStatusHeight + strip_height(document)) * scale_);
  if (2 * window.width < 5 * side || window.height < 6 * top + bottom)
    return;  // no room: panels cover the mesh
  document.canvas_corner = {side, top};
  document.canvas = {window.width - 2 * side, window.height - top - bottom};
}

void Interface::build(Session& session) {
  apply_theme(session.document.view.theme);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  Choice choice;
  if (session.document.show_panels) {
    choice = menu();
    if (!session.document.has_mesh()) {
      Choice at_start = start_page();
      if (at_start.command != nullptr) choice = std::move(at_start);
    }
    sides(session);
    if (session.document.debugger() != nullptr) strip(session);
    status_line(session);
  }
  draw_choices(session);
  if (session.document.show_keys) keys_page(session);
  paint(draw_overlay(session.document, scale_), *ImGui::GetBackgroundDrawList());
  browser_.draw(session, scale_);
  ImGui::Render();
  if (choice.command != nullptr) run_from_window(*choice.command, session, choice.arguments);
}

void Interface::draw() const {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Interface::strip(Session& session) const {
  const Document& document = session.document;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float side = side_width(document) * scale_;
  const float height = strip_height(document) * scale_;
  ImGui::SetNextWindowPos({side, window.y - kStatusHeight * scale_ - height});
  ImGui::SetNextWindowSize({window.x - 2 * side, height});
  ImGui::Begin("##strip", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
  draw_timeline_strip(session);
  ImGui::End();
}

void Interface::sides(Session& session) const {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const bool has_trace = session.document.debugger() != nullptr;
  const float width = side_width(session.document) * scale_;
  const float top = kMenuHeight * scale_;
  const float height = window.y - top - kStatusHeight * scale_;
  for (const Side side : {Side::left, Side::right}) {
    ImGui::SetNextWindowPos({side == Side::left ? 0 : window.x - width, top});
    ImGui::SetNextWindowSize({width, height});
    ImGui::Begin(side == Side::left ? "##left" : "##right", nullptr, kFixed);
    for (const Panel& panel : panels()) {
      if (panel.side != side || !is_shown(panel, session.document)) continue;
      ImGui::PushID(has_trace ? "trace" : "mesh");
      const bool is_main = !has_trace || panel.subject != Subject::mesh;
      if (is_main && (panel.is_needed == nullptr || panel.is_needed(session.document))) {
        ImGui::SetNextItemOpen(true, ImGuiCond_Once);
      }
      const bool is_open = ImGui::CollapsingHeader(panel.title);
      ImGui::PopID();
      if (!is_open) continue;
      ImGui::PushID(panel.title);
      panel.draw(session);
      ImGui::PopID();
      ImGui::Spacing();
    }
    ImGui::End();
  }
}

void Interface::status_line(Session& session) const {
  const Document& document = session.document;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, window.y - kStatusHeight * scale_});
  ImGui::SetNextWindowSize({window.x, kStatusHeight * scale_});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale_, 3 * scale_});
  ImGui::Begin("##status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
  if (document.message.is_error) {
    ImGui::TextColored({0.85F, 0.2F, 0.2F, 1}, "%s", document.message.text.c_str());
  } else if (document.has_mesh()) {
    const Scene& scene = session.document.scene();
    ImGui::TextUnformatted(document.message.text.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("  shown: %zu  %s", scene.tets_shown, scene.note.c_str());
  } else {
    ImGui::TextDisabled("drop a mesh here, or press Ctrl+O; F1 shows all keys");
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void Interface::keys_page(Session& session) const {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(window.x, 900 * scale_), std::min(window.y, 640 * scale_)});
  ImGui::Begin("Keys (F1 closes)", &session.document.show_keys,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_RowBg)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 0.45F);
    const auto row = [](std::string_view keys, std::string_view effect) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(c_text(keys));
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(c_text(effect));
    };
    for (const auto& gesture : mouse_gestures()) row(gesture.first, gesture.second);
    for (const Command& command : commands()) {
      if (!command.keys.empty()) row(command.keys, command.help);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace tetmend::viewer::ui
