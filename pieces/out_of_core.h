// SPDX-License-Identifier: MIT
// Improves a mesh from file to file in pieces: one that does not fit into memory, on one rank or many.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "face/portrait.h"
#include "pieces/piece_run.h"
#include "pieces/rank_share.h"
#include "pieces/ranks.h"
#include "pieces/shelf.h"

namespace tetmend::pieces {

/// What a run took; the same on all ranks.
struct RunCosts {
  std::size_t ranks = 0;
  std::vector<Traffic> divisions;  ///< of all ranks together; seconds: of the slowest
  std::vector<PartTime> parts;     ///< by rank
  double writing = 0;              ///< seconds of this rank, with what is brought over

  /// That came from another rank, for each tet and division.
  double bytes_a_tet() const;
};

/// What a run from file to file is to use. All ranks see the same files.
struct OutOfCore {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path scratch;  ///< folder of this rank for the pieces; empty: they are in memory
  std::uint64_t memory = 0;       ///< bytes; for the number of pieces, where that is not given
  /// Folder that has the pieces after each step: where there is a run of these files and options, it
  /// goes on from there. Empty: none. What is in it goes when the output is there.
  std::filesystem::path checkpoint = {};
  const ArrayFiles* array_files = nullptr;  ///< of formats that only they know; null: none
  std::string label_array = {};             ///< of the input, see read_mesh()
  std::string variant = {};                 ///< of the output, see MeshView::variant()
  bool asks_for_goal = false;               ///< whoever began a run of tasks named a goal
  /// First rank: told what of the input will not be in the output, a sentence each; may throw.
  std::function<void(const std::vector<std::string>&)> tell_lost = {};
  RunCosts* costs = nullptr;           ///< null, or where they are put
  face::Portrait* portrait = nullptr;  ///< null, or takes the histograms of the rulers
  bool needs_trace = false;  ///< without the trace that was asked for, nothing is written: an Error
  VertexId first_id = 0;     ///< of the file's vertices in pieces; cannot show: for tests of that
  /// Changes each piece before it is stored, as a fault would: for tests of the final check.
  std::function<void(std::size_t part, Piece& piece)> fault = {};
};

/// All ranks; what they return is the same but for times, and `carried`, which is on the first. The
/// output has the bytes of improve() with the same number of pieces. Of `.meshb`, `.msh` and `.vtu`
/// files and of those of array_files no rank has all in memory, nor of arrays that go from such a
/// file to `.vtu` or one of array_files; of others, and of whatever else there is besides labels
/// and constraints, the first rank has the whole mesh, while it is read and while it is written.
/// @param division  0 pieces: as many as the memory asks for, or one for each 4 million tets; the
/// number that it was then. With one piece the first rank works alone, as improve() does.
/// @throws OptionError for an option that needs the whole mesh: keep_size, ignore_interior; Error as
/// improve(), and for inverted tets, or boundary layers that are to be kept.
Result improve_files(const OutOfCore& files, const Options& options, Division& division,
                     Ranks& ranks);

}  // namespace tetmend::pieces
