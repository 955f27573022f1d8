// SPDX-License-Identifier: MIT
// The tetrahedral mesh: points, tets with neighbours, labels and constraints. Read-only from
// outside; see Transaction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/api.h>
#include <tetmend/statistics.h>

#include "kernel/bounds.h"
#include "kernel/error.h"
#include "kernel/handles.h"
#include "kernel/mesh_data.h"
#include "kernel/quality.h"
#include "kernel/scale.h"
#include "kernel/surface_guard.h"

namespace tetmend {

class CurvedEdges;
class SizeField;
class ThinStars;

/// Counts commits or passes: which of two things happened later. 0 is "never".
using Date = std::uint32_t;

/// What becomes of the triangles, edges and required vertices that the file names inside a region.
/// Dropped ones are no constraint and are not written back. What lies on the boundary or on a face
/// between two labels is always kept. A triangle or edge of no tet counts as inside when one of its
/// vertices lies there.
enum class InteriorConstraints : std::uint8_t { kept, dropped };

/// What a caller of TetMesh::build() wishes, and wants to know.
struct TETMEND_API BuildDetails {
  bool sorted = true;  ///< along a space-filling curve
  InteriorConstraints interior = InteriorConstraints::kept;
  std::uint32_t first_number = 1;  ///< from which messages count tets and vertices
  BuildReport* report = nullptr;   ///< filled in; null: not wanted
  std::vector<std::uint32_t>* tet_numbers = nullptr;  ///< in the data, by slot; null: not wanted
};

/// A face that every operation keeps: a triangle of the boundary, a triangle named by the file, or
/// a face between two labels.
struct TETMEND_API SurfaceTriangle {
  std::array<VertexHandle, 3> vertices;
  Label label = 0;
  bool named = false;     ///< the file lists it; only these are written back
  bool interior = false;  ///< a constrained face with tets on both sides
  bool loose = false;     ///< no face of any tet
};

/// Compact tetrahedral mesh. Per tet: four vertices and four neighbours ([chen, 5.2]), cached
/// quality, label, flags; per vertex: a point, one incident tet, flags and the date of the last
/// change around it. Deleted slots stay until collect_garbage(). All const member functions may be
/// called from several threads.
class TETMEND_API TetMesh {
 public:
  TetMesh() = default;
  /// Builds adjacency, constraints and qualities. A mesh that is merely mirrored is corrected; tets
  /// that are inverted or flat are kept and counted in `report`.
  /// @throws Error when a face has more than two tets, when two tets lie on the same side of a
  ///   face, when an index is out of range, or when lengths differ too much to be worked with (see
  ///   Scale). BuildError names the tet.
  /// Cost: linear. `data` is taken apart on the way: move it in where it is no longer needed.
  explicit TetMesh(MeshData data, BuildReport* report = nullptr,
                   InteriorConstraints interior = InteriorConstraints::kept);
  /// The same mesh as by the constructor and sort_spatially(), in less time and memory: at its peak
  /// about 70 bytes a tet, `data` and the mesh included.
  static TetMesh sorted(MeshData data, BuildReport* report = nullptr,
                        InteriorConstraints interior = InteriorConstraints::kept);
  /// Either of these, for a caller who wants to know more. `data` is empty afterwards, or what it
  /// was when an Error is thrown.
  static TetMesh build(MeshData& data, const BuildDetails& details);

  /// The live part as plain arrays: vertices that came from the file first, in their order, then
  /// the others; tets by slot.
  MeshData to_data() const&;
  /// Releases the mesh on the way: takes at most 30 bytes a tet besides it.
  MeshData to_data() &&;

  // --- sizes -------------------------------------------------------------------------------------
  std::size_t tet_count() const { return tet_count_; }
  std::size_t vertex_count() const { return vertex_count_; }
  /// Live and deleted; bounds of TetHandle::index() and VertexHandle::index().
  std::size_t tet_slots() const { return cells_.size(); }
  std::size_t vertex_slots() const { return points_.size(); }
  bool is_deleted(TetHandle t) const { return !cells_[t.index()].vertices[0].is_valid(); }
  bool is_deleted(VertexHandle v) const { return (vertex_flags_[v.index()] & kVertexDeleted) != 0; }

  // --- tets --------------------------------------------------------------------------------------
  const TetVertices& vertices(TetHandle t) const { return cells_[t.index()].vertices; }
  const std::array<HalfFace, 4>& neighbours(TetHandle t) const {
    return cells_[t.index()].neighbours;
  }
  /// Asks memory for what vertices() and neighbours() give, without waiting for it.
  void prefetch(TetHandle t) const { __builtin_prefetch(&cells_[t.index()]); }
  /// The other side of a face: a half-face of the neighbouring tet, or the outside.
  HalfFace twin(HalfFace f) const { return cells_[f.tet().index()].neighbours[f.face()]; }
  Quality quality(TetHandle t) const { return quality_[t.index()]; }
  /// Calls visit(t) for the live tets of a range of slots whose quality is below a limit, in order.
  template <class Visit>
  void visit_below(Quality limit, std::size_t begin, std::size_t end, const Visit& visit) const {
    constexpr std::size_t kGroup = 32;  // compared at once; most groups have none
    while (begin < end) {
      const std::size_t stop = std::min(end, begin + kGroup);
      unsigned below = 0;
      for (std::size_t i = begin; i < stop; ++i) below |= quality_[i] < limit ? 1u : 0u;
      for (; below != 0 && begin < stop; ++begin) {
        if (quality_[begin] < limit) visit(TetHandle(static_cast<std::uint32_t>(begin)));
      }
      begin = stop;
    }
  }
  Label label(TetHandle t) const { return label_[t.index()]; }
  /// Position of v in t; 4 when t does not contain v.
  unsigned local_index(TetHandle t, VertexHandle v) const {
    // Without branches: which of the four it is cannot be predicted.
    const TetVertices& tv = cells_[t.index()].vertices;
    return 4u - 4u * (tv[0] == v) - 3u * (tv[1] == v) - 2u * (tv[2] == v) - 1u * (tv[3] == v);
  }
  bool is_boundary(HalfFace f) const { return twin(f).is_outside(); }
  bool is_constrained(HalfFace f) const { return (tet_flags_[f.tet().index()] >> f.face()) & 1u; }
  /// No constraint speaks against removing the face: it lies inside, is not constrained, and
  /// neither of its tets is frozen.
  bool is_free(HalfFace f) const {
    const HalfFace other = twin(f);
    return !other.is_outside() && !is_constrained(f) && !is_frozen(f.tet()) &&
           !is_frozen(other.tet());
  }
  /// A constraint of the edge itself. An edge of a constrained or boundary face is not marked here:
  /// its shell shows it.
  bool is_constrained(TetEdge e) const {
    return (tet_flags_[e.tet().index()] >> (4 + e.edge())) & 1u;
  }
  /// Created, or one of its vertices moved, since the mesh was built.
  bool is_touched(TetHandle t) const { return (tet_flags_[t.index()] & kTetTouched) != 0; }
  /// Created since the mesh was built.
  bool is_created(TetHandle t) const { return (tet_flags_[t.index()] & kTetCreated) != 0; }
  /// Must stay as it is, and its vertices where they are: see freeze().
  bool is_frozen(TetHandle t) const { return (tet_flags_[t.index()] & kTetFrozen) != 0; }
  /// A face or edge of the tet is constrained, or the tet is frozen.
  bool has_constraints(TetHandle t) const { return (tet_flags_[t.index()] & kTetConstraints) != 0; }
  /// Vertices of a face, counterclockwise as seen from outside the tet.
  std::array<VertexHandle, 3> vertices(HalfFace f) const {
    const TetVertices& tv = cells_[f.tet().index()].vertices;
    const auto& local = kFaceVertices[f.face()];
    return {tv[local[0]], tv[local[1]], tv[local[2]]};
  }
  std::array<VertexHandle, 2> vertices(TetEdge e) const {
    const TetVertices& tv = cells_[e.tet().index()].vertices;
    return {tv[kEdgeVertices[e.edge()][0]], tv[kEdgeVertices[e.edge()][1]]};
  }
  /// By which tets are judged; at first that of the default goal.
  const Standard& standard() const { return standard_; }
  /// Another standard. Cost: linear, unless it is the same.
  void set_standard(const Standard& standard);
  /// What no change may make worse; at first nothing.
  const Bounds& bounds() const { return bounds_; }
  /// Cost: linear where they hold another stable step.
  void set_bounds(const Bounds& bounds);
  /// Around which vertices the stable step of the bounds is in question; null where they have none, and
  /// after the vertices got other handles.
  ThinStars* thin_stars() const { return thin_stars_.get(); }
  /// What the lengths of new edges are held to; null: nothing.
  const SizeField* size_field() const { return size_field_.get(); }
  void set_size_field(std::shared_ptr<const SizeField> field) { size_field_ = std::move(field); }
  /// Edges whose tets are curved; null: none.
  const CurvedEdges* curved_edges() const { return curved_edges_.get(); }
  void set_curved_edges(std::shared_ptr<const CurvedEdges> edges) {
    curved_edges_ = std::move(edges);
  }
  /// Decides about changes of the surface; null: it is fixed.
  SurfaceGuard* surface_guard() const { return guard_.get(); }
  /// Precondition: the guard knows the surface as it is; no transaction is open. Null: fixes it.
  void set_surface_guard(std::unique_ptr<SurfaceGuard> guard);
  /// Brings surface_triangles() and the named edges up to date after the surface has changed. What
  /// was there keeps its place; where something of a patch or line is gone, what is new there comes
  /// first. Precondition: no transaction is open. Cost: linear; nothing without a guard.
  void renew_surface();
  /// Quality computed from the points; what quality() caches.
  Quality evaluate(const TetVertices& tv) const;
  bool is_certified_positive(const TetVertices& tv) const {
    return certified_positive(point(tv[0]), point(tv[1]), point(tv[2]), point(tv[3]));
  }

  // --- vertices ----------------------------------------------------------------------------------
  /// In lengths that are worked with: see scale().
  const Point& point(VertexHandle v) const { return points_[v.index()]; }
  /// As the file has it, or will have it.
  Point point_in_file(VertexHandle v) const { return scale_.to_file(point(v)); }
  /// Between lengths here and in the file; 1 for a mesh of ordinary size.
  const Scale& scale() const { return scale_; }
  /// A tet that contains v; invalid for a vertex of no tet.
  TetHandle tet_of(VertexHandle v) const { return vertex_tet_[v.index()]; }
  bool is_boundary(VertexHandle v) const {
    return (vertex_flags_[v.index()] & kVertexBoundary) != 0;
  }
  /// On a boundary or constrained face or edge, of a frozen tet, or required by the file: must
  /// neither move nor vanish.
  bool is_fixed(VertexHandle v) const { return (vertex_flags_[v.index()] & kVertexFixed) != 0; }
  /// A vertex of a frozen tet.
  bool is_frozen(VertexHandle v) const { return (vertex_flags_[v.index()] & kVertexFrozen) != 0; }
  /// Named by the file as one that must not move or vanish.
  bool is_required(VertexHandle v) const {
    return (vertex_flags_[v.index()] & kVertexRequired) != 0;
  }
  /// Its number in the data that the mesh was built of; kNotFromFile for a vertex that was added.
  std::uint32_t origin(VertexHandle v) const { return vertex_origin_[v.index()]; }
  static constexpr std::uint32_t kNotFromFile = 0xFFFFFFFFu;
  /// Latest date at which a tet of v's star was replaced or a vertex of its link moved.
  Date changed(VertexHandle v) const { return vertex_dates_[v.index()].changed; }
  /// Date at which v itself moved last.
  Date moved(VertexHandle v) const { return vertex_dates_[v.index()].moved; }

  // --- surface and constraints -------------------------------------------------------------------
  /// Where a guard lets the surface change, as it was at the last renew_surface().
  std::span<const SurfaceTriangle> surface_triangles() const { return surface_; }
  /// For each of them its number when the guard was set; kNotFromFile for what is new. Empty
  /// without a guard.
  std::span<const std::uint32_t> surface_origins() const { return surface_origin_; }

  /// Freezes the live tets for which `is_frozen` is true, and thaws all others. No transaction
  /// removes a frozen tet or moves one of its vertices. Files do not hold this. Returns the number
  /// of frozen tets. Precondition: no transaction is open. Cost: linear.
  std::size_t freeze(const std::function<bool(TetHandle)>& is_frozen);
  /// The slots that a renumbering has kept, by their numbers before, in their order now.
  struct KeptSlots {
    std::vector<std::uint32_t> vertices, tets;
  };
  /// Removes deleted slots; the order of the others stays. All handles, workspaces and queues made
  /// before become invalid.
  KeptSlots collect_garbage();
  /// Moves the vertices and tets, in their order, to the slots given (ascending, one for each of
  /// them). The slots between them are deleted ones. So a rebuilt mesh gets the handle numbers of
  /// the one it shows. Handles made before become invalid.
  void scatter(std::span<const std::uint32_t> vertex_slots,
               std::span<const std::uint32_t> tet_slots);
  /// Sorts vertices and tets along a space-filling curve, so that neighbours in space are
  /// neighbours in memory. to_data() still lists the vertices of the file in their order. Handles
  /// made before become invalid. Removes deleted slots.
  KeptSlots sort_spatially();

  /// Bytes held for each tet slot and each vertex slot.
  static constexpr std::size_t bytes_per_tet() {
    return sizeof(Cell) + sizeof(Quality) + sizeof(Label) + sizeof(TetFlags);
  }
  static constexpr std::size_t bytes_per_vertex() {
    return sizeof(Point) + sizeof(TetHandle) + sizeof(VertexFlags) + sizeof(VertexDates) +
           sizeof(std::uint32_t);
  }

  /// Same slots, bit for bit: coordinates, connectivity, qualities, flags and dates, and guards that
  /// know the same.
  friend bool operator==(const TetMesh& a, const TetMesh& b);

 private:
  friend class Transaction;
  friend class Workspace;
  friend class MeshBuilder;
  friend class MeshView;
  friend struct TetMeshTestAccess;  // defined in a test only: makes broken meshes

  // Walks from tet to tet wait for cells: none lies across two cache lines.
  struct alignas(32) Cell {
    TetVertices vertices;
    std::array<HalfFace, 4> neighbours;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  static_assert(sizeof(Cell) == 32);

  struct VertexDates {  // asked for together
    Date changed = 0;
    Date moved = 0;
    friend bool operator==(const VertexDates&, const VertexDates&) = default;
  };

  // Scans for bad tets need not ask whether a slot is in use.
  static constexpr Quality kDeletedQuality = std::numeric_limits<Quality>::infinity();
  // Bits 0-3: face f is constrained; bits 4-9: edge e is; bit 10: touched; bit 11: frozen;
  // bit 12: created.
  using TetFlags = std::uint16_t;
  static constexpr TetFlags kTetTouched = 0x400;
  static constexpr TetFlags kTetFrozen = 0x800;
  static constexpr TetFlags kTetCreated = 0x1000;
  static constexpr TetFlags kTetConstraints = 0x3FF | kTetFrozen;
  using VertexFlags = std::uint8_t;
  static constexpr VertexFlags kVertexBoundary = 1;
  static constexpr VertexFlags kVertexConstrained = 2;
  static constexpr VertexFlags kVertexDeleted = 4;
  static constexpr VertexFlags kVertexRequired = 8;  // named by the file: written back
  static constexpr VertexFlags kVertexFrozen = 16;
  static constexpr VertexFlags kVertexFixed = kVertexBoundary | kVertexConstrained | kVertexFrozen;

  /// Adds deleted slots. When memory runs out, none.
  void grow_tets(std::size_t count);
  void grow_vertices(std::size_t count);
  /// Takes back the slot that was added last.
  void drop_tet_slot() noexcept;
  void drop_vertex_slot() noexcept;
  void reorder(std::span<const std::uint32_t> vertex_order,
               std::span<const std::uint32_t> tet_order);

  Standard standard_ = Standard(Goal{});
  Bounds bounds_;
  std::shared_ptr<ThinStars> thin_stars_;
  std::shared_ptr<const SizeField> size_field_;
  std::shared_ptr<const CurvedEdges> curved_edges_;
  std::vector<Cell> cells_;
  std::vector<Quality> quality_;
  std::vector<Label> label_;
  std::vector<TetFlags> tet_flags_;
  std::size_t tet_count_ = 0;

  Scale scale_;
  std::vector<Point> points_;
  std::vector<TetHandle> vertex_tet_;
  std::vector<VertexFlags> vertex_flags_;
  std::vector<VertexDates> vertex_dates_;
  std::vector<std::uint32_t> vertex_origin_;  // number in the file, or kNotFromFile
  std::size_t vertex_count_ = 0;

  std::vector<SurfaceTriangle> surface_;
  struct NamedEdge {
    std::array<VertexHandle, 2> vertices;
    Label label;
  };
  bool renew_triangles();
  void take_triangles(const std::vector<char>& gone, const std::vector<HalfFace>& fresh);
  void renew_edges();
  void find_attributes();
  std::vector<NamedEdge> named_edges_;
  std::vector<Label> point_labels_;  // by number in the file; empty when all are 0

  // Of a surface that may change.
  SurfaceGuardHolder guard_;
  std::vector<std::uint32_t> surface_origin_, surface_patch_;       // by surface triangle
  std::vector<std::uint32_t> named_edge_origin_, named_edge_line_;  // by named edge
  std::vector<std::uint32_t> patch_triangle_;  // by patch: a surface triangle of it
  std::vector<std::uint32_t> line_edge_;       // by line: a named edge of it, or kNone
};

/// An error in the topology of a file's contents; names the tet so that the reader can add its
/// line.
class TETMEND_API BuildError : public Error {
 public:
  BuildError(const std::string& message, std::size_t tet) : Error(message), tet_(tet) {}
  std::size_t tet() const { return tet_; }

 private:
  std::size_t tet_;
};

/// The angles of the tet miss the goal; a needle whose angles are good does not.
TETMEND_API bool misses_goal(const TetMesh& mesh, TetHandle t);

/// Lowest quality of the tets, of which there is at least one.
inline Quality worst_quality(const TetMesh& mesh, std::span<const TetHandle> tets) {
  Quality worst = mesh.quality(tets[0]);
  for (const TetHandle t : tets) worst = std::min(worst, mesh.quality(t));
  return worst;
}

}  // namespace tetmend
