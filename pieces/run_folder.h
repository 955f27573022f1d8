// SPDX-License-Identifier: MIT
// A run whose pieces lie in a folder between its steps, so that it can go on from there: after a
// crash, with more processes or fewer, or by programs that each work on one piece.
//
//   FOLDER/run         what is known between two steps; takes its name when all its pieces are there
//   FOLDER/surface     of a surface that may move, as the input has it
//   FOLDER/step-3/...  the pieces: gathered ones for the third step, stored ones after it
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/formats/run_files.h"
#include "pieces/mesh_files.h"
#include "pieces/piece_run.h"

namespace tetmend::pieces {

/// What the file `run` holds, in this machine's byte order.
struct SavedRun {
  std::string input;  ///< absolute path
  std::string output;
  std::uint64_t input_size = 0;  ///< bytes
  std::uint64_t vertices = 0;    ///< of the input
  bool holds_more = false;       ///< it has more than labels and constraints
  std::string label_array;       ///< see read_mesh()
  std::string variant;           ///< of the output
  OptionTexts options;
  Division division;
  Figures before;
  RunState run;
  DivisionState mesh;
  bool is_finished = false;  ///< the output is written, and no piece is there any more
};

class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  /// All that a run makes and removes here.
  formats::FileSet files() const;
  bool has_run() const;
  /// @throws Error when it cannot be read, or was written by another version of tetmend.
  SavedRun load() const;
  /// From now on this is the state, and the pieces of other steps go.
  void save(const SavedRun& run) const;
  /// Of a surface that may move, see PieceRun::hold_surface(): before the first state, and for good.
  void save_surface(const std::string& bytes) const;
  /// @throws Error when it is not there
  std::string load_surface() const;
  /// The folder with the pieces of a state.
  std::filesystem::path pieces_of(const RunState& run) const { return step(step_of(run)); }
  static std::size_t step_of(const RunState& run) {
    return run.records.size() + (run.is_divided ? 1 : 0);
  }
  std::filesystem::path step(std::size_t number) const;
  /// A new one, empty.
  std::filesystem::path make_step(std::size_t number) const;
  /// All that a run has left here; the folder goes, too, if it is empty then.
  void remove() const;

 private:
  void remove_steps_but(std::size_t number) const;

  std::filesystem::path folder_;
};

}  // namespace tetmend::pieces
