// SPDX-License-Identifier: MIT
// The bulk data of a Nastran deck, with the files that it includes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/deck_files.h"
#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

/// Lines of one file, in the order in which Nastran reads them.
struct NastranStretch {
  const char* begin = nullptr;
  const char* end = nullptr;
  std::size_t inclusion = 0;  ///< that the lines belong to; 0: the deck
  std::size_t includes = 0;   ///< not 0: the lines are the INCLUDE of this inclusion
};

class NastranSources {
 public:
  /// @throws Error for the deck itself, and where files include each other without an end
  explicit NastranSources(const std::filesystem::path& deck);

  std::string_view front() const { return {deck().begin(), bulk_begin_}; }  ///< up to BEGIN BULK
  std::string_view end() const { return {bulk_end_, deck().end()}; }        ///< from ENDDATA on
  std::span<const NastranStretch> stretches() const { return stretches_; }
  /// True if an inclusion has something of the mesh, or names elements: then its lines become lines of
  /// the deck, and its INCLUDE goes.
  bool is_inlined(std::size_t inclusion) const { return inclusions_[inclusion].is_inlined; }
  /// Of what could not be read or is not kept, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// That were opened, the deck first.
  const std::vector<std::filesystem::path>& files() const { return files_.paths(); }
  NastranLines lines(const NastranStretch& stretch) const {
    return lines_from(stretch.begin, stretch.end);
  }
  NastranLines lines_from(const char* begin, const char* end) const {
    return {begin, end, has_strays_ ? &strays_ : nullptr};
  }
  bool is_stray(const char* line) const { return has_strays_ && strays_.is_stray(line); }
  const InputFile& deck() const { return files_.deck(); }
  /// The file that a place is in.
  const InputFile& file_of(const char* place) const { return files_.file_of(place); }

 private:
  struct Inclusion {
    std::size_t parent = 0;
    bool parent_is_beside = true;  ///< beside the deck: so the line would mean the same there
    bool is_inlined = false;
    bool is_there = true;
  };
  struct Bulk {
    const char* begin;
    const char* end;
    bool may_include = false;
    bool may_stray = false;  ///< continuations might not follow their lines
  };

  static Bulk find_bulk(const InputFile& file);
  void read(const Bulk& bulk, const std::filesystem::path& path, std::size_t inclusion);
  void include(std::string_view statement, const std::filesystem::path& from,
               std::size_t inclusion);
  void decide();

  DeckFiles files_;
  std::vector<NastranStretch> stretches_;
  std::vector<Inclusion> inclusions_;
  std::vector<std::string> notes_;
  std::filesystem::path folder_;
  NastranStrays strays_;
  bool has_strays_ = false;
  const char* bulk_begin_ = nullptr;
  const char* bulk_end_ = nullptr;
};

}  // namespace tetmend::formats
