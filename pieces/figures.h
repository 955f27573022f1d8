// SPDX-License-Identifier: MIT
// What the checks before and after a run in pieces add up.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/bounds.h"
#include "kernel/statistics.h"
#include "pieces/held_surface.h"
#include "pieces/parting.h"
#include "pieces/piece.h"

namespace tetmend::pieces {

/// What a check adds up over all pieces.
struct Figures {
  MeshStatistics statistics;  ///< of the own tets
  std::uint64_t surface = 0;  ///< part of surface_fingerprint()
  std::size_t not_positive = 0;
  std::size_t peculiar = 0;  ///< tets that building turned round, inverted and flat ones
  std::size_t layer_tets = 0;
  std::size_t touched = 0;  ///< tets that the file does not have, or with a vertex that has moved
  std::size_t protected_tets = 0;      ///< by the user
  std::size_t protected_bad_tets = 0;  ///< of them
  std::size_t misfits = 0;             ///< see HeldSurface::count_misfits()

  void add(const Figures& other);
};

/// Of the own tets, for the standard. The same whoever asks: of the coordinates in the order of the piece.
Bounds bounds_of_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
                     const Standard& standard);

/// Builds all of a piece, which fails where a face has more than two tets, and measures what is its
/// own. A face is that of the piece with the lowest part of its vertices: all its tets are there.
/// @param surface null: it is fixed
Figures measure_own(const Piece& gathered, const Parting& parting, std::uint32_t number,
                    const Standard& standard, const HeldSurface* surface = nullptr);

}  // namespace tetmend::pieces
