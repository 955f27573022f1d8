// SPDX-License-Identifier: MIT
// Two surfaces, from two meshes alone: does each lie within a tolerance of the other?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "face/moving_surface.h"
#include "kernel/mesh_data.h"

namespace tetmend::face {

/// A triangle of a surface, or an edge: its point 2 is point 1 again. In lengths of the file.
struct SurfacePiece {
  std::array<Point, 3> points;
  unsigned corners = 3;
  std::uint32_t sheet = 0;  ///< what it belongs to: pieces of one sheet stand for each other
};

/// How far pieces may lie from each other, and corners of the box around the first mesh: no tolerance
/// is more than 1 % of its diagonal. All as files have lengths.
struct NearTolerance {
  SurfaceTolerance surface;
  Point low, high;
};

/// What was found. Pieces that both have, corner for corner, need no proof.
struct Nearness {
  std::size_t others = 0;    ///< pieces of the second surface that the first has not
  std::size_t unproven = 0;  ///< pieces of either without a proof that was found
  double distance =
      0;  ///< proven: nothing is farther from the other surface; as files have lengths
};

/// Proves, wholly and without samples (CoverTest), that each piece of `after` lies within the
/// tolerance of pieces of its sheet in `before`, and the other way round. The tolerances are those of
/// a run (Reference), but that no gap outside makes them less. That of an edge is the largest of all
/// triangles.
/// Precondition: the tolerance is not fixed. Cost: n log n, in parallel.
Nearness prove_near(std::span<const SurfacePiece> before, std::span<const SurfacePiece> after,
                    const NearTolerance& tolerance);

}  // namespace tetmend::face
