// SPDX-License-Identifier: MIT
// The skirt polygon of a shell drawn flat: chords, pockets, core, and the quality of each.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "explain/pocket_tables.h"
#include "explain/slot_shell.h"
#include "kernel/quality.h"
#include "search/covering_search.h"
#include "search/shell_locks.h"

namespace tetmend::explain {

/// A covering of the polygon: triangles, and maybe a core. Each triangle stands for a tet with a
/// and one with b, and each side of the core for a tet with both. Numbers are places in the ring.
struct FlatCovering {
  struct Triangle {
    std::array<unsigned, 3> corners{};
    Quality quality = 0;  ///< the worse of its two tets
  };
  struct Side {
    unsigned from = 0, to = 0;
    Quality quality = 0;
  };
  std::vector<Triangle> triangles;
  std::vector<Side> core;  ///< in ring order; empty: full reduction
  Quality worst = 0;
};

/// The worst qualities of a triangulation, ascending, padded with +infinity. All 0 if there is none.
using PocketRanking = CoveringSearch::Ranking;

/// The polygon p_1 .. p_m of [chen, Fig. 3] as a regular one, p_1 on top, counterclockwise.
struct ShellPicture {
  VertexHandle a, b;
  std::vector<VertexHandle> ring;
  /// Of the old mesh: the worst tet that may be replaced.
  Quality floor = 0;
  FlatCovering before;
  /// What the search must leave alone for the sake of its callers.
  ShellLocks locks;
  /// Pocket from place i on to place j, M_q(i, j) of [chen, Alg. 2]: its best triangulation with
  /// positive tets as the operators' search ranks it. At i * m + j; empty for a polygon with more
  /// corners than are searched.
  std::vector<PocketRanking> pockets;
  /// M_q and M_k as they are once filled.
  PocketTables tables;
  /// The best triangulation of the whole polygon; without triangles if there is none.
  FlatCovering full;

  const PocketRanking& pocket(std::size_t i, std::size_t j) const {
    return pockets[i * ring.size() + j];
  }
  /// In the unit circle, y upwards.
  Eigen::Vector2d place(std::size_t i) const;
};

/// A diagonal of the polygon, and the pockets at its two sides.
struct Chord {
  unsigned from = 0, to = 0;  ///< places in the ring, from < to
  PocketRanking on{};         ///< of the pocket from `from` on to `to`
  PocketRanking back{};       ///< of the one from `to` on to `from`

  const PocketRanking& best() const { return std::max(on, back); }
};
/// Those that have a pocket, best first, as the search ranks them.
std::vector<Chord> chords_of(const ShellPicture& picture);

/// In a sentence, what the search must leave alone; empty without locks.
std::string locks_text(const ShellPicture& picture);

/// Of a closed shell, with the pockets that a search finds whose callers are to remove the edges
/// `ancestors`. Cost: cubic in the degree.
/// Precondition: at least three in the ring, and at most kMostDrawn.
ShellPicture picture_of_shell(const SlotMesh& mesh, const SlotShell& shell,
                              std::span<const std::array<VertexHandle, 2>> ancestors = {});
inline constexpr std::size_t kMostDrawn = 32;

/// Of the triangles between two vertices a and b: what multi-face removal takes together. `ring`
/// is the circle around them, (a, ring[i], ring[j], ring[k]) positive for i < j < k.
ShellPicture picture_of_sandwich(const SlotMesh& mesh, VertexHandle a, VertexHandle b,
                                 std::span<const std::array<VertexHandle, 3>> triangles);

/// What tets that contain a or b make of the polygon. Without triangles and core if one has a
/// vertex that is neither a nor b nor in the ring.
FlatCovering covering_of(const SlotMesh& mesh, const ShellPicture& picture,
                         std::span<const TetVertices> tets);

}  // namespace tetmend::explain
