// SPDX-License-Identifier: MIT
// Numbers for points and elements that a deck has none for yet.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace tetmend::formats {

/// Counts on from the greatest number that is taken. Where a file cannot hold so great ones, those
/// between the numbers that are taken come next, the smallest first.
class NewNumbers {
 public:
  using Range = std::pair<std::int64_t, std::int64_t>;  ///< first and last
  using Taken = std::function<std::vector<Range>()>;

  /// @param limits the greatest numbers of programs that read the file, in ascending order: the first
  /// counts that `most` does not exceed
  /// @param taken all numbers that are in use, in any order: asked for at most once
  NewNumbers(std::int64_t most, std::span<const std::int64_t> limits, Taken taken);

  /// @throws Error where none is left
  std::int64_t next();

 private:
  void look_between();

  std::int64_t last_;
  std::int64_t limit_;
  Taken taken_;
  bool is_between_ = false;
  std::vector<Range> ranges_;  // that are ahead, those with the greatest numbers first
};

/// All numbers that lines of an Abaqus deck name, whatever for: "7", "REF NODE=7", below GENERATE
/// "7, 12, 1".
void add_inp_numbers(std::string_view text, std::vector<NewNumbers::Range>& ranges);
/// All that fields of cards of Nastran name: "7", "7 THRU 12".
void add_nastran_numbers(std::string_view cards, std::vector<NewNumbers::Range>& ranges);

}  // namespace tetmend::formats
