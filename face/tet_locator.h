// SPDX-License-Identifier: MIT
// Which of many tets holds a place: a walk from tet to tet, and a tree of boxes where that does not lead
// there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "face/bodies.h"
#include "kernel/mesh_data.h"

namespace tetmend::face {

/// A place within a tet.
struct TetPlace {
  std::uint32_t tet = 0;            ///< number in MeshData::tets
  std::array<double, 4> weights{};  ///< of its vertices; their sum is 1
};

/// Finds tets of a mesh, which must outlive it, as its bodies. Several threads may ask at once.
class TetLocator {
 public:
  /// Of the tets of `data` with these numbers. Cost: linear; takes some 20 bytes a tet, and 60 more when
  /// the first walk has failed.
  TetLocator(const MeshData& data, const Bodies& bodies, std::vector<std::uint32_t> tets);

  bool is_empty() const { return tets_.empty(); }
  /// The tet that holds `place`, of several at a face the one of lowest number; where none does, by
  /// rounding or because the tets leave a gap there, one of the nearest, with weights below 0.
  /// Precondition: not empty. Cost: some steps, as far as it is from the points of the origin; else about
  /// log n.
  /// @param origin tets of its bodies alone; where they have none here, of all
  TetPlace find(const Point& place, const Origin& origin = {}) const;
  /// The same without weights, for less.
  std::uint32_t find_tet(const Point& place, const Origin& origin) const;
  /// As find(), with weights as volumes give them: less exact in flat tets, for a tenth of the cost.
  TetPlace find_roughly(const Point& place, const Origin& origin = {}) const;
  /// The tets of these bodies whose boxes meet that of `tet`, a tet of any mesh, ascending; no body: of
  /// all. Cost: about log n, and what it finds.
  std::vector<std::uint32_t> near(const std::array<Point, 4>& tet,
                                  std::span<const std::uint32_t> among = {}) const;

 private:
  using Box = Eigen::AlignedBox3d;
  using Among = std::span<const std::uint32_t>;
  struct Best;
  struct Node {
    Box box;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t right = 0;  // child; 0: a leaf. The left one follows its parent.
  };

  void join_neighbours();
  void list_tets_at() const;
  std::span<const std::uint32_t> tets_at(std::uint32_t point) const;
  bool walk(const Point& place, const Origin& origin, Best& best) const;
  bool walk_from(std::uint32_t start, const Point& place, Best& best) const;
  bool take(std::uint32_t tet, const Point& place, Best& best) const;
  void try_holder(std::uint32_t tet, const Point& place, Best& best) const;
  Best search(const Point& place, Among among) const;

  void need_tree() const;
  void sort_leaves() const;
  std::uint32_t build(std::uint32_t begin, std::uint32_t end) const;
  Box box_of(std::uint32_t tet) const;
  bool is_among(std::uint32_t tet, Among among) const;
  void find_holder(const Point& place, Among among, Best& best) const;
  void search(std::uint32_t node, const Point& place, Among among, Best& best) const;
  void search(std::uint32_t node, const Box& box, Among among,
              std::vector<std::uint32_t>& found) const;

  const MeshData& data_;
  const Bodies& bodies_;
  std::vector<std::uint32_t> tets_;
  // By place in tets_, four each: that of the neighbour opposite each vertex, of the same body, or kNone.
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint32_t> starts_;  // by point: place of one of its tets, or kNone
  // Only when it is needed.
  mutable std::once_flag has_lists_;
  mutable std::vector<std::uint32_t> tets_at_;   // of each point
  mutable std::vector<std::uint32_t> first_at_;  // by point, and one more
  mutable std::once_flag has_tree_;
  mutable std::vector<std::uint32_t> leaves_;  // the tets, as the leaves have them
  mutable std::vector<Node> nodes_;
};

/// Weights of the vertices of tet `tet` that give `place`: x, y and z to the last bits, however flat
/// the tet. Of a tet without volume: those of its nearest vertex.
std::array<double, 4> weights_in(const MeshData& data, std::uint32_t tet, const Point& place);

}  // namespace tetmend::face
