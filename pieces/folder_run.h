// SPDX-License-Identifier: MIT
// A run whose steps are programs of their own, over the files of a folder: one divides the mesh, one
// works on a piece, one joins what they made and divides anew.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "pieces/out_of_core.h"
#include "pieces/run_folder.h"

namespace tetmend::pieces {

/// What is to be done next.
struct Round {
  std::size_t number = 0;  ///< from 1
  std::string name;        ///< "division 2", "zones 1"
  /// All of the round, and those of them that nobody has finished yet.
  std::vector<std::size_t> pieces, open;
};

class FolderRun {
 public:
  /// Of a folder in which split() has been, or a checkpoint. @throws Error when there is no run.
  /// @param array_files of formats that only they know; null: none
  explicit FolderRun(const std::filesystem::path& folder, const ArrayFiles* array_files = nullptr);

  /// Divides the input for the first round, in so many pieces or fewer: see limited_pieces(). Of
  /// `files` input, output, their formats and what is said of them count.
  /// @throws Error as improve_files(), for a folder that has something already, and while another
  /// program works there; OptionError for less than two pieces.
  static void split(const OutOfCore& files, const std::filesystem::path& folder,
                    const Options& options, const Division& division);

  const SavedRun& saved() const { return saved_; }
  bool is_finished() const { return saved_.is_finished; }
  /// Precondition: it is not finished.
  Round round() const;
  /// Works on some pieces of the round; others may work on others at the same time, also on the same,
  /// which costs time alone. A piece that is finished is left as it is. Nothing is there of one that
  /// was not, when the program is killed.
  /// @param options threads, progress, note, cancel, check_operators and what belongs to a trace; the
  /// rest is that of the run
  /// @param trace_trouble null, or takes why there is no trace, as "FILE: reason"; empty: it is whole
  /// @throws Error when another program begins the next round; for a number that is not of the round;
  /// for a trace of another number of pieces than one, or of one that is finished or not worked on
  /// @return how many were finished; less when it was told to stop
  std::size_t improve(const std::vector<std::size_t>& pieces, const Options& options,
                      std::string* trace_trouble = nullptr);
  /// When all pieces of the round are finished: divides anew for the next one, or checks all and
  /// writes the output. Killed on the way, it can be called again.
  /// @throws Error when a piece is missing, it names them; and when another program works here
  /// @param portrait null, or takes the histograms of the rulers
  /// @return what the run did, when it is finished now
  std::optional<Result> join(const Options& options, face::Portrait* portrait = nullptr);

 private:
  void load_again();
  void open();
  void check_trace(const std::vector<std::size_t>& pieces) const;
  void hold_surface(const face::SurfaceTolerance& surface, PieceRun& steps) const;
  Options options_of_run(const Options& options) const;
  Result finish(const Options& options, face::Portrait* portrait);

  RunFolder folder_;
  SavedRun saved_;
  const ArrayFiles* array_files_ = nullptr;
};

}  // namespace tetmend::pieces
