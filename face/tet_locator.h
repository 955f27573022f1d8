// SPDX-License-Identifier: MIT
// Which of many tets holds a place: a tree of boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// A place within a tet.
struct TetPlace {
  std::uint32_t tet = 0;            ///< number in MeshData::tets
  std::array<double, 4> weights{};  ///< of its vertices; their sum is 1
};

/// Finds tets of a mesh, which must outlive it. Several threads may ask at once.
class TetLocator {
 public:
  /// Of the tets of `data` with these numbers. Cost: n log n; takes some 60 bytes a tet.
  TetLocator(const MeshData& data, std::vector<std::uint32_t> tets);

  bool is_empty() const { return tets_.empty(); }
  /// The tet that holds `place`, of several the one of lowest number; where none does, by rounding or
  /// because the tets leave a gap there, one of the nearest, with weights below 0. Precondition: not
  /// empty. Cost: about log n.
  TetPlace find(const Point& place) const;
  /// The tets whose boxes meet that of `tet`, a tet of any mesh, ascending. Cost: about log n, and
  /// what it finds.
  std::vector<std::uint32_t> near(const std::array<Point, 4>& tet) const;

 private:
  using Box = Eigen::AlignedBox3d;
  struct Best;
  struct Node {
    Box box;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t right = 0;  // child; 0: a leaf. The left one follows its parent.
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::span<const Box> boxes);
  Box box_of(std::uint32_t tet) const;
  void search(std::uint32_t node, const Point& place, Best& best) const;
  void search(std::uint32_t node, const Box& box, std::vector<std::uint32_t>& found) const;

  const MeshData& data_;
  std::vector<std::uint32_t> tets_;
  std::vector<Node> nodes_;
};

/// Weights of the vertices of tet `tet` that give `place`: x, y and z to the last bits, however flat
/// the tet. Of a tet without volume: those of its nearest vertex.
std::array<double, 4> weights_in(const MeshData& data, std::uint32_t tet, const Point& place);

}  // namespace tetmend::face
