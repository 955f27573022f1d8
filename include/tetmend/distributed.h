// SPDX-License-Identifier: MIT
// Improves a mesh whose arrays lie on many processes. None of them ever has the whole mesh.
//
//   MyRanks ranks(MPI_COMM_WORLD);              // gather, add and exchange by what the program has
//   tetmend::RankArrays mine = ...;             // some points, some tets, numbers of the whole mesh
//   tetmend::Result result = tetmend::improve(mine, ranks, {.threads = 8});
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/improve.h>

namespace tetmend {

/// How the processes that work on a mesh together talk to each other; docs/pieces.md has them for
/// MPI. All ranks call the same functions in the same order; each call ends when all have made it.
/// Calls come from one thread at a time.
class TETMEND_API Ranks {
 public:
  virtual ~Ranks();
  virtual std::size_t count() const = 0;   ///< at least 1
  virtual std::size_t number() const = 0;  ///< of this one, from 0
  /// What each rank gives, by rank; all get the same.
  virtual std::vector<std::string> gather(std::string_view mine) = 0;
  /// In place, element by element, over all ranks. Whole numbers: in which order they are added
  /// cannot show.
  virtual void add(std::span<std::int64_t> sums) = 0;
  /// `to[r]` goes to rank r; what came from each rank.
  virtual std::vector<std::string> exchange(std::vector<std::string> to) = 0;

  /// Of the ranks the one that does what one alone must do.
  bool is_first() const { return number() == 0; }
  /// Ends when all have come here.
  void meet();
  /// Whether it is true on any rank.
  bool any(bool here);
};

/// A process on its own.
class TETMEND_API OneRank final : public Ranks {
 public:
  std::size_t count() const override { return 1; }   ///< itself
  std::size_t number() const override { return 0; }  ///< the first
  /// What it gives.
  std::vector<std::string> gather(std::string_view mine) override;
  /// Nothing is there to be added.
  void add(std::span<std::int64_t> sums) override;
  /// What it sends to itself.
  std::vector<std::string> exchange(std::vector<std::string> to) override;
};

/// What one rank has of a mesh. The vertices of the whole mesh are numbered from 0: those of the
/// first rank in their order, then those of the next. Elements name vertices by these numbers,
/// whoever has them. A rank may have nothing. Labels: one for each entity, or none.
struct RankArrays {
  std::vector<std::array<double, 3>> points = {};            ///< coordinates
  std::vector<std::int32_t> point_labels = {};               ///< carried along
  std::vector<std::array<std::uint64_t, 4>> tets = {};       ///< of positive volume
  std::vector<std::int32_t> tet_labels = {};                 ///< regions; faces between two stay
  std::vector<std::array<std::uint64_t, 3>> triangles = {};  ///< constraints; see MeshArrays
  std::vector<std::int32_t> triangle_labels = {};            ///< carried along
  std::vector<std::array<std::uint64_t, 2>> edges = {};      ///< constraints
  std::vector<std::int32_t> edge_labels = {};                ///< carried along
  std::vector<std::uint64_t> required_vertices = {};         ///< must neither move nor vanish
};

/// How a mesh on ranks is divided.
struct Pieces {
  /// Number of pieces, 2 or more; the result depends on it. 0: one for each 4 million tets, 2 at
  /// least.
  std::size_t count = 0;
};

/// Improves a mesh in pieces, as `tetmend improve --pieces N` does. All ranks call it, with the same
/// options; all get the same result but for times. The arrays are replaced: points are shared out
/// evenly, those that stayed first and in their order; tets lie near each other on a rank. The arrays
/// of all ranks one after another are the same for any number of ranks and threads.
///
/// Options::progress and Options::cancel stop all ranks when they stop one. When an exception is
/// thrown on one rank, the others wait in a call of `ranks`: end them, as MPI_Abort does.
/// @throws OptionError for an option that needs the whole mesh (keep_size, ignore_interior, trace,
/// check_operators) or arrays, of which there are none (conserve), and as improve() of a Mesh; Error
/// for arrays that contradict themselves, inverted tets, and boundary layers that are to be kept.
TETMEND_API Result improve(RankArrays& mesh, Ranks& ranks, const Options& options = {},
                           const Pieces& pieces = {});

}  // namespace tetmend
