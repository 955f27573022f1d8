// SPDX-License-Identifier: MIT
// Files of meshes on their way into pieces and out of them, and what is checked before and after.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tetmend/improve.h>

#include "face/moving_surface.h"
#include "kernel/formats/deck_remarks.h"
#include "pieces/divided_mesh.h"
#include "pieces/file_slices.h"
#include "pieces/piece_run.h"
#include "pieces/rank_share.h"

namespace tetmend::pieces {

/// A mesh that is to be divided. What open_slices() knows is read slice by slice; of others, and where the
/// surface may move and there is more than labels and constraints, the first rank has the arrays of the whole
/// mesh, until they are in pieces.
class InputMesh {
 public:
  /// All ranks. @throws Error as read_mesh(), and for a mesh of second order.
  /// @param files  of formats that only they know; null: none
  InputMesh(const std::filesystem::path& file, Ranks& ranks, const ArrayFiles* files = nullptr,
            const std::string& label_array = {});

  std::uint64_t tets() const { return tets_; }
  std::uint64_t vertices() const { return vertices_; }
  /// There is more than labels and constraints, and that file may have a place for it.
  bool holds_more(const std::filesystem::path& output) const;
  /// First rank: what of the file will not be in that one, a sentence each.
  std::vector<std::string> lost_in(const std::filesystem::path& output) const;
  /// First rank: deck_remarks().
  std::vector<std::string> remarks() const { return deck_remarks(data_); }
  /// All ranks: @throws OptionError, where the arrays are, unless each name is that of one of the tets
  void check_conserve(const std::vector<std::string>& names) const;
  /// All ranks: adds all of it, in slices for so many pieces, with end_slices(). Once.
  void add_to(DividedMesh& mesh, std::size_t pieces);
  /// Before lost_in(), holds_more() and add_to(): the surface may move. Then triangles and edges
  /// have marks for labels where these do not tell all, see SurfaceMarks, and points that are to
  /// stay are marked.
  void set_surface_moves() { surface_moves_ = true; }

 private:
  void read_whole(const std::filesystem::path& file, const std::string& label_array);
  void read_share(const std::filesystem::path& file, Ranks& ranks, const std::string& label_array);
  bool is_of_ranks(const std::filesystem::path& output) const;
  bool carries_arrays(const std::filesystem::path& output) const;

  std::filesystem::path file_;
  std::string label_array_;
  const ArrayFiles* files_ = nullptr;
  std::unique_ptr<FileSlices> slices_;
  bool is_share_ = false;  // of a file that all ranks read together
  std::optional<RankShare> arrays_;
  MeshData data_;
  std::uint64_t tets_ = 0;
  std::uint64_t vertices_ = 0;
  std::uint64_t required_vertices_ = 0;
  bool holds_more_ = false;
  bool has_arrays_ = false;  // all ranks know it
  bool surface_moves_ = false;
  bool is_elsewhere_ = false;  // the first rank has it
};

/// All ranks: adds the mesh, with the tets marked that the options protect.
/// @throws OptionError for a region without a tet
void add_protected(InputMesh& input, const Options& options, DividedMesh& mesh, std::size_t pieces);

/// @throws OptionError for an option that needs the whole mesh in memory.
void check_for_files(const Options& options);
/// @throws Error for inverted tets, and for boundary layers that are to be kept: pieces cannot tell.
void check_before(const Figures& before, const Options& options, const std::filesystem::path& file);
/// How much of a surface a run must keep.
enum class Kept { all, shape, nearness };
Kept kept_by(const face::SurfaceTolerance& surface);

/// Puts the figures into the result. @param side  of the box around the mesh
/// @throws Error when the pieces do not fit.
void check_after(const Measured& before, const Measured& after, Kept kept, double side,
                 Result& result);
/// Of a run that would leave a worse mesh, and gives back its input instead: the figures are those of
/// the input. @returns why, for the notes
/// @param surface  of the input, where it may move
std::string stay_as_it_was(const std::optional<SurfaceChange>& surface, Result& result);

/// Promises are held to them, whether they are asked for or not.
void forget_rulers(Result& result);

/// Options as set_option() takes them: all that decide on the bytes of a run from file to file. A
/// schedule of a file is in them as its text.
using OptionTexts = std::vector<std::pair<std::string, std::string>>;
/// @throws Error for a schedule that cannot be read.
OptionTexts texts_of(const Options& options);

}  // namespace tetmend::pieces
