// SPDX-License-Identifier: MIT
// Numbers for points and elements that a deck has none for yet.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Counts on from the greatest number that is taken. Where a file cannot hold so great ones, those
/// between the numbers that are taken come next, the smallest first.
class NewNumbers {
 public:
  using Taken = std::function<std::vector<NumberRange>()>;

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
  std::vector<NumberRange> ranges_;  // that are ahead, those with the greatest numbers first
};

/// Numbers that nothing has, and nothing of the file had. Both lists must outlive them.
/// @param known    of what there is, in any order; 0 is none
/// @param of_file  MeshData::taken_point_numbers or taken_element_numbers
/// @param most     no number up to this one comes before the limit is reached
/// @param more     as for NewNumbers, beside those in the lists; may be empty
NewNumbers numbers_beside(std::span<const std::int64_t> known, std::span<const NumberRange> of_file,
                          std::span<const std::int64_t> limits, std::int64_t most = 0,
                          NewNumbers::Taken more = {});
/// The next ones for those that are 0 or less.
void complete(std::vector<std::int64_t>& numbers, NewNumbers& next);

/// Notes all numbers of a mesh that was read, before anything of it goes, as taken. Cost: linear in
/// points and elements, and that of sorting where their numbers do not ascend.
void note_taken_numbers(MeshData& mesh);

/// All numbers that lines of an Abaqus deck name, whatever for: "7", "REF NODE=7", below GENERATE
/// "7, 12, 1".
void add_inp_numbers(std::string_view text, std::vector<NumberRange>& ranges);
/// All that fields of cards of Nastran name: "7", "7 THRU 12".
void add_nastran_numbers(std::string_view cards, std::vector<NumberRange>& ranges);

}  // namespace tetmend::formats
