// SPDX-License-Identifier: MIT
// Brings what a file holds in arrays over to the stored pieces of the improved mesh, where no rank has all
// of it. The values are those of face/carry.h, bit for bit.
//
//   the file by slices -> old tets, their vertices and rows, by parts of space
//   the stored pieces  -> questions: the row of that number, or what is at that place
//   each part          -> answers: rows
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "pieces/divided_mesh.h"
#include "pieces/row_source.h"
#include "pieces/shelf.h"

namespace tetmend::pieces {

/// Rows of all points and elements of the stored pieces that a rank has.
class CarriedRows {
 public:
  /// All ranks. Precondition: `source` is the file that the mesh was read from, and its surface is fixed.
  /// @param tets_of_slice,parts  how much is in memory at a time. They cannot show in the values.
  /// @param conserve  see Options
  /// @param shelf  where the rows are put; it must outlive this
  /// @throws Error when the file has changed
  CarriedRows(const RowSource& source, const DividedMesh& mesh, std::size_t tets_of_slice,
              std::size_t parts, std::span<const std::string> conserve, Shelf& shelf);

  const RowLayout& layout(RowKind kind) const { return layouts_[kind]; }
  /// What the things of a stored piece from `begin` to `end` have in an array.
  /// Precondition: this rank has the piece.
  std::string column(RowKind kind, std::size_t part, std::size_t array, std::size_t begin,
                     std::size_t end) const;
  /// Of each array how, and what that did to its integral. The same on all ranks.
  const std::vector<CarriedArray>& report() const { return report_; }

 private:
  ByKind<RowLayout> layouts_;
  std::vector<CarriedArray> report_;
  Shelf& shelf_;
};

}  // namespace tetmend::pieces
