// SPDX-License-Identifier: MIT
// The cavity of a new vertex: the tets that are replaced by tets between the vertex and the outer
// faces of the cavity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/index_set.h"
#include "kernel/surface_guard.h"
#include "kernel/workspace.h"
#include "trace/verdict.h"

namespace tetmend {

/// For one place of the vertex after another, finds the cavity whose worst new tet is best. Keeps
/// the best place with its cavity ([klingner_shewchuk]).
///
/// DEVIATION: the source collects all tets that the vertex might see and then cuts that graph. Here
/// the cavity grows one tet at a time, always through the outer face that makes the worst tet with
/// the vertex. The state with the best worst tet is taken. That is the same optimum without the
/// graph. Why: let a state be part of the best cavity and have a worse face. Then the best cavity
/// holds the tet behind that face, too. Faces that the vertex does not see make tets of negative
/// quality and are crossed in the same way.
class VertexCavity {
 public:
  struct Limits {
    std::size_t max_tets = 64;  ///< a cavity holds no more
    double enough = 1;          ///< stop growing when the worst new tet is as good as this
    /// Of a surface that may change: its faces give way as well. Between regions the cavity has tets of
    /// both sides.
    std::uint32_t patch = SurfaceGuard::kNone;
  };

  /// Where a vertex might go, and the quality of its worst tet.
  struct Place {
    Point point;
    double worst;
  };

  /// Forgets all cavities. The next ones hold `target`, and their worst tet is better than `least`,
  /// which must not be negative.
  void begin(TetHandle target, double least, const Limits& limits);

  /// `accepted` when the vertex at that point has a better cavity than all before, which is then
  /// kept instead. `deferred` when the search meets the border of the territory. A cavity crosses
  /// no boundary, constrained face or border of a frozen tet, but for faces of the patch. Cost: n log n for the n tets that it
  /// looks at, `max_tets` at most; ends early when a face that cannot be crossed bounds all that
  /// could follow.
  Verdict offer(const TetMesh& mesh, Workspace& workspace, const Point& point);

  /// The best so far: the place, the tets to be replaced (the target first), and the outer faces as
  /// faces of these tets, without those of the patch that give way.
  const Point& point() const { return point_; }
  std::span<const TetHandle> tets() const { return tets_; }
  std::span<const HalfFace> faces() const { return faces_; }
  /// Quality of its worst new tet; `least` when there is none.
  double worst() const { return worst_; }
  /// A better place for the vertex in the same cavity.
  void move(const Point& point, double worst) {
    point_ = point;
    worst_ = worst;
  }

 private:
  struct Face {
    double quality;  // of the tet between the face and the vertex
    HalfFace face;
  };

  bool is_open(const TetMesh& mesh, HalfFace face) const;
  void take(const TetMesh& mesh, TetHandle t, const Point& point);
  void keep(const TetMesh& mesh, std::size_t count, std::size_t dropped, const Point& point,
            double worst);

  TetHandle target_;
  Limits limits_;
  // The best so far.
  Point point_ = Point::Zero();
  double worst_ = 0;
  std::vector<TetHandle> tets_;
  std::vector<HalfFace> faces_;
  // The one that grows.
  std::vector<TetHandle> taken_;
  std::vector<HalfFace> dropped_;  // of the boundary
  IndexSet inside_;
  std::vector<Face> front_;  // a heap, the worst on top; some are inside by now
  double bound_ = 0;         // worst of the faces that cannot be crossed
};

/// Whether the outer faces of a cavity form one closed surface without handles or pinches. They do
/// if the tets are positive and a point sees all the faces, except in a folded mesh, where a cavity
/// may enclose tets. Cost: quadratic.
bool is_sphere(const TetMesh& mesh, std::span<const HalfFace> faces);

}  // namespace tetmend
