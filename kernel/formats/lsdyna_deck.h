// SPDX-License-Identifier: MIT
// A keyword file of LS-DYNA by its keywords, lines and fields, with the files that it includes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/deck_files.h"
#include "kernel/formats/lsdyna.h"

namespace tetmend::formats {

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings);

/// False for keywords whose whole numbers may be nodes.
bool names_no_nodes(std::string_view keyword);

/// A file that *INCLUDE names. Where its name takes several lines, these end with " +".
struct LsDynaInclude {
  std::string name;
  const char* begin;
  const char* end;            ///< of the lines of the name
  std::size_t inclusion = 0;  ///< 0: it is not read
};

/// Lines from a keyword up to the next one.
struct LsDynaBlock {
  std::string keyword;  ///< in capitals, without '*'; empty: what stands before the first
  const char* begin;
  const char* content;  ///< behind the line of the keyword
  const char* end;
  LsDynaWidths widths = {};
  std::size_t inclusion = 0;              ///< that it belongs to; 0: the deck
  std::vector<LsDynaInclude> names = {};  ///< of *INCLUDE
};

/// What readers of such a file begin with.
class LsDynaDeck {
 public:
  /// @throws Error for a file without keywords, and where files include each other without an end
  explicit LsDynaDeck(const std::filesystem::path& deck);

  /// That were opened, the deck first.
  const std::vector<std::filesystem::path>& files() const { return files_.paths(); }

 protected:
  /// In a keyword: ranges of members.
  static constexpr std::string_view kGenerate = "_GENERATE";
  /// A plain list of members, or ranges of them: of "SET_SOLID" or "SET_NODE".
  static bool is_list(std::string keyword, std::string_view set);
  static bool is_nodes(const LsDynaBlock& block) { return block.keyword == "NODE"; }
  static bool is_solids(const LsDynaBlock& block) { return block.keyword == "ELEMENT_SOLID"; }

  [[noreturn]] void fail(std::string_view where, std::string_view reason) const;

  static std::string_view next_line(const char*& at, const char* end);
  static bool is_comment(std::string_view line);
  /// Lines that are no comments.
  std::vector<std::string_view> lines(const LsDynaBlock& block) const;

  /// Between commas; of fixed width; between blanks, where a field would hold two words.
  void split(std::string_view line, std::size_t first, std::size_t width, std::size_t reals = 0);
  std::string_view field(std::size_t i) const { return i < fields_.size() ? fields_[i] : ""; }
  /// Lines are split from now on as those of a block.
  void use(const LsDynaBlock& block) { now_ = block.widths; }
  const LsDynaWidths& now() const { return now_; }
  std::int64_t integer(std::size_t i, std::string_view line, std::string_view what,
                       std::int64_t low) const;

  /// True for the deck, and for an inclusion that has something of the mesh, or sets of it: its lines
  /// become lines of the deck, and its name goes.
  bool is_inlined(std::size_t inclusion) const { return inclusions_[inclusion].is_inlined; }

  DeckFiles files_;
  LsDynaWidths widths_;                   // of the deck
  std::vector<LsDynaBlock> blocks_;       // those of a file that is included behind its *INCLUDE
  std::vector<std::string> unread_;       // why files of *INCLUDE are not read
  std::vector<std::string_view> fields_;  // of the line that was split last

 private:
  struct Inclusion {
    std::size_t parent = 0;
    const char* place = nullptr;              ///< of its name
    std::optional<LsDynaWidths> widths = {};  ///< empty: as the file that includes it
    bool is_inlined = false;
  };

  void find_blocks(const InputFile& file, std::size_t inclusion);
  std::vector<LsDynaBlock> blocks_of(const InputFile& file, std::size_t inclusion);
  void read_options(std::string_view line, std::size_t inclusion);
  void read_names(LsDynaBlock& block);
  void add_search_path(const LsDynaBlock& block);
  std::filesystem::path path_of(std::string_view name) const;
  void decide();
  void set_widths();

  std::vector<Inclusion> inclusions_;                // 0 is the deck
  std::vector<std::filesystem::path> search_paths_;  // where included files may be

  LsDynaWidths now_;
};

}  // namespace tetmend::formats
