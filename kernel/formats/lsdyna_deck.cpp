// SPDX-License-Identifier: MIT
// A keyword file of LS-DYNA by its keywords, lines and fields.
#include "kernel/formats/lsdyna_deck.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include <fmt/format.h>

#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view each) { return text.starts_with(each); });
}

bool names_no_nodes(std::string_view keyword) {
  if (starts_with_any(keyword, {"DATABASE_HISTORY_NODE", "DATABASE_NODAL", "CONTROL_REF",
                                "BOUNDARY_PRESCRIBED_MOTION_NODE", "BOUNDARY_SPC_NODE"})) {
    return false;
  }
  return starts_with_any(keyword, {"KEYWORD",
                                   "END",
                                   "TITLE",
                                   "CONTROL_",
                                   "DATABASE_",
                                   "MAT_",
                                   "SECTION_",
                                   "PART",
                                   "EOS_",
                                   "HOURGLASS",
                                   "PARAMETER",
                                   "DEFINE_CURVE",
                                   "DEFINE_TABLE",
                                   "DEFINE_FUNCTION",
                                   "INCLUDE",
                                   "SET_PART",
                                   "SET_SOLID",
                                   "SET_SHELL",
                                   "SET_BEAM",
                                   "LOAD_BODY",
                                   "LOAD_SEGMENT_SET",
                                   "LOAD_NODE_SET",
                                   "BOUNDARY_SPC_SET",
                                   "BOUNDARY_PRESCRIBED_MOTION_SET",
                                   "BOUNDARY_PRESCRIBED_MOTION_RIGID",
                                   "CONTACT_",
                                   "INITIAL_VELOCITY_GENERATION",
                                   "INITIAL_STRESS_SOLID",
                                   "DAMPING_",
                                   "COMMENT",
                                   "LOAD_GRAVITY"});
}

LsDynaWidths lsdyna_widths(std::string_view line, const LsDynaWidths& of_deck) {
  line = line.substr(0, line.find_last_not_of(" \t\r\n") + 1);
  const bool is_apart =
      line.size() > 1 && (line[line.size() - 2] == ' ' || line[line.size() - 2] == '\t');
  switch (is_apart ? line.back() : '\0') {
    case '+':
      return kLsDynaLong;
    case '-':
      return {};
    case '%':
      return kLsDynaI10;
    default:
      return of_deck;
  }
}

void LsDynaDeck::fail(std::string_view where, std::string_view reason) const {
  file_.fail_at_line(where.data(), reason);
}

std::string_view LsDynaDeck::next_line(const char*& at, const char* end) {
  const char* begin = at;
  const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
  at = newline == nullptr ? end : static_cast<const char*>(newline) + 1;
  return {begin, static_cast<std::size_t>(at - begin)};
}
bool LsDynaDeck::is_comment(std::string_view line) {
  return line.starts_with('$') || trimmed_field(line).empty();
}

void LsDynaDeck::find_blocks() {
  if (file_.size() == 0) {
    file_.fail_at_line(file_.begin(), "the file is empty: expected *KEYWORD and *NODE");
  }
  const char* at = file_.begin();
  LsDynaBlock block{{}, at, at, at};
  while (at != file_.end()) {
    const char* begin = at;
    const std::string_view line = next_line(at, file_.end());
    if (!line.starts_with('*')) continue;
    block.end = begin;
    blocks_.push_back(block);
    std::string keyword(trimmed_field(line.substr(1)));
    for (char& c : keyword) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (keyword.starts_with("KEYWORD")) read_options(keyword);
    block = {keyword.substr(0, keyword.find_first_of(" \t")), begin, at, at};
  }
  block.end = file_.end();
  blocks_.push_back(block);
  // Options hold for the whole deck, wherever they stand: nodes are written with one width.
  for (LsDynaBlock& each : blocks_) {
    const std::string_view line(each.begin, static_cast<std::size_t>(each.content - each.begin));
    each.widths = lsdyna_widths(line, widths_);
  }
  if (blocks_.size() == 1) {
    file_.fail_at_line(file_.begin(), "the file has no keywords: expected *KEYWORD and *NODE");
  }
}

void LsDynaDeck::read_options(std::string_view line) {
  if (line.find("LONG=Y") != std::string_view::npos) widths_ = kLsDynaLong;
  if (line.find("I10=Y") != std::string_view::npos) widths_ = kLsDynaI10;
}

void LsDynaDeck::split(std::string_view line, std::size_t first, std::size_t width,
                       std::size_t reals) {
  fields_.clear();
  line = line.substr(0, line.find_last_not_of("\r\n") + 1);
  if (line.find(',') != std::string_view::npos) {
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t comma = std::min(line.find(',', at), line.size());
      fields_.push_back(trimmed_field(line.substr(at, comma - at)));
      at = comma + 1;
    }
    return;
  }
  bool is_by_words = line.find('\t') != std::string_view::npos;
  for (std::size_t at = 0, k = 0; at < line.size() && !is_by_words; ++k) {
    const std::size_t size = k == 0 ? first : k <= reals ? now_.real : width;
    fields_.push_back(trimmed_field(line.substr(at, size)));
    is_by_words = fields_.back().find(' ') != std::string_view::npos;
    at += size;
  }
  if (!is_by_words) return;
  fields_.clear();
  for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
    const std::size_t blank = std::min(line.find_first_of(" \t", at), line.size());
    fields_.push_back(line.substr(at, blank - at));
    at = line.find_first_not_of(" \t", blank);
  }
}

std::int64_t LsDynaDeck::integer(std::size_t i, std::string_view line, std::string_view what,
                                 std::int64_t low) const {
  std::int64_t value = 0;
  if (!nastran_integer(field(i), value)) {
    fail(line, fmt::format("{} is not an integer: expected {}", in_quotes(field(i)), what));
  }
  if (value < low) fail(line, fmt::format("'{}' is out of range: expected {}", value, what));
  return value;
}

std::vector<std::string_view> LsDynaDeck::lines(const LsDynaBlock& block) const {
  std::vector<std::string_view> found;
  for (const char* at = block.content; at != block.end;) {
    const std::string_view line = next_line(at, block.end);
    if (!is_comment(line)) found.push_back(line);
  }
  return found;
}

}  // namespace tetmend::formats
