// SPDX-License-Identifier: MIT
// The guard that lets the surface move within a tolerance, and proves at every moment that it did
// not move farther.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <tetmend/api.h>

#include "envelope/features.h"
#include "envelope/present_surface.h"
#include "kernel/surface_guard.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// How far the surface may move. Both 0: not at all, see Envelope.
struct TETMEND_API EnvelopeOptions {
  double share = 0;   ///< of the mean edge length of each triangle of the input
  double length = 0;  ///< the same everywhere, in lengths of the mesh (TetMesh::scale()); not both
  double angle = 40;  ///< of features, in degrees
  std::vector<VertexHandle> kept;  ///< further vertices that stay

  bool is_flat() const { return share == 0 && length == 0; }
};

/// Keeps the surface of a mesh near the one that it had when the envelope was made, the *reference*.
///
/// Tolerance 0: the present surface *is* the reference, up to flatness(). Vertices move, come and
/// go inside flat patches and along straight lines only. The faces that an edit makes lie in the
/// plane of their patch, all turned the same way as certified signs say, and have the border that
/// the old ones had. So they cover the same part of the plane, each point once.
class TETMEND_API Envelope final : public SurfaceGuard {
 public:
  /// Of the mesh as it is. @throws Error for an angle, a share or a length that is none.
  static std::unique_ptr<Envelope> of(const TetMesh& mesh, const EnvelopeOptions& options);

  Envelope(const Envelope&) = default;
  Envelope& operator=(const Envelope&) = delete;
  ~Envelope() override = default;

  std::unique_ptr<SurfaceGuard> clone() const override;
  std::unique_ptr<SurfaceJournal> make_journal() const override;
  bool equals(const SurfaceGuard& other) const override {
    const auto* const envelope = dynamic_cast<const Envelope*>(&other);
    return envelope != nullptr && *this == *envelope;
  }
  SurfacePlace place(VertexHandle v) const override;
  std::uint32_t patch(const std::array<VertexHandle, 3>& face) const override;
  std::uint32_t line(VertexHandle a, VertexHandle b) const override;
  Point nearest(VertexHandle v, const Point& to) const override;
  Point direction(VertexHandle v, const Point& at) const override;
  /// Cost: for tolerance 0 linear in the number of faces, apart from sorting.
  bool replace(std::span<const SurfaceFace> before, std::span<const SurfaceFace> after,
               SurfaceJournal& journal) override;
  void undo(SurfaceJournal& journal) noexcept override;
  void resize(std::size_t vertex_slots) override;
  void renumber(std::span<const VertexHandle> new_vertex, std::size_t vertex_slots) override;

  /// The same present surface and the same proof, in the same order.
  friend bool operator==(const Envelope& a, const Envelope& b) { return a.present_ == b.present_; }

 private:
  struct Reference;
  class Journal;

  Envelope(std::shared_ptr<const Reference> reference, PresentSurface present)
      : reference_(std::move(reference)), present_(std::move(present)) {}
  bool is_flat_edit(const Journal& journal) const;
  bool keeps_lines_straight(const Journal& journal) const;
  void commit(Journal& journal);

  std::shared_ptr<const Reference> reference_;
  PresentSurface present_;
};

}  // namespace tetmend
