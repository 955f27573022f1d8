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

/// A slice, and what there is in arrays for each of its points and elements.
struct RowSlice {
  Piece piece;  ///< its ids are numbers in the file
  ByKind<std::string> rows;
};

class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual ByKind<RowLayout> row_layouts() const { return {}; }
  /// Of all ranks, about so many tets in each.
  virtual std::uint64_t slice_count(std::size_t tets_of_slice, const Ranks& ranks) const = 0;
  /// Calls use(number, slice) for the slices of this rank. Each has them from slice_count() times its number
  /// by the number of ranks on.
  virtual void for_row_slices(
      std::size_t tets_of_slice, const Ranks& ranks,
      const std::function<void(std::uint64_t number, RowSlice slice)>& use) const = 0;
};

}  // namespace tetmend::pieces
