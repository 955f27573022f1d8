// SPDX-License-Identifier: MIT
// From the numbers that a file gives to its vertices or elements to their places in that order.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "pieces/ranks.h"

namespace tetmend::pieces {

/// Numbers of some rows of a file that follow each other.
struct NumberFacts {
  std::int64_t least = 0;
  std::int64_t most = 0;
  std::uint64_t rows = 0;
  std::uint64_t ascend = 1;  ///< 0: they do not
};

/// Of all rows, wherever they stand. Takes an eighth of a byte for each number between the least and
/// the greatest, and nothing if they ascend without gaps.
class NumberOrder {
 public:
  /// Calls add(number) for each number of some rows.
  using List = std::function<void(std::size_t chunk, const std::function<void(std::int64_t)>& add)>;

  /// All ranks.
  /// @param chunks all there are, in the order of the file
  /// @param list the numbers of one of them; called for a range of chunks on each rank
  /// @param are_names things are looked for by their numbers: nothing else is asked for otherwise
  /// @returns nothing where a number is there twice, or gaps take most of the room
  static std::optional<NumberOrder> make(std::span<const NumberFacts> chunks, const List& list,
                                         bool are_names, Ranks& ranks);

  /// Rows have the order of their numbers. Of those that are no names, no place is known then.
  bool is_that_of_rows() const { return ascends_; }
  bool has(std::int64_t number) const;
  /// Precondition: has(number).
  std::uint64_t place(std::int64_t number) const;

 private:
  static constexpr std::uint64_t kBits = 32;   // of a word
  static constexpr std::uint64_t kWords = 16;  // between two sums

  bool bit(std::uint64_t i) const { return (words_[i / kBits] >> (i % kBits) & 1U) != 0; }

  std::int64_t least_ = 0;
  std::uint64_t range_ = 0;  // from the least to the greatest
  bool ascends_ = true;
  std::vector<std::uint32_t> words_;  // none: each number is there
  std::vector<std::uint64_t> sums_;   // of the bits before each kWords words
};

/// Of `chunks` those that one rank looks at: [begin, end).
struct ChunkShare {
  ChunkShare(std::size_t chunks, const Ranks& ranks)
      : begin(chunks * ranks.number() / ranks.count()),
        end(chunks * (ranks.number() + 1) / ranks.count()) {}
  std::size_t begin, end;
};

}  // namespace tetmend::pieces
