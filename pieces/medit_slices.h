// SPDX-License-Identifier: MIT
// MEDIT's binary format `.meshb`, read and written slice by slice: never all of it in memory.
#pragma once

#include <filesystem>
#include <memory>

#include "pieces/file_slices.h"

namespace tetmend::pieces {

/// A file of version 2 to 4, in this machine's byte order, with vertices, edges, triangles, tets and
/// required vertices alone. Others are read as a whole, see read_mesh().
class MeditSlices final : public FileSlices {
 public:
  /// Null for any other file, also one that cannot be read: read_mesh() tells why.
  static std::unique_ptr<FileSlices> open(const std::filesystem::path& file);

 protected:
  void read_elements(const Share& of, FileElements& elements) const override;
  void read_vertices(Piece& slice) const override;

 private:
  struct Section {
    std::uint64_t begin = 0;  ///< of its first row
    std::uint64_t rows = 0;
  };

  bool list_sections();
  std::uint64_t integer_size() const { return version_ == 4 ? 8 : 4; }
  template <class Integer>
  void read_elements_of(const Share& of, FileElements& elements) const;
  template <class Integer>
  void read_vertices_of(Piece& slice) const;

  std::filesystem::path file_;
  int version_ = 0;
  Section vertices_, edges_, triangles_, tets_, required_;
};

/// All ranks: the first writes the stored pieces to a `.meshb` file, byte for byte as write_mesh()
/// writes what join() gives. Takes a quarter of a byte for each vertex and what two pieces take.
/// @throws Error as write_mesh().
void write_medit_slices(const std::filesystem::path& file, const DividedMesh& mesh);

}  // namespace tetmend::pieces
