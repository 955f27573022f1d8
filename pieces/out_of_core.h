// SPDX-License-Identifier: MIT
// Improves a mesh that does not fit into memory: from file to file, the pieces in a folder.
#pragma once

#include <filesystem>

#include <tetmend/improve.h>

#include "pieces/piece_run.h"

namespace tetmend::pieces {

/// What a run from file to file is to use.
struct OutOfCore {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path scratch;  ///< folder for the pieces, which is there
  std::uint64_t memory = 0;       ///< bytes; for the number of pieces, where that is not given
  /// Changes each piece before it is stored, as a fault would: for tests of the final check.
  std::function<void(std::size_t part, Piece& piece)> fault = {};
};

/// The output has the bytes of improve() with the same number of pieces. Only of `.meshb` files no
/// more than a piece is ever in memory; of other formats the arrays of the whole mesh are, while it
/// is read and while it is written.
/// @param division  0 pieces: as many as the memory asks for; the number that it was then
/// @throws OptionError for an option that needs the whole mesh: protect, only, keep_size, conserve,
/// ignore_interior, trace, check_operators; Error as improve(), and for a mesh that has more than
/// labels and constraints, inverted tets, or boundary layers that are to be kept.
Result improve_files(const OutOfCore& files, const Options& options, Division& division);

}  // namespace tetmend::pieces
