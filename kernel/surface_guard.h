// SPDX-License-Identifier: MIT
// Who decides whether the surface may change, and keeps the proof of what was promised. A mesh
// without a guard has a fixed surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include <tetmend/api.h>

#include "kernel/handles.h"
#include "kernel/mesh_data.h"
#include "kernel/territory.h"

namespace tetmend {

/// What a vertex may do on the surface. The surface is the boundary and the faces between labels.
enum class SurfacePlace : std::uint8_t {
  inside,  ///< not on the surface
  smooth,  ///< moves within its patch
  ridge,   ///< moves along its feature line
  corner   ///< neither moves nor vanishes
};

/// A triangle of the present surface, counterclockwise as seen from outside; at a face between two
/// labels as seen from the side of the larger one.
struct TETMEND_API SurfaceFace {
  std::array<VertexHandle, 3> vertices;
  std::array<Point, 3> points;
};

/// What undoing needs of what a guard has allowed. Each worker has one; its contents are the
/// guard's.
class TETMEND_API SurfaceJournal {
 public:
  virtual ~SurfaceJournal() = default;
  /// What is in it cannot be undone any more. Keeps the memory.
  virtual void clear() noexcept = 0;

  Territory territory;      ///< of the worker, at each replace()
  bool met_border = false;  ///< set by replace(): it refused for what lies outside the territory
};

/// Knows patches and feature lines of the present surface, and decides about each change of it.
/// Const functions may be called from several threads; replace() and undo() from workers in
/// different territories, for they look only at what belongs to vertices of the faces given.
class TETMEND_API SurfaceGuard {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  virtual ~SurfaceGuard() = default;
  /// A guard of its own for a copy of the mesh.
  virtual std::unique_ptr<SurfaceGuard> clone() const = 0;
  virtual std::unique_ptr<SurfaceJournal> make_journal() const = 0;
  /// The same kind of guard with the same surface and the same proof.
  virtual bool equals(const SurfaceGuard& other) const = 0;

  virtual SurfacePlace place(VertexHandle v) const = 0;
  /// Number of the patch of a present face, whatever the order of its vertices; kNone if it is no
  /// face of the surface. All faces of a patch have the same labels on both sides and the same
  /// label as a triangle, and the file names all of them or none.
  virtual std::uint32_t patch(const std::array<VertexHandle, 3>& face) const = 0;
  /// Number of the feature line of a present edge; kNone for an edge inside a patch, or inside the
  /// mesh. The file names all edges of a line, with the same label, or none.
  virtual std::uint32_t line(VertexHandle a, VertexHandle b) const = 0;
  bool is_feature(VertexHandle a, VertexHandle b) const { return line(a, b) != kNone; }
  /// The place nearest to `to` that the vertex may take: of a smooth one in its patch of the
  /// reference, of a ridge vertex on its line, of a corner its own.
  virtual Point nearest(VertexHandle v, const Point& to) const = 0;
  /// Unit normal of the tangent plane of a smooth vertex that lies at `at`; unit direction of the
  /// line of a ridge vertex.
  virtual Point direction(VertexHandle v, const Point& at) const = 0;

  /// Asks about one edit: faces that vanish and faces that come. Of moved vertices: all their
  /// faces, before and after. The two sets have the same border. A vertex of `after` alone is new
  /// on the surface, one of `before` alone leaves it. True: the edit is allowed, and the guard
  /// knows the surface as it is then; the journal has what undoing takes. False: nothing changed.
  /// When memory runs out, nothing has changed either.
  virtual bool replace(std::span<const SurfaceFace> before, std::span<const SurfaceFace> after,
                       SurfaceJournal& journal) = 0;
  /// Takes back the last replace() that is in the journal, bit for bit.
  virtual void undo(SurfaceJournal& journal) noexcept = 0;

  /// The mesh has so many vertex slots from now on: more, or fewer when an edit is undone, and then
  /// cannot fail. No worker is active. Vertices of slots that come or go are `inside`.
  virtual void resize(std::size_t vertex_slots) = 0;
  /// The mesh gave its vertices new numbers: new_vertex[old], invalid for slots that are gone. No
  /// journal holds anything.
  virtual void renumber(std::span<const VertexHandle> new_vertex, std::size_t vertex_slots) = 0;
};

/// Holds a guard, or none. A copy has a guard of its own.
class TETMEND_API SurfaceGuardHolder {
 public:
  SurfaceGuardHolder() = default;
  explicit SurfaceGuardHolder(std::unique_ptr<SurfaceGuard> guard) : guard_(std::move(guard)) {}
  SurfaceGuardHolder(const SurfaceGuardHolder& other)
      : guard_(other.guard_ ? other.guard_->clone() : nullptr) {}
  SurfaceGuardHolder(SurfaceGuardHolder&&) noexcept = default;
  SurfaceGuardHolder& operator=(const SurfaceGuardHolder& other) {
    return *this = SurfaceGuardHolder(other);
  }
  SurfaceGuardHolder& operator=(SurfaceGuardHolder&&) noexcept = default;
  ~SurfaceGuardHolder() = default;

  SurfaceGuard* get() const { return guard_.get(); }
  friend bool operator==(const SurfaceGuardHolder& a, const SurfaceGuardHolder& b) {
    return a.guard_ && b.guard_ ? a.guard_->equals(*b.guard_) : a.guard_ == b.guard_;
  }

 private:
  std::unique_ptr<SurfaceGuard> guard_;
};

}  // namespace tetmend
