// SPDX-License-Identifier: MIT
// VTK's format `.vtu`, in all its encodings, read slice by slice.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/vtu_layout.h"
#include "pieces/file_slices.h"

namespace tetmend::pieces {

/// A file of one piece, with tets, triangles, lines and vertices for cells. Labels are those that
/// read_vtu() finds; other arrays are looked at, and not kept.
class VtuSlices final : public FileSlices {
 public:
  /// All ranks: each looks at some of the file, to see whether all of it can be read.
  /// @returns null for another file, or a damaged one: read_mesh() tells what is wrong
  static std::unique_ptr<FileSlices> open(const std::filesystem::path& file,
                                          const std::string& label_array, Ranks& ranks);

  MeshData digest() const override;
  bool has_all_in_rows() const override;
  bool has_only_arrays() const override { return has_all_in_rows(); }
  ByKind<RowLayout> row_layouts() const override;

 protected:
  void read_elements(const Share& of, FileElements& elements) const override;
  void read_vertices(Piece& slice) const override;
  void read_rows(const Share& of, const std::vector<VertexId>& ids,
                 ByKind<std::string>& rows) const override;

 private:
  enum Kind : std::size_t { tets, triangles, edges, points };

  /// Of some cells that follow each other.
  struct CellChunk {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    std::array<std::uint64_t, 4> of_kind{};  ///< how many there are
  };
  /// What is found out about an array.
  struct ArrayKnowledge {
    std::uint64_t has_fractions = 0;
    std::uint64_t is_no_label = 0;  ///< it has a number that is none
    std::uint64_t is_beyond = 0;    ///< an unsigned number above 2^63
    std::uint64_t others_than_0 = 0;
    std::array<double, 2> range = {std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity()};  ///< least, most
    std::vector<double> values;  ///< different ones, as far as they are few

    /// But for the values.
    void join(const ArrayKnowledge& other);
    /// Of `rows` whole numbers no two may be alike.
    bool may_be_identifiers(std::uint64_t rows) const {
      return rows > 2 && values.size() >= std::min<std::uint64_t>(rows, formats::kMostLabels) &&
             range[1] - range[0] + 1 >= static_cast<double>(rows);
    }
  };
  class Cells;

  template <class Begin, class Act>
  void for_cells(const Share& of, const Begin& begin, const Act& act) const;
  template <class Act>
  void for_points(const std::vector<VertexId>& ids, const Act& act) const;
  std::vector<const formats::VtuColumn*> columns(bool of_points) const;
  bool share_outline(Ranks& ranks);
  formats::VtuRows rows_of(const formats::VtuColumn& column, std::uint64_t rows) const {
    return {file_, outline_, layout_, column, rows};
  }
  bool look_at_points(const Ranks& ranks) const;
  bool look_at_cells(Ranks& ranks);
  std::vector<ArrayKnowledge> look_at_arrays(const std::vector<formats::VtuColumn>& columns,
                                             std::uint64_t rows, Ranks& ranks, bool& is_good) const;
  bool choose_labels(const std::string& label_array, Ranks& ranks);
  void note_identifiers(const std::vector<formats::VtuColumn>& columns, std::uint64_t rows,
                        const std::vector<ArrayKnowledge>& known);
  bool collect_labels(Ranks& ranks);

  std::filesystem::path file_;
  formats::VtuOutline outline_;
  formats::VtuLayout layout_;
  std::uint64_t corners_ = 0;  // of all cells
  std::vector<CellChunk> chunks_;
  std::optional<std::size_t> cell_labels_;   // which of the arrays
  std::optional<std::size_t> point_labels_;  // likewise; none where all are 0
  std::uint64_t labelled_points_ = 0;
  std::array<std::set<Label>, 4> labels_;  // that each kind has
  std::uint64_t loose_points_ = 0;         // cells
  std::vector<std::string> notes_;
};

}  // namespace tetmend::pieces
