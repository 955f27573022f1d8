// SPDX-License-Identifier: MIT
#include "kernel/formats/deck_files.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/compression.h"
#include "kernel/formats/included_path.h"

namespace tetmend::formats {

DeckFiles::DeckFiles(const std::filesystem::path& deck, std::size_t deepest) : deepest_(deepest) {
  open(deck);
}

const InputFile& DeckFiles::open(const std::filesystem::path& path) {
  std::unique_ptr<InputFile>& file = files_[place_of_included(path)];
  if (file == nullptr) {
    auto made = std::make_unique<InputFile>(path);
    size_of_files_ += made->size_of_file();
    all_.push_back(made.get());
    paths_.push_back(path);
    file = std::move(made);
  }
  return *file;
}

const InputFile* DeckFiles::include(const std::filesystem::path& path, const Statement& statement,
                                    std::string& reason) {
  const auto fail = [&](std::string_view why) {
    file_of(statement.place).fail_at_line(statement.place, why);
  };
  if (open_.contains(place_of_included(path))) {
    fail(fmt::format("{} includes itself: expected another file", in_quotes(statement.name)));
  }
  if (open_.size() > deepest_) fail("too many files include each other");
  const InputFile* file = nullptr;
  try {
    file = &open(path);
  } catch (const Error& error) {
    reason = error.what();
    return nullptr;
  }
  if (++inclusions_ > kMostInclusions) fail("more than 10,000 files are included");
  included_ += file->size();
  if (is_bomb(size_of_files_, included_)) {
    fail("the same files are included again and again, hundreds of times their size");
  }
  return file;
}

const InputFile& DeckFiles::file_of(const char* place) const {
  return file_of_place(all_, place);
}

DeckFiles::Nested::Nested(DeckFiles& files, const std::filesystem::path& path)
    : files_(files), path_(place_of_included(path)) {
  files_.open_.insert(path_);
}

const InputFile& file_of_place(std::span<const InputFile* const> files, const char* place) {
  const std::less_equal<> before;
  const auto found = std::find_if(files.begin(), files.end(), [&](const InputFile* file) {
    return before(file->begin(), place) && before(place, file->end());
  });
  return found == files.end() ? *files.front() : **found;
}

}  // namespace tetmend::formats
