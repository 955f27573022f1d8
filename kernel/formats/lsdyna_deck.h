// SPDX-License-Identifier: MIT
// A keyword file of LS-DYNA by its keywords, lines and fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/formats/input_file.h"
#include "kernel/formats/lsdyna.h"

namespace tetmend::formats {

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> beginnings);

/// False for keywords whose whole numbers may be nodes.
bool names_no_nodes(std::string_view keyword);

/// Lines from a keyword up to the next one.
struct LsDynaBlock {
  std::string keyword;  ///< in capitals, without '*'; empty: what stands before the first
  const char* begin;
  const char* content;  ///< behind the line of the keyword
  const char* end;
  LsDynaWidths widths = {};
};

/// What readers of such a file begin with.
class LsDynaDeck {
 public:
  /// @throws Error for a file without keywords
  explicit LsDynaDeck(const InputFile& file) : file_(file) { find_blocks(); }

 protected:
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

  const InputFile& file_;
  LsDynaWidths widths_;
  std::vector<LsDynaBlock> blocks_;
  std::vector<std::string_view> fields_;  // of the line that was split last

 private:
  void find_blocks();
  void read_options(std::string_view line);

  LsDynaWidths now_;
};

}  // namespace tetmend::formats
