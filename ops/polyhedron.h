// SPDX-License-Identifier: MIT
// A small polyhedron of the mesh, made of tets: how it grows, and its surface in the numbers of its
// own vertices.
#pragma once

#include <span>
#include <vector>

#include "kernel/tet_mesh.h"
#include "kernel/workspace.h"
#include "search/polyhedron_search.h"

namespace tetmend {

/// A set of tets that are connected through faces without constraints. So it lies in one region,
/// and whatever fills its surface may replace it.
class Polyhedron {
 public:
  static constexpr std::size_t kMaxVertices = SideTable::kMaxPoints;

  /// One tet.
  void start(const TetMesh& mesh, TetHandle t);
  /// The ball of a vertex, given by its link; the vertex is not among vertices(). False if there
  /// are too many; the content is then undefined.
  bool start_at_ball(const TetMesh& mesh, std::span<const HalfFace> link);

  /// Adds the vertex behind the surface that makes most tets with it, and of equal ones the nearest
  /// to the first tet. Then adds all tets between vertices of the polyhedron that can be reached.
  /// False if there is no such vertex, if there are `limit` vertices already, or if it belongs to
  /// another worker's territory (which is noted). Cost: linear in tets times vertices.
  bool grow(const TetMesh& mesh, Workspace& workspace, std::size_t limit);

  /// Whether the tets are certified positive and do not overlap: those of a folded mesh may. The
  /// table has the vertices. Precondition: no ball. Cost: quadratic.
  bool is_embedded(const TetMesh& mesh, const SideTable& table) const;

  std::span<const TetHandle> tets() const { return tets_; }
  std::span<const VertexHandle> vertices() const { return vertices_; }
  std::span<const PolyhedronProblem::Triangle> surface() const { return surface_; }
  /// Vertices whose whole ball belongs to the polyhedron.
  PointMask inside() const { return inside_; }

 private:
  /// A vertex behind the surface, and how many faces it lies behind.
  struct Candidate {
    VertexHandle vertex;
    std::size_t faces;
  };

  void add(TetHandle t);
  bool add_reachable(const TetMesh& mesh);
  bool may_add(const TetMesh& mesh, TetHandle t) const;
  void list_faces(const TetMesh& mesh);
  void list_surface(const TetMesh& mesh);
  VertexHandle next_vertex(const TetMesh& mesh, Workspace& workspace);
  std::size_t number_of(VertexHandle v) const;
  PointMask corners(const TetVertices& tet) const;

  std::vector<TetHandle> tets_;
  std::vector<VertexHandle> vertices_;
  std::vector<HalfFace> faces_;  // of the surface, seen from inside
  std::vector<PolyhedronProblem::Triangle> surface_;
  PointMask inside_ = 0;
  std::vector<Candidate> candidates_;
  Point centre_ = Point::Zero();
  IndexSet set_;  // tets
};

}  // namespace tetmend
