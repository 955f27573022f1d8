// SPDX-License-Identifier: MIT
#include "viewer/ui/wrapped_text.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <string>

#include <imgui.h>

namespace tetmend::viewer::ui {

namespace {

constexpr std::string_view kCall = "call ";

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// At text[i]: one letter, a low line, one letter or digit, and no more of a word on either side.
bool has_index(std::string_view text, std::size_t i) {
  constexpr std::size_t kLength = 3;
  if (i + kLength > text.size() || text[i + 1] != '_') return false;
  if (std::isalpha(static_cast<unsigned char>(text[i])) == 0) return false;
  if (text[i + 2] == '_' || !is_of_word(text[i + 2])) return false;
  const bool begins = i == 0 || !is_of_word(text[i - 1]);
  return begins && (i + kLength == text.size() || !is_of_word(text[i + kLength]));
}

/// Where the next letter with an index stands, or the end.
std::size_t next_index(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size() && !has_index(text, i)) ++i;
  return i;
}

/// At the beginning of a text: "call 17".
std::string_view call_in_front(std::string_view text) {
  if (!text.starts_with(kCall)) return {};
  std::size_t end = kCall.size();
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
  return end == kCall.size() ? std::string_view() : text.substr(0, end);
}

/// Lies over a word that is drawn already.
bool show_call_link(const ImVec2& at, std::string_view word) {
  const char* end = word.data() + word.size();
  const ImVec2 size = ImGui::CalcTextSize(word.data(), end);
  ImGui::SetCursorScreenPos(at);
  const bool is_clicked = ImGui::InvisibleButton("##call", size);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_CheckMark);
  list->AddRectFilled(
      at, {at.x + size.x, at.y + size.y},
      ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_HeaderHovered : ImGuiCol_WindowBg));
  list->AddText(at, colour, word.data(), end);
  return is_clicked;
}

}  // namespace

void draw_indexed(ImDrawList& list, ImVec2 at, ImU32 colour, std::string_view text) {
  constexpr float kSmall = 0.72F;
  constexpr float kLow = 0.36F;
  const ImFont* font = ImGui::GetFont();
  const float large = ImGui::GetFontSize();
  const float left = at.x;
  const auto draw = [&](std::string_view part, float size, float y) {
    const char* end = part.data() + part.size();
    list.AddText(font, size, {at.x, y}, colour, part.data(), end);
    at.x += font->CalcTextSizeA(size, FLT_MAX, 0, part.data(), end).x;
  };
  while (!text.empty()) {
    const std::size_t letter = next_index(text);
    const std::size_t line = text.find('\n');
    const std::size_t end = std::min({letter + 1, line, text.size()});
    draw(text.substr(0, end), large, at.y);
    if (line <= letter && line < text.size()) {
      at = {left, at.y + ImGui::GetTextLineHeight()};
      text.remove_prefix(line + 1);
    } else if (letter < text.size()) {
      draw(text.substr(letter + 2, 1), kSmall * large, at.y + kLow * large);
      text.remove_prefix(letter + 3);
    } else {
      return;
    }
  }
}

void indexed_text(std::string_view text) {
  const char* end = text.data() + text.size();
  if (next_index(text) == text.size()) return ImGui::TextUnformatted(text.data(), end);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy(ImGui::CalcTextSize(text.data(), end));  // a little wider than it is drawn
  draw_indexed(*ImGui::GetWindowDrawList(), at, ImGui::GetColorU32(ImGuiCol_Text), text);
}

std::string in_lines(std::string_view text, float width) {
  std::string lines;
  std::size_t line = 0;  // where it begins in `lines`
  while (!text.empty()) {
    const std::size_t least = call_in_front(text).size();
    const std::string_view word = text.substr(0, text.find(' ', least));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const std::size_t before = lines.size();
    if (before > line) lines += ' ';
    lines += word;
    if (before == line || ImGui::CalcTextSize(lines.c_str() + line).x <= width) continue;
    lines[before] = '\n';
    line = before + 1;
  }
  return lines;
}

void wrapped_text(std::string_view text) {
  indexed_text(in_lines(text, ImGui::GetContentRegionAvail().x));
}

namespace {

/// Where rows of a line after its first begin.
float hanging_indent() {
  constexpr float kHang = 1.5F;
  return kHang * ImGui::GetFontSize();
}

}  // namespace

std::size_t CodeLine::rows() const {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

CodeLine code_line(std::string_view line, float width) {
  constexpr float kLeast = 8;
  const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
  CodeLine made{static_cast<float>(blanks) * ImGui::CalcTextSize(" ").x, {}};
  const float room = width - made.indent;
  line.remove_prefix(blanks);
  if (ImGui::CalcTextSize(line.data(), line.data() + line.size()).x <= room) {
    made.text = line;
  } else {
    made.text = in_lines(line, std::max(room - hanging_indent(), kLeast * ImGui::GetFontSize()));
  }
  return made;
}

void show_code_line(const CodeLine& line) {
  const float left = ImGui::GetCursorPosX() + line.indent;
  std::string_view rest = line.text;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  for (bool is_first = true;; is_first = false) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    ImGui::SetCursorPosX(is_first ? left : left + hanging_indent());
    indexed_text(rest.substr(0, end));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  ImGui::PopStyleVar();
}

CallsInText wrapped_text_with_calls(std::string_view text) {
  CallsInText calls;
  const std::string lines = in_lines(text, ImGui::GetContentRegionAvail().x);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::TextUnformatted(lines.c_str());
  const ImVec2 below = ImGui::GetCursorScreenPos();
  float top = corner.y;
  std::size_t line = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == '\n') {
      line = i + 1;
      top += ImGui::GetTextLineHeight();
    }
    const bool is_word = i == line || lines[i - 1] == ' ' || lines[i - 1] == '\n';
    const std::string_view name =
        is_word ? call_in_front(std::string_view(lines).substr(i)) : std::string_view();
    if (name.empty()) continue;
    const float left = ImGui::CalcTextSize(lines.c_str() + line, lines.c_str() + i).x;
    std::uint32_t number = 0;
    std::from_chars(name.data() + kCall.size(), name.data() + name.size(), number);
    ImGui::PushID(static_cast<int>(i));
    if (show_call_link({corner.x + left, top}, name)) calls.clicked = number;
    if (ImGui::IsItemHovered()) calls.hovered = number;
    ImGui::PopID();
  }
  ImGui::SetCursorScreenPos(below);
  return calls;
}

namespace {

void move_right(const char* text) {
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text).x;
  if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
}

}  // namespace

std::string infinity_text() {
  constexpr ImWchar kInfinity = 0x221E;
  return ImGui::GetFont()->FindGlyphNoFallback(kInfinity) != nullptr ? "\u221e" : "inf";
}

void right_aligned(const std::string& text) {
  move_right(text.c_str());
  ImGui::TextUnformatted(text.c_str());
}

void number_column(const char* title, const std::string& longest) {
  const float width =
      std::max(ImGui::CalcTextSize(title).x, ImGui::CalcTextSize(longest.c_str()).x);
  ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthFixed, std::ceil(width));
}

void headers_row(int first_number) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int i = 0; i < ImGui::TableGetColumnCount(); ++i) {
    if (!ImGui::TableSetColumnIndex(i)) continue;
    const char* title = ImGui::TableGetColumnName(i);
    if (i >= first_number) move_right(title);
    ImGui::PushID(i);
    ImGui::TableHeader(title);
    ImGui::PopID();
  }
}

}  // namespace tetmend::viewer::ui
