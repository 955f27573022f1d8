// SPDX-License-Identifier: MIT
// A mesh with arrays that comes slice by slice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "pieces/piece.h"
#include "pieces/ranks.h"
#include "pieces/rows.h"

namespace tetmend::pieces {

/// Some things of a file, by their numbers there.
struct FileRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;

  std::uint64_t size() const { return end - begin; }
  bool has(std::uint64_t i) const { return i >= begin && i < end; }
  /// Of `count` things those of slice `i`.
  static FileRange of_slice(std::uint64_t count, std::uint64_t i, std::uint64_t slices) {
    return {count * i / slices, count * (i + 1) / slices};
  }
};

/// A slice, and what there is in arrays for each of its points and elements.
struct RowSlice {
  Piece piece;  ///< its ids are numbers in the file
  ByKind<std::string> rows;
};

class RowSource {
 public:
  virtual ~RowSource() = default;
  /// Where vertices have rows, the own vertices of a slice are those of FileRange::of_slice().
  virtual ByKind<RowLayout> row_layouts() const { return {}; }
  /// What a vertex has that the file does not have.
  virtual std::string row_of_new_vertex() const { return {}; }
  /// Of all ranks, about so many tets in each.
  virtual std::uint64_t slice_count(std::size_t tets_of_slice, const Ranks& ranks) const = 0;
  /// Calls use(number, slice) for the slices of this rank. Each has them from slice_count() times its number
  /// by the number of ranks on.
  virtual void for_row_slices(
      std::size_t tets_of_slice, const Ranks& ranks,
      const std::function<void(std::uint64_t number, RowSlice slice)>& use) const = 0;
};

}  // namespace tetmend::pieces
