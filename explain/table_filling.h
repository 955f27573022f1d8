// SPDX-License-Identifier: MIT
// Algorithm 2 at work: the cells of the tables one after the other, as pages and the viewer fill them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "explain/shell_picture.h"
#include "trace/trace_file.h"

namespace tetmend::explain {

/// The pocket from place i on to place j, which is d places further, d from 2 on.
struct TableCell {
  unsigned i = 0, j = 0, d = 0;
};

/// All but the sides, in the order of Algorithm 2: diagonal by diagonal.
std::vector<TableCell> cells_of(const PocketTables& tables);

/// A third corner that Algorithm 2 looks at for a cell, with the worst quality that it would give.
struct CellChoice {
  unsigned k = 0;
  Quality quality = 0;  ///< 0: none
};
std::vector<CellChoice> choices_of(const PocketTables& tables, const TableCell& cell);

/// How far the tables are filled.
struct TableFilling {
  std::vector<TableCell> cells;
  std::size_t filled = 0;
  bool is_under_way = false;  ///< else they are full, and stay so

  bool is_filled(unsigned i, unsigned j) const;
  /// The cell that was filled last; nothing before the first, and when they are full to stay so.
  std::optional<TableCell> here() const;
};
TableFilling full_tables(const PocketTables& tables);

/// A call fills the tables of its shell right when it begins. Recursions search nothing themselves.
bool fills_tables(const Call& call, std::uint64_t position);

/// What is to be said of it: the cell, what it was chosen from, and the result.
std::string to_text(const ShellPicture& shell, const TableFilling& filling);

/// How many are filled after the next whole diagonal; nothing when there is none.
std::optional<std::size_t> after_diagonal(const TableFilling& filling);

}  // namespace tetmend::explain
