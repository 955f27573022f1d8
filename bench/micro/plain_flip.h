// SPDX-License-Identifier: MIT
// A 3-2 flip written by hand on plain arrays of the same layout as TetMesh: the least that such a
// flip can cost. No journal, no undo, no constraints, no other case.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/shell.h"

namespace tetmend::bench {

class PlainMesh {
 public:
  explicit PlainMesh(const TetMesh& mesh);

  /// Removes the edge of a shell of three tets. False, and nothing done, unless both new tets are
  /// certified positive.
  bool flip_3_2(const Shell& shell);

 private:
  using Index = std::uint32_t;
  static constexpr Index kOutside = 0x80000000u;
  static constexpr Index kNone = 0xFFFFFFFFu;
  static constexpr std::uint16_t kTouched = 0x400;

  struct Cell {
    std::array<Index, 4> vertices;
    std::array<Index, 4> neighbours;
  };

  /// What lies beyond the face of tet t opposite vertex v.
  Index beyond(Index t, Index v) const;
  bool measure(const std::array<Index, 4>& vertices, float& quality) const;
  void glue(Index t, unsigned face, Index neighbour);

  std::vector<Cell> cells_;
  std::vector<float> quality_;
  std::vector<std::int32_t> label_;
  std::vector<std::uint16_t> flags_;
  std::vector<Index> free_;
  std::vector<Point> points_;
  std::vector<Index> vertex_tet_;
};

}  // namespace tetmend::bench
