// SPDX-License-Identifier: MIT
// A keyword file of LS-DYNA by its keywords, lines and fields.
#include "kernel/formats/lsdyna_deck.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/included_path.h"
#include "kernel/formats/lsdyna.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view each) { return text.starts_with(each); });
}

bool names_no_nodes(std::string_view keyword) {
  if (starts_with_any(keyword, {"DATABASE_HISTORY_NODE", "DATABASE_NODAL", "CONTROL_REF"})) {
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
  files_.file_of(where.data()).fail_at_line(where.data(), reason);
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

// ---- Files and keywords -------------------------------------------------------------------------

LsDynaDeck::LsDynaDeck(const std::filesystem::path& deck) : files_(deck) {
  const InputFile& file = files_.deck();
  if (file.size() == 0) {
    file.fail_at_line(file.begin(), "the file is empty: expected *KEYWORD and *NODE");
  }
  inclusions_.push_back({.is_inlined = true});
  search_paths_.push_back(deck.parent_path());
  const DeckFiles::Nested nested(files_, deck);
  find_blocks(file, 0);
  if (blocks_.size() == 1) {
    file.fail_at_line(file.begin(), "the file has no keywords: expected *KEYWORD and *NODE");
  }
  decide();
  set_widths();
}

/// Folders of *INCLUDE_PATH hold for all names of a file.
void LsDynaDeck::find_blocks(const InputFile& file, std::size_t inclusion) {
  std::vector<LsDynaBlock> blocks = blocks_of(file, inclusion);
  for (const LsDynaBlock& block : blocks) add_search_path(block);
  for (LsDynaBlock& block : blocks) {
    if (block.keyword == "INCLUDE") read_names(block);
    blocks_.push_back(std::move(block));
    const std::size_t at = blocks_.size() - 1;
    for (std::size_t i = 0; i < blocks_[at].names.size(); ++i) {
      const LsDynaInclude name = blocks_[at].names[i];
      const std::filesystem::path path = path_of(name.name);
      std::string reason;
      const InputFile* included = files_.include(path, {name.begin, name.name}, reason);
      if (included == nullptr) {
        unread_.push_back(std::move(reason));
        continue;
      }
      blocks_[at].names[i].inclusion = inclusions_.size();
      inclusions_.push_back({.parent = inclusion, .place = name.begin});
      const DeckFiles::Nested nested(files_, path);
      find_blocks(*included, inclusions_.size() - 1);
    }
  }
}

/// Behind *END of a file that is included nothing is read.
std::vector<LsDynaBlock> LsDynaDeck::blocks_of(const InputFile& file, std::size_t inclusion) {
  std::vector<LsDynaBlock> blocks;
  const char* at = file.begin();
  LsDynaBlock block{{}, at, at, at, {}, inclusion};
  while (at != file.end()) {
    const char* begin = at;
    const std::string_view line = next_line(at, file.end());
    if (!line.starts_with('*')) continue;
    block.end = begin;
    blocks.push_back(std::move(block));
    std::string keyword(trimmed_field(line.substr(1)));
    for (char& c : keyword) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (keyword.starts_with("KEYWORD")) read_options(keyword, inclusion);
    block = {keyword.substr(0, keyword.find_first_of(" \t")), begin, at, at, {}, inclusion};
    if (inclusion != 0 && block.keyword == "END") return blocks;
  }
  block.end = file.end();
  blocks.push_back(std::move(block));
  return blocks;
}

void LsDynaDeck::read_options(std::string_view line, std::size_t inclusion) {
  std::optional<LsDynaWidths>& widths = inclusions_[inclusion].widths;
  if (line.find("LONG=Y") != std::string_view::npos) widths = kLsDynaLong;
  if (line.find("I10=Y") != std::string_view::npos) widths = kLsDynaI10;
}

void LsDynaDeck::read_names(LsDynaBlock& block) {
  LsDynaInclude name{{}, nullptr, nullptr};
  for (const char* at = block.content; at != block.end;) {
    const std::string_view line = next_line(at, block.end);
    if (is_comment(line)) continue;
    if (name.begin == nullptr) name.begin = line.data();
    name.end = at;
    std::string_view text = trimmed_field(line);
    const bool goes_on = text.ends_with(" +");
    if (goes_on) text = trimmed_field(text.substr(0, text.size() - 1));
    name.name += text;
    if (goes_on) continue;
    block.names.push_back(std::move(name));
    name = {{}, nullptr, nullptr};
  }
}

void LsDynaDeck::add_search_path(const LsDynaBlock& block) {
  if (block.keyword != "INCLUDE_PATH" && block.keyword != "INCLUDE_PATH_RELATIVE") return;
  for (const std::string_view line : lines(block)) {
    search_paths_.push_back(included_path(search_paths_.front(), trimmed_field(line)));
  }
}

/// Names are seen from the folder of the deck, in whichever file they stand.
std::filesystem::path LsDynaDeck::path_of(std::string_view name) const {
  std::error_code ignored;
  for (const std::filesystem::path& folder : search_paths_) {
    std::filesystem::path path = included_path(folder, name);
    if (std::filesystem::exists(path, ignored)) return path;
  }
  return included_path(search_paths_.front(), name);
}

void LsDynaDeck::decide() {
  for (const LsDynaBlock& block : blocks_) {
    const bool is_of_mesh = is_nodes(block) || is_solids(block) ||
                            is_list(block.keyword, "SET_SOLID") ||
                            is_list(block.keyword, "SET_NODE");
    for (std::size_t k = block.inclusion; is_of_mesh && !inclusions_[k].is_inlined;
         k = inclusions_[k].parent) {
      inclusions_[k].is_inlined = true;
    }
  }
}

/// Options hold for the whole file, wherever they stand: nodes are written with one width.
void LsDynaDeck::set_widths() {
  widths_ = inclusions_[0].widths.value_or(LsDynaWidths());
  for (std::size_t k = 1; k < inclusions_.size(); ++k) {
    Inclusion& own = inclusions_[k];
    own.widths = own.widths.value_or(inclusions_[own.parent].widths.value_or(LsDynaWidths()));
    if (!own.is_inlined || *own.widths == widths_) continue;
    fail(std::string_view(own.place, 0),
         "the file has other options in *KEYWORD: expected those of the file that includes it");
  }
  for (LsDynaBlock& each : blocks_) {
    const std::string_view line(each.begin, static_cast<std::size_t>(each.content - each.begin));
    each.widths = lsdyna_widths(line, inclusions_[each.inclusion].widths.value_or(widths_));
  }
}

bool LsDynaDeck::is_list(std::string keyword, std::string_view set) {
  for (const std::string_view option :
       {std::string_view("_TITLE"), kGenerate, std::string_view("_LIST")}) {
    const std::size_t at = keyword.find(option);
    if (at != std::string::npos) keyword.erase(at, option.size());
  }
  return keyword == set;
}

// ---- Lines and fields ---------------------------------------------------------------------------

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

std::vector<std::filesystem::path> lsdyna_files(const std::filesystem::path& deck) {
  try {
    std::vector<std::filesystem::path> files = LsDynaDeck(deck).files();
    files.front() = deck;  // of standard input, too
    return files;
  } catch (const Error&) {
    return {deck};
  }
}

}  // namespace tetmend::formats
