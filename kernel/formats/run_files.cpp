// SPDX-License-Identifier: MIT
#include "kernel/formats/run_files.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>
#include <utility>

#include "kernel/formats/standard_stream.h"

namespace tetmend::formats {

namespace {

bool has_number(const std::filesystem::path& name, const NumberedFiles& numbered) {
  const std::string text = name.string();
  const std::string_view begin = numbered.begin;
  const std::string_view end = numbered.end;
  if (text.size() <= begin.size() + end.size()) return false;
  const auto digits =
      std::string_view(text).substr(begin.size(), text.size() - begin.size() - end.size());
  return text.starts_with(begin) && text.ends_with(end) &&
         std::all_of(digits.begin(), digits.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// The file is one of these, or lies in one.
bool is_among(const std::filesystem::path& place, const NumberedFiles& numbered) {
  const auto [in_folder, in_place] =
      std::mismatch(numbered.folder.begin(), numbered.folder.end(), place.begin(), place.end());
  return in_folder == numbered.folder.end() && in_place != place.end() &&
         has_number(*in_place, numbered);
}

/// Behind links to nothing, too: there may be something when it is written.
std::filesystem::path behind_links(std::filesystem::path name) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks; ++i) {
    if (!std::filesystem::is_symlink(std::filesystem::symlink_status(name, error))) break;
    const std::filesystem::path target = std::filesystem::read_symlink(name, error);
    if (error) break;
    name = name.parent_path() / target;
  }
  return name;
}

std::filesystem::path place_of(const std::filesystem::path& name) {
  std::error_code error;
  std::filesystem::path place = std::filesystem::weakly_canonical(behind_links(name), error);
  if (error) place = name;
  // What is not there is not made absolute.
  if (const auto absolute = std::filesystem::absolute(place, error); !error) place = absolute;
  place = place.lexically_normal();
  return place.has_filename() ? place : place.parent_path();
}

std::filesystem::path or_here(const std::filesystem::path& folder) {
  return folder.empty() ? "." : folder;
}

}  // namespace

RunFiles::File RunFiles::find(const std::filesystem::path& name) {
  std::error_code ignored;
  return {name, place_of(name), std::filesystem::exists(name, ignored)};
}

/// Of the numbered ones those that are there, for they may be links.
std::vector<RunFiles::File> RunFiles::find_all(const FileSet& set) {
  std::vector<File> found;
  for (const std::filesystem::path& file : set.files) {
    if (!file.empty() && !is_standard_stream(file)) found.push_back(find(file));
  }
  std::error_code ignored;
  for (const NumberedFiles& numbered : set.numbered) {
    for (const auto& entry :
         std::filesystem::directory_iterator(or_here(numbered.folder), ignored)) {
      if (!has_number(entry.path().filename(), numbered)) continue;
      found.push_back(find(numbered.folder / entry.path().filename()));
    }
  }
  return found;
}

std::vector<NumberedFiles> RunFiles::places_of(const std::vector<NumberedFiles>& numbered) {
  std::vector<NumberedFiles> places = numbered;
  for (NumberedFiles& each : places) each.folder = place_of(or_here(each.folder));
  return places;
}

RunFiles::Use RunFiles::look_up(const FileUse& use) {
  return {use.option,          use.replaceable,
          find_all(use.files), places_of(use.files.numbered),
          find_all(use.home),  places_of(use.home.numbered)};
}

void RunFiles::read(const FileUse& use) {
  read_.push_back(look_up(use));
}

void RunFiles::write(const FileUse& use) {
  written_.push_back(look_up(use));
}

bool RunFiles::is_same(const File& a, const File& b) {
  if (a.place == b.place) return true;
  std::error_code error;
  return a.is_there && b.is_there && std::filesystem::equivalent(a.name, b.name, error) && !error;
}

/// The output has all of its files where the input has its own. Else one file of a mesh might be
/// replaced, through a link, and the others not.
bool RunFiles::is_one_mesh(const Use& input, const Use& output) {
  if (input.replaceable.empty() || input.replaceable != output.replaceable) return false;
  return std::is_permutation(input.home.begin(), input.home.end(), output.files.begin(),
                             output.files.end(), is_same) &&
         std::equal(input.home_numbered.begin(), input.home_numbered.end(), output.numbered.begin(),
                    output.numbered.end(), [](const NumberedFiles& a, const NumberedFiles& b) {
                      return a.folder == b.folder && a.begin == b.begin && a.end == b.end;
                    });
}

const RunFiles::File* RunFiles::common(const Use& output, const Use& other) {
  for (const File& theirs : other.files) {
    for (const File& file : output.files) {
      if (is_same(file, theirs)) return &file;
    }
    for (const NumberedFiles& numbered : output.numbered) {
      if (is_among(theirs.place, numbered)) return &theirs;
    }
  }
  for (const NumberedFiles& numbered : other.numbered) {
    for (const File& file : output.files) {
      if (is_among(file.place, numbered)) return &file;
    }
  }
  return nullptr;
}

std::optional<FileClash> RunFiles::clash() const {
  for (auto output = written_.begin(); output != written_.end(); ++output) {
    for (const Use& input : read_) {
      if (is_one_mesh(input, *output)) continue;
      if (const File* file = common(*output, input)) {
        return FileClash{file->name, input.option, output->option};
      }
    }
    for (auto other = written_.begin(); other != output; ++other) {
      if (const File* file = common(*output, *other)) {
        return FileClash{file->name, other->option, output->option};
      }
    }
  }
  return std::nullopt;
}

}  // namespace tetmend::formats
