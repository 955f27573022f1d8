// SPDX-License-Identifier: MIT
// Curved tets: those of second order with a mid-side node beside the middle of its edge.
//
// The map from a straight tet to a curved one has a Jacobian determinant that varies: where it is
// not positive, the tet is turned over and no solver takes it. It is a cubic polynomial, bounded by
// its 20 Bezier coefficients [johnen].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tetmend/curved.h>

#include "kernel/handles.h"
#include "kernel/mesh_data.h"

namespace tetmend {

class MidNodes;
class TetMesh;

/// A tet of a MeshData with the bends of its edges, in VTK's order; 0 where it is rounding alone.
struct CurvedTet {
  CurvedTet(const MeshData& data, const MidNodes& mid_nodes, const MeshData::Tet& tet);

  std::array<Point, 4> vertices;
  std::array<Point, 6> bends;
  std::array<std::uint32_t, 6> nodes{};  ///< kNoMidNode where there is none
  bool is_curved = false;
};

/// Of a tet with these vertices. `bends` are the places of its mid-side nodes less the middles of
/// their edges, in VTK's order. Cost: 64 determinants.
JacobianRatio jacobian_ratio(const std::array<Point, 4>& vertices,
                             const std::array<Point, 6>& bends);

/// The 20 Bezier coefficients of the Jacobian determinant: between the least and the greatest of them
/// lie all its values. Of a straight tet they are all the same. Each is affine in each bend.
std::array<double, 20> jacobian_coefficients(const std::array<Point, 4>& vertices,
                                             const std::array<Point, 6>& bends);

/// Of the tets of `data`, which are not inverted. Cost: n log n.
CurvedStatistics curved_statistics(const MeshData& data);
/// Of a mesh that was built from `data` and has not changed. Cost: n log n.
CurvedStatistics curved_statistics(const MeshData& data, const TetMesh& mesh);

/// Which mid-side nodes keep their place whatever happens.
struct FixedMidNodes {
  std::vector<bool> is_fixed;          ///< one for each of MeshData::mid_nodes
  std::vector<MeshData::Edge> inside;  ///< their edges that only this keeps from being changed
};
/// Those on the surface and on walls between regions; with the interior also those of named triangles
/// and edges, the required ones, and those of clearly curved edges within the volume. Cost: n log n.
FixedMidNodes find_fixed_mid_nodes(const MeshData& data, bool with_interior);

/// The curved edges of a mesh and what a new tet at them must keep. Immutable.
class CurvedEdges {
 public:
  /// Of the fixed ones of `data`, from which `mesh` was built with the edges of FixedMidNodes::inside
  /// as constraints.
  CurvedEdges(const MeshData& data, const TetMesh& mesh, bool with_interior);

  bool is_empty() const { return edges_.empty(); }
  /// The Jacobian ratios of this tet are positive, and no less than the worst that the mesh began
  /// with. True for a tet without curved edges. Cost: four flags, mostly.
  bool admit(const TetMesh& mesh, const TetVertices& vertices) const;
  /// Of the tets of the mesh now; edges that are not fixed are straight. Cost: linear.
  CurvedStatistics statistics(const TetMesh& mesh) const;

 private:
  struct Edge {
    std::uint64_t ends;  // slots, the smaller in the upper half
    Point bend;
  };
  friend CurvedStatistics curved_statistics(const MeshData& data, const TetMesh& mesh);
  /// Of those of `data` that `which` tells.
  CurvedEdges(const MeshData& data, const TetMesh& mesh, const std::vector<bool>& which);

  const Point* bend_of(VertexHandle a, VertexHandle b) const;
  /// None for a straight tet.
  std::optional<JacobianRatio> ratio_of(const TetMesh& mesh, const TetVertices& vertices) const;

  std::vector<Edge> edges_;       // ascending
  std::vector<bool> has_curved_;  // by slot of a vertex
  JacobianRatio least_;
  std::size_t mid_nodes_ = 0;
};

}  // namespace tetmend
