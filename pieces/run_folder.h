// SPDX-License-Identifier: MIT
// A run whose pieces lie in a folder between its steps, so that it can go on from there: after a
// crash, with more processes or fewer, or by programs that each work on one piece.
//
//   FOLDER/run         what is known between two steps; takes its name when all its pieces are there
//   FOLDER/surface     of a surface that may move, as the input has it
//   FOLDER/lock        whoever works on the run holds it; says whether the folder was there before
//   FOLDER/step-3/...  the pieces: gathered ones for the third step, stored ones after it
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/formats/run_files.h"
#include "pieces/mesh_files.h"
#include "pieces/piece_run.h"
#include "pieces/sealed_shelf.h"

namespace tetmend::pieces {

/// By which a file is known again. Of a mesh in several files: the named one alone.
struct FileIdentity {
  std::uint64_t size = 0;  ///< bytes
  std::uint32_t checksum = 0;
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};
/// All ranks; the first one reads the file.
FileIdentity identify(const std::filesystem::path& file, Ranks& ranks);

/// What the file `run` holds, in this machine's byte order.
struct SavedRun {
  std::string input;  ///< absolute path
  std::string output;
  FileIdentity input_content;
  FileIdentity size_content;   ///< of the file that has the wanted lengths, if there is one
  std::uint64_t vertices = 0;  ///< of the input
  bool holds_more = false;     ///< it has more than labels and constraints
  std::string label_array;     ///< see read_mesh()
  std::string variant;         ///< of the output
  bool asks_for_goal = false;  ///< whoever began the run named a goal
  OptionTexts options;
  Division division;
  Measured before;
  RunState run;
  DivisionState mesh;
  bool is_finished = false;  ///< the output is written, and no piece is there any more
};

/// The same for all files of a run; another mesh or other options have another number.
std::uint32_t number_of(const SavedRun& saved);
/// @throws Error when the bytes end too early, or say what no run does.
SavedRun take_run(std::string_view bytes);

/// While it lives, no other program works on the run of a folder, or only some that are as this one. A
/// folder that it has made goes with it if nothing else is there then. Where the file system knows no
/// locks, it keeps nobody away.
class FolderLock {
 public:
  /// Makes the folder where there is none. @throws Error when another program works there.
  FolderLock(const std::filesystem::path& folder, platform::Sharing sharing);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// The folder was not there before the run.
  bool made_folder() const { return made_folder_; }

 private:
  std::filesystem::path folder_;
  bool made_folder_ = false;
  platform::Descriptor file_;
};

class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  /// All that a run makes and removes here.
  formats::FileSet files() const;
  bool has_run() const;
  /// Whether there is nothing but perhaps a lock.
  bool is_empty() const;
  /// @throws Error when it cannot be read, is damaged, or was written by another version of tetmend.
  SavedRun load() const;
  /// From now on this is the state, and the pieces of other steps go.
  void save(const SavedRun& run) const;
  /// Of a surface that may move, see PieceRun::hold_surface(): before the first state, and for good.
  void save_surface(const SavedRun& run, const std::string& bytes) const;
  /// @throws Error when it is not there, or damaged
  std::string load_surface(const SavedRun& run) const;
  /// The pieces of a state.
  SealedShelf pieces_of(const SavedRun& run) const { return step(step_of(run.run), run); }
  static std::size_t step_of(const RunState& run) {
    return run.records.size() + (run.is_divided ? 1 : 0);
  }
  SealedShelf step(std::size_t number, const SavedRun& run) const;
  /// A new folder for these, empty.
  std::filesystem::path make_step(std::size_t number) const;
  /// make_step() and step()
  SealedShelf new_step(std::size_t number, const SavedRun& run) const;
  /// All that a run has left here but for the lock.
  void clear() const;

 private:
  SealedShelf root(std::uint32_t run) const;
  void remove_steps_but(std::size_t number) const;

  std::filesystem::path folder_;
};

}  // namespace tetmend::pieces
