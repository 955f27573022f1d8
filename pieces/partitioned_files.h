// SPDX-License-Identifier: MIT
// A mesh in several files, a part in each: all ranks read some and write some. None has all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "pieces/rank_share.h"
#include "pieces/ranks.h"

namespace tetmend::pieces {

/// All ranks: divides the stored pieces of a mesh once, to be parts.
void divide_into_parts(DividedMesh& mesh, std::size_t parts);

/// `.pvtu` of VTK with its `.vtu` files. Those that are written lie in a folder of the name of the file
/// without its ending, a piece in each, and name their points by an array `GlobalNodeId`. Where files
/// that are read have no such array, points of several at one place, bit for bit, are one. Ghost cells
/// (`vtkGhostType`) go. Arrays are kept that all parts have; others are named in notes.
class PvtuFiles final : public ArrayFiles {
 public:
  /// @param ranks must outlive it
  explicit PvtuFiles(Ranks& ranks) : ranks_(ranks) {}
  bool is_one(const std::filesystem::path& file) const override;
  RankShare read(const std::filesystem::path& file, const std::string& label_array) const override;
  void write(const std::filesystem::path& file, const RankShare& arrays) const override;
  /// The file that names the parts is the last to get its name.
  void write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                    const CarriedRows* rows) const override;
  formats::FileSet files_read(const std::filesystem::path& file) const override;
  formats::FileSet files_written(const std::filesystem::path& file) const override;
  void check_output(const std::filesystem::path& file) const override;
  bool is_in_parts(const std::filesystem::path&) const override { return true; }
  bool has_required_vertices(const std::filesystem::path&) const override { return false; }
  bool takes(const std::filesystem::path&, RowKind kind, const DataArray& array) const override;

 private:
  Ranks& ranks_;
};

/// Gmsh's files of partitions: `part_%d.msh` stands for `part_1.msh`, `part_2.msh` and so on, as far as
/// there are any. They name points by numbers of the whole mesh, and have labels alone; other contents
/// are named in notes.
class GmshParts final : public ArrayFiles {
 public:
  /// @param ranks must outlive it
  explicit GmshParts(Ranks& ranks) : ranks_(ranks) {}
  bool is_one(const std::filesystem::path& file) const override;
  RankShare read(const std::filesystem::path& file, const std::string& label_array) const override;
  void write(const std::filesystem::path& file, const RankShare& arrays) const override;
  /// Part 1 is the last to get its name: without it there is no mesh for those who read. Further parts
  /// of an older mesh go.
  void write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                    const CarriedRows* rows) const override;
  formats::FileSet files_read(const std::filesystem::path& file) const override;
  formats::FileSet files_written(const std::filesystem::path& file) const override;
  void check_output(const std::filesystem::path& file) const override;
  bool is_in_parts(const std::filesystem::path&) const override { return true; }
  bool has_required_vertices(const std::filesystem::path&) const override { return false; }

 private:
  Ranks& ranks_;
};

}  // namespace tetmend::pieces
