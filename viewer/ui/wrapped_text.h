// SPDX-License-Identifier: MIT
// Paragraphs in panels, and numbers in tables.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <imgui.h>

namespace tetmend::viewer::ui {

/// The text with line breaks, none of them inside a number or the name of a call: lines are at most so
/// wide, but for words that are wider.
std::string in_lines(std::string_view text, float width);
/// Like ImGui::TextUnformatted, but "M_q" and "p_i" have their index small and low, as in the paper.
void indexed_text(std::string_view text);
/// The same at a place of the screen.
void draw_indexed(ImDrawList& list, ImVec2 at, ImU32 colour, std::string_view text);
/// Like ImGui::TextWrapped, but breaks lines at spaces only: never inside a number.
void wrapped_text(std::string_view text);

/// A line of an algorithm, broken where it is too long: rows after the first begin further to the right.
struct CodeLine {
  float indent = 0;  ///< as its blanks at the beginning had it
  std::string text;  ///< with the breaks
  std::size_t rows() const;
};
/// In the size of the text of the current window.
CodeLine code_line(std::string_view line, float width);
void show_code_line(const CodeLine& line);

/// What the mouse does to the calls that a paragraph names.
struct CallsInText {
  std::optional<std::uint32_t> clicked, hovered;
};
/// The same; each "call 17" in it is a link.
CallsInText wrapped_text_with_calls(std::string_view text);

/// The sign for infinity, or "inf" where the font has none.
std::string infinity_text();

/// Numbers end in one line: at the right of the room that there is.
void right_aligned(const std::string& text);
/// A column of a table for such numbers, as wide as its title, a literal, and the longest of them.
void number_column(const char* title, const std::string& longest);
/// The heads of the columns of a table, as ImGui::TableHeadersRow, those from `first_number` on over
/// numbers that are right_aligned().
void headers_row(int first_number);

}  // namespace tetmend::viewer::ui
