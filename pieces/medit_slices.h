// SPDX-License-Identifier: MIT
// MEDIT's binary format `.meshb`, read and written slice by slice: never all of it in memory.
#pragma once

#include <filesystem>
#include <optional>

#include "pieces/divided_mesh.h"

namespace tetmend::pieces {

/// What a file has.
struct FileCounts {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t triangles = 0;
  std::uint64_t edges = 0;
  std::uint64_t required_vertices = 0;
};

/// A file of version 2 to 4, in this machine's byte order, with vertices, edges, triangles, tets and
/// required vertices alone. Others are read as a whole, see read_mesh().
class MeditSlices {
 public:
  /// Nothing for any other file, also one that cannot be read: read_mesh() tells why.
  static std::optional<MeditSlices> open(const std::filesystem::path& file);

  const FileCounts& counts() const { return counts_; }
  /// All ranks: each adds its share, about so many tets at a time. Without end_slices().
  /// @throws Error when the file ends too early, or has a number out of range.
  void add_to(DividedMesh& mesh, std::size_t tets_of_slice) const;

 private:
  struct Section {
    std::uint64_t begin = 0;  ///< of its first row
    std::uint64_t rows = 0;
  };

  bool list_sections();
  std::uint64_t integer_size() const { return version_ == 4 ? 8 : 4; }
  template <class Integer>
  Piece read_slice(std::uint64_t i, std::uint64_t slices) const;

  std::filesystem::path file_;
  int version_ = 0;
  FileCounts counts_;
  Section vertices_, edges_, triangles_, tets_, required_;
};

/// All ranks: the first writes the stored pieces to a `.meshb` file, byte for byte as write_mesh()
/// writes what join() gives. Takes a quarter of a byte for each vertex and what two pieces take.
/// @throws Error as write_mesh().
void write_medit_slices(const std::filesystem::path& file, const DividedMesh& mesh);

}  // namespace tetmend::pieces
