// SPDX-License-Identifier: MIT
// MEDIT's binary format `.meshb`, read and written slice by slice: never all of it in memory.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kernel/formats/medit_marks.h"
#include "kernel/formats/medit_vectors.h"
#include "pieces/carried_rows.h"
#include "pieces/file_slices.h"

namespace tetmend::pieces {

/// A file of version 2 to 4, in this machine's byte order, with vertices, edges, triangles, tets,
/// required vertices, and what rows tell: marks, a bit for each kind of them, and normals and tangents, of
/// which a vertex has one. Others are read as a whole, see read_mesh().
class MeditSlices final : public FileSlices {
 public:
  /// All ranks. Null for any other file, also one that cannot be read, or has elements that are dropped:
  /// read_mesh() tells why.
  static std::unique_ptr<FileSlices> open(const std::filesystem::path& file, Ranks& ranks);

  MeshData digest() const override;
  bool has_all_in_rows() const override { return true; }
  ByKind<RowLayout> row_layouts() const override;
  std::string row_of_new_vertex() const override;

 protected:
  void read_elements(const Share& of, FileElements& elements) const override;
  void read_vertices(Piece& slice) const override;
  void read_rows(const Share& of, const std::vector<VertexId>& ids,
                 ByKind<std::string>& rows) const override;

 private:
  struct Section {
    std::uint64_t begin = 0;  ///< of its first row
    std::uint64_t rows = 0;
  };

  struct VectorSections {
    Section vectors, at;
  };

  bool list_sections();
  Section* section_of(std::int32_t keyword);
  bool are_marks_sound() const;
  bool are_vertices_sound(const Ranks& ranks) const;
  bool are_elements_sound(const Section& section, std::size_t vertices, const Ranks& ranks) const;
  std::vector<std::uint64_t> numbers(const Section& section, std::size_t width) const;
  bool has_marks(int dimension) const;
  void add_vectors(std::size_t kind, const std::vector<VertexId>& ids,
                   ByKind<std::string>& rows) const;
  std::uint64_t integer_size() const { return version_ == 4 ? 8 : 4; }
  template <class Integer>
  void read_elements_of(const Share& of, FileElements& elements) const;
  template <class Integer>
  void read_vertices_of(Piece& slice) const;

  std::filesystem::path file_;
  int version_ = 0;
  Section vertices_, edges_, triangles_, tets_, required_;
  std::array<Section, formats::kMeditMarks.size()> marks_;
  std::array<VectorSections, formats::kMeditVectors.size()> vectors_;
};

/// All ranks: the first writes the stored pieces to a `.meshb` file, byte for byte as write_mesh()
/// writes what join() gives. Takes a quarter of a byte for each vertex and what two pieces take.
/// @param rows  of a MeditSlices; null: none. Of what they mark the first rank has a list.
/// @throws Error as write_mesh().
void write_medit_slices(const std::filesystem::path& file, const DividedMesh& mesh,
                        const CarriedRows* rows = nullptr);

}  // namespace tetmend::pieces
