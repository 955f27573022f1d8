// SPDX-License-Identifier: MIT
// What the ranks have of a mesh, slice by slice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "pieces/divided_mesh.h"
#include "pieces/rank_share.h"
#include "pieces/row_source.h"

namespace tetmend::pieces {

/// Which numbers each rank has, when they are numbered through.
class RankRanges {
 public:
  /// All ranks. @param mine how many this one has
  RankRanges(std::uint64_t mine, Ranks& ranks);

  std::uint64_t begin(std::size_t rank) const { return begins_[rank]; }
  std::uint64_t total() const { return begins_.back(); }
  std::uint64_t most() const;  ///< that one rank has
  std::size_t rank_of(std::uint64_t number) const;

 private:
  std::vector<std::uint64_t> begins_;
};

/// Slices of all ranks. A slice has all that it needs of vertices that others have; so all ranks
/// make as many of them, at the same time.
class ShareSlices final : public RowSource {
 public:
  /// All ranks. It must not outlive what it is given.
  /// @throws Error for a required vertex that is not there
  ShareSlices(const RankShare& share, Ranks& ranks);

  /// All ranks: adds all slices, with end_slices().
  /// @throws Error for a vertex that is not there, a repeated one, and a coordinate that is not
  /// finite
  void add_to(DividedMesh& mesh) const;
  ByKind<RowLayout> row_layouts() const override;
  std::uint64_t slice_count(std::size_t tets_of_slice, const Ranks& ranks) const override;
  void for_row_slices(
      std::size_t tets_of_slice, const Ranks& ranks,
      const std::function<void(std::uint64_t number, RowSlice slice)>& use) const override;

 private:
  /// Of a list what one slice has: from where to where.
  using Range = std::pair<std::size_t, std::size_t>;
  struct Slicing {
    std::uint64_t number;  ///< of a slice of this rank
    std::uint64_t count;   ///< of these

    template <class Value>
    Range of(const std::vector<Value>& all) const {
      return {all.size() * number / count, all.size() * (number + 1) / count};
    }
  };

  std::uint64_t slices_of_rank(std::size_t tets_of_slice) const {
    return 1 + tets_.most() / tets_of_slice;
  }
  void note_required();
  std::uint64_t checked(std::uint64_t v) const;
  template <std::size_t N>
  void note(const std::vector<RankShare::Element<N>>& elements, Range range,
            std::vector<VertexId>& ids) const;
  Piece read(const Slicing& slicing, const RowLayout& of_points, std::string& rows) const;
  void number_tets(const Slicing& slicing, Piece& slice) const;
  void fetch(const RowLayout& of_points, Piece& slice, std::string& rows) const;
  std::string answer(const std::string& questions, const RowLayout& of_points) const;

  const RankShare& share_;
  Ranks& ranks_;
  const RankRanges points_;
  const RankRanges tets_;
  std::vector<char> is_required_;
};

}  // namespace tetmend::pieces
