// SPDX-License-Identifier: MIT
// The files of a deck: itself, and all that it includes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/input_file.h"

namespace tetmend::formats {

/// Each file is read once, however often it is included.
class DeckFiles {
 public:
  static constexpr std::size_t kMostInclusions = 10000;

  /// @param deepest  how many files may be nested: readers call themselves for each
  /// @throws Error where the deck cannot be read
  explicit DeckFiles(const std::filesystem::path& deck, std::size_t deepest = 1000);
  DeckFiles(const DeckFiles&) = delete;
  DeckFiles& operator=(const DeckFiles&) = delete;

  const InputFile& deck() const { return *all_.front(); }
  /// The deck first, then as they were opened.
  std::span<const InputFile* const> all() const { return all_; }
  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// Bytes of all files as they lie on the disk.
  std::size_t size_of_files() const { return size_of_files_; }
  /// The file that holds these bytes.
  const InputFile& file_of(const char* place) const;

  /// A line that names a file.
  struct Statement {
    const char* place;      ///< of it
    std::string_view name;  ///< as messages call it
  };
  /// Null where the file cannot be read; `reason` says why then.
  /// @throws Error with the place of the statement where a file includes itself, or files are included
  /// without an end
  const InputFile* include(const std::filesystem::path& path, const Statement& statement,
                           std::string& reason);

  /// A file whose statements are read now: it cannot be included meanwhile.
  class Nested {
   public:
    Nested(DeckFiles& files, const std::filesystem::path& path);
    ~Nested() { files_.open_.erase(path_); }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;

   private:
    DeckFiles& files_;
    std::filesystem::path path_;
  };

 private:
  const InputFile& open(const std::filesystem::path& path);

  std::map<std::filesystem::path, std::unique_ptr<InputFile>> files_;  // by place_of_included()
  std::vector<const InputFile*> all_;
  std::vector<std::filesystem::path> paths_;
  std::set<std::filesystem::path> open_;  // one in the other
  std::size_t deepest_;
  std::size_t size_of_files_ = 0;
  std::size_t inclusions_ = 0;
  std::size_t included_ = 0;  // bytes, as often as they are
};

/// The file among these that holds a place. Precondition: one does.
const InputFile& file_of_place(std::span<const InputFile* const> files, const char* place);

}  // namespace tetmend::formats
