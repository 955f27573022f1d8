// SPDX-License-Identifier: MIT
// The bulk data of a Nastran deck, with the files that it includes.
#include "kernel/formats/nastran_sources.h"

#include <algorithm>

#include <fmt/format.h>

#include "kernel/formats/included_path.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {
namespace {

/// Points, systems of coordinates, and what has a number that no new element may get.
bool is_of_mesh(std::string_view name) {
  return name == "GRID" || name == "GRDSET" || name == "SPOINT" || name == "EPOINT" ||
         name.starts_with('C') || name.starts_with('R');
}

/// Of "INCLUDE 'a/b.bdf' $ the mesh" the name with its quotes; a name in quotes may be broken.
std::string name_of(std::string_view statement) {
  constexpr std::string_view kWord = "INCLUDE";
  std::string_view rest = statement.substr(statement.find_first_not_of(' ') + kWord.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t=,"), rest.size()));
  if (!rest.empty() && (rest[0] == '\'' || rest[0] == '"')) {
    std::string name;
    bool begins_line = false;  // where blanks are no part of the name
    for (const char c : rest.substr(0, rest.find(rest[0], 1) + 1)) {
      const bool is_break = c == '\n' || c == '\r';
      begins_line = is_break || (begins_line && (c == ' ' || c == '\t'));
      if (!begins_line) name += c;
    }
    return name;
  }
  return std::string(trimmed_field(rest.substr(0, rest.find_first_of("$\n"))));
}

/// True if a name in quotes goes on in the next line.
bool is_broken(std::string_view statement) {
  const std::size_t quote = statement.find_first_of("'\"");
  return quote != std::string_view::npos &&
         statement.find(statement[quote], quote + 1) == std::string_view::npos;
}

}  // namespace

NastranSources::NastranSources(const std::filesystem::path& deck)
    : files_(deck), folder_(deck.parent_path()) {
  inclusions_.push_back({0, true, true, true});
  const Bulk bulk = find_bulk(files_.deck());
  bulk_begin_ = bulk.begin;
  bulk_end_ = bulk.end;
  read(bulk, deck, 0);
  decide();
}

/// From behind BEGIN BULK, or the beginning, to ENDDATA or another BEGIN, or the end.
NastranSources::Bulk NastranSources::find_bulk(const InputFile& file) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  Bulk bulk{file.begin(), file.end(), false};
  if (std::string_view(file.begin(), file.size()).starts_with(kMark)) bulk.begin += kMark.size();
  NastranLines lines(bulk.begin, bulk.end);
  bool begun = false;
  std::string_view before;
  while (!lines.at_end()) {
    const char* begin = lines.position();
    const char first = lines.initial();
    const std::string_view line = lines.line();
    const bool is_named = (first == '+' || first == '*') && line.size() > 1 && line[1] > ' ';
    if (is_named && !bulk.may_stray) bulk.may_stray = !NastranStrays::follows(line, before);
    if (first != '$') before = line;
    if (first == 'I') bulk.may_include = true;
    if (first != 'B' && first != 'E') continue;
    const std::string name = nastran_name(line);
    const bool is_begin = name == "BEGIN";
    // Behind another BEGIN, of a superelement, numbers mean other points.
    if (name == "ENDDATA" || (is_begin && begun)) {
      bulk.end = begin;
      break;
    }
    if (is_begin) {
      bulk.begin = lines.position();
      begun = true;
    }
  }
  return bulk;
}

void NastranSources::read(const Bulk& bulk, const std::filesystem::path& path,
                          std::size_t inclusion) {
  const DeckFiles::Nested nested(files_, path);
  if (bulk.may_stray) {
    strays_.add(bulk.begin, bulk.end);
    has_strays_ = !strays_.is_empty();
  }
  NastranLines lines(bulk.may_include ? bulk.begin : bulk.end, bulk.end);
  const char* begin = bulk.begin;
  NastranCardText card;
  while (!lines.at_end()) {
    NastranLines ahead = lines;
    const bool may_be = lines.initial() == 'I';
    if (!may_be || nastran_name(ahead.line()) != "INCLUDE") {
      lines.line();
      continue;
    }
    const char* statement = lines.position();
    lines.read(card);
    while (!lines.at_end() &&
           is_broken({statement, static_cast<std::size_t>(lines.position() - statement)})) {
      lines.line();
    }
    if (begin != statement) stretches_.push_back({begin, statement, inclusion, 0});
    begin = lines.position();
    include({statement, static_cast<std::size_t>(begin - statement)}, path, inclusion);
  }
  if (begin != bulk.end) stretches_.push_back({begin, bulk.end, inclusion, 0});
}

void NastranSources::include(std::string_view statement, const std::filesystem::path& from,
                             std::size_t inclusion) {
  const std::size_t number = inclusions_.size();
  inclusions_.push_back({inclusion, from.parent_path() == folder_, false, true});
  stretches_.push_back({statement.data(), statement.data() + statement.size(), inclusion, number});
  const std::filesystem::path path = included_path(from.parent_path(), name_of(statement));
  std::string reason;
  const InputFile* file =
      files_.include(path, {statement.data(), trimmed_field(statement)}, reason);
  inclusions_.back().is_there = file != nullptr;
  if (file == nullptr) {
    notes_.push_back(fmt::format("what {} includes is not read: {}",
                                 in_quotes(trimmed_field(statement)), reason));
    return;
  }
  const Bulk bulk = find_bulk(*file);
  if (bulk.end != file->end()) {
    notes_.push_back(
        fmt::format("ENDDATA of {} is not kept, nor what follows: it is included", file->name()));
  }
  read(bulk, path, number);
}

void NastranSources::decide() {
  for (const NastranStretch& stretch : stretches_) {
    if (stretch.includes != 0 || inclusions_[stretch.inclusion].is_inlined) continue;
    NastranLines lines(stretch.begin, stretch.end);
    bool is_inlined = false;
    while (!lines.at_end() && !is_inlined) {
      is_inlined = is_of_mesh(nastran_name(lines.line()));
    }
    for (std::size_t k = stretch.inclusion; is_inlined && !inclusions_[k].is_inlined;
         k = inclusions_[k].parent) {
      inclusions_[k].is_inlined = true;
    }
  }
  for (std::size_t k = 1; k < inclusions_.size(); ++k) {
    Inclusion& inclusion = inclusions_[k];
    const bool is_written = inclusions_[inclusion.parent].is_inlined && inclusion.is_there;
    if (is_written && !inclusion.parent_is_beside) inclusion.is_inlined = true;
  }
}

}  // namespace tetmend::formats
