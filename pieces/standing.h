// SPDX-License-Identifier: MIT
// How good a mesh in pieces is by now, and which of its tets are the worst.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/quality.h"
#include "kernel/statistics.h"
#include "pieces/piece.h"
#include "pieces/zones.h"

namespace tetmend::pieces {

/// For a mesh of that side: coordinates times this have qualities that are free of its size.
double scale_of(double side);
std::array<Point, 4> corners_of(const Piece& piece, const PieceTet& tet, double scale);

/// How the own tets of pieces are by now. Order-free but for the rounding of the mean.
struct Standing {
  std::uint64_t tets = 0;
  QualityIndicators indicators{.q_worst = 1};
  double worst_angle = 1;  ///< as q_worst, by angles alone: needles do not hide them
  WorstTets worst;

  void add(const Standing& other);
};

void append(const Standing& standing, std::string& bytes);
/// @throws Error when the bytes end too early.
Standing take_standing(std::string_view& bytes);

/// Of all tets of a piece that may change. `side` of the mesh: of its size the qualities are free.
Standing standing_of(const Piece& piece, const Standard& standard, double side);

}  // namespace tetmend::pieces
