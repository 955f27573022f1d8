// SPDX-License-Identifier: MIT
// Files of meshes on their way into pieces and out of them, and what is checked before and after.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tetmend/improve.h>

#include "pieces/divided_mesh.h"
#include "pieces/medit_slices.h"
#include "pieces/piece_run.h"
#include "pieces/rank_share.h"

namespace tetmend::pieces {

/// A mesh that is to be divided. `.meshb` is read slice by slice; of other formats the first rank has
/// the arrays of the whole mesh, until they are in pieces.
class InputMesh {
 public:
  /// All ranks. @throws Error as read_mesh(), and for a mesh that has more than labels and
  /// constraints.
  /// @param files  of formats that only they know; null: none
  InputMesh(const std::filesystem::path& file, Ranks& ranks, const ArrayFiles* files = nullptr);

  std::uint64_t tets() const { return tets_; }
  std::uint64_t vertices() const { return vertices_; }
  /// All ranks: adds all of it, in slices for so many pieces, with end_slices(). Once.
  void add_to(DividedMesh& mesh, std::size_t pieces);

 private:
  std::optional<MeditSlices> slices_;
  std::optional<RankShare> arrays_;
  MeshData data_;
  std::uint64_t tets_ = 0;
  std::uint64_t vertices_ = 0;
};

/// All ranks: the first writes the stored pieces. `vertices`: of the file that was read.
/// @throws Error as write_mesh()
void write_pieces(const std::filesystem::path& file, DividedMesh& mesh, std::uint64_t vertices,
                  const ArrayFiles* files = nullptr);

/// @throws OptionError for an option that needs the whole mesh in memory.
void check_for_files(const Options& options);
/// @throws Error for inverted tets, and for boundary layers that are to be kept: pieces cannot tell.
void check_before(const Figures& before, const Options& options, const std::filesystem::path& file);
/// Puts the figures into the result. @throws Error when the pieces do not fit.
void check_after(const Figures& before, const Figures& after, Result& result);
/// What a run says when the mesh would have become worse, and stays.
std::string why_as_it_was(const Result& result);

/// Options as set_option() takes them: all that decide on the bytes of a run from file to file. A
/// schedule of a file is in them as its text.
using OptionTexts = std::vector<std::pair<std::string, std::string>>;
/// @throws Error for a schedule that cannot be read.
OptionTexts texts_of(const Options& options);

}  // namespace tetmend::pieces
