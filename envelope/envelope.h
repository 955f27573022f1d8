// SPDX-License-Identifier: MIT
// The guard that lets the surface move within a tolerance, and proves at every moment that it did
// not move farther.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "envelope/features.h"
#include "envelope/present_surface.h"
#include "envelope/reference.h"
#include "envelope/replacement.h"
#include "kernel/surface_guard.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// How far the surface may move, eps. Both 0: not at all, see Envelope.
struct TETMEND_API EnvelopeOptions {
  double share = 0;   ///< of the mean edge length of each triangle of the input
  double length = 0;  ///< the same everywhere, in lengths of the mesh (TetMesh::scale()); not both
  double angle = 40;  ///< of features, in degrees
  std::vector<VertexHandle> kept = {};  ///< further vertices that stay
  std::vector<VertexHandle> held = {};  ///< what lies between these stays, see FeatureOptions

  bool is_flat() const { return share == 0 && length == 0; }
};

/// @throws Error for an angle, a share or a length that is none.
TETMEND_API void check(const EnvelopeOptions& options, double flatness);

/// What is proven of the present surface.
struct TETMEND_API SurfaceBound {
  double distance = 0;       ///< no point of either surface is farther from the other, by patch
  double share = 0;          ///< the largest share of a tolerance that was used
  std::size_t faces = 0;     ///< of the present surface
  std::size_t touched = 0;   ///< of them those that are no triangles of the reference
  std::size_t unproven = 0;  ///< faces, feature edges and elements without a proof that was found
};

/// Keeps the surface of a mesh near the one that it had when the envelope was made, the *reference*.
///
/// Tolerance 0: the present surface *is* the reference, up to flatness(). Vertices move, come and
/// go inside flat patches and along straight lines only. The faces that an edit makes lie in the
/// plane of their patch, all turned the same way as certified signs say, and have the border that
/// the old ones had. So they cover the same part of the plane, each point once.
///
/// Other tolerances, eps: each present face lies within eps of its patch of the reference, and each
/// triangle of the reference within eps of present faces of its patch, wholly. Likewise each edge of
/// a line. Corners do not move at all, and what is held stays in both cases. CoverTest proves the first of each face that comes. For the
/// second, each triangle and segment of the reference, an *element*, keeps a list of present faces
/// or edges that certify it together. An edit that takes one of them away asks for a new proof.
/// Only what is turned by 30 degrees or less against each other certifies, so nothing folds over,
/// and an edit may not add more than a share to the bends of what it changes.
class TETMEND_API Envelope final : public SurfaceGuard {
 public:
  /// Of the mesh as it is. @throws Error for an angle, a share or a length that is none.
  static std::unique_ptr<Envelope> of(const TetMesh& mesh, const EnvelopeOptions& options);
  /// Of a present surface, or a part of one, that is near the reference already. An element that
  /// the part proves alone keeps that proof. Others are covered by what lies outside, too: of them
  /// no face or edge that may take part goes, unless what comes proves the element alone.
  /// @param points by vertex slot
  /// @param present faces, edges and places; a vertex that has faces elsewhere is a corner
  static std::unique_ptr<Envelope> of_part(std::shared_ptr<const Reference> reference,
                                           std::span<const Point> points,
                                           const SurfaceFeatures& present);

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
  /// Cost: for tolerance 0 linear in the number of faces, apart from sorting. Else some
  /// microseconds for each face and each element that they certify.
  bool replace(std::span<const SurfaceFace> before, std::span<const SurfaceFace> after,
               SurfaceJournal& journal) override;
  void undo(SurfaceJournal& journal) noexcept override;
  void resize(std::size_t vertex_slots) override;
  void renumber(std::span<const VertexHandle> new_vertex, std::size_t vertex_slots) override;

  /// Proves anew how near both surfaces are. Precondition: no edit is under way. Cost: some
  /// microseconds for each face that was touched; not for several threads at once.
  SurfaceBound proven_bound() const;
  /// The same from nothing but the surfaces, with pieces as many as it takes. With tolerance 0: each
  /// face lies in its patch, turned the right way, and patches have the areas that they had.
  /// Precondition: this is the whole surface.
  SurfaceBound prove() const;
  /// Its faces, feature edges and places, by vertex slot.
  SurfaceFeatures present() const;
  /// Largest distance of a point of either surface from the other, at (side + 1) (side + 2) / 2
  /// points of each triangle that was touched or is gone: for reports, a lower bound. Cost: a
  /// nearest triangle for each point, in parallel.
  double sampled_distance(unsigned side) const;
  const Reference& reference() const { return *reference_; }

  /// The same present surface and the same proof, in the same order.
  friend bool operator==(const Envelope& a, const Envelope& b) {
    return a.present_ == b.present_ && a.covers_ == b.covers_;
  }

 private:
  class Journal;

  struct JournalStep {  ///< where it begins in the lists of the journal
    std::size_t saved, covers;
  };

  Envelope(std::shared_ptr<const Reference> reference, PresentSurface present)
      : reference_(std::move(reference)), present_(std::move(present)) {}
  void certify_input(const SurfaceFeatures& features);
  void certify_part(const SurfaceFeatures& present);
  void add_certifiers(Journal& journal, std::uint32_t element, const std::vector<PresentKey>& near);
  bool lies_flat(const std::array<Point, 3>& points, std::uint32_t patch) const;
  std::size_t count_unproven_patches() const;
  SurfaceBound bound(Journal& journal) const;
  bool keeps_held(const Journal& journal) const;
  bool is_flat_edit(const Journal& journal) const;
  bool keeps_lines_straight(const Journal& journal) const;
  bool is_near_edit(Journal& journal) const;
  bool lies_near(Journal& journal, const std::array<Point, 3>& points, unsigned corners,
                 std::uint32_t sheet, bool nearest = false) const;
  bool offer_present(Journal& journal, std::uint32_t element,
                     const std::vector<PresentKey>& keys) const;
  bool certify_elements(Journal& journal) const;
  bool certify(Journal& journal, std::uint32_t element) const;
  bool bends_too_much(const Journal& journal) const;
  double bending(const SurfaceExchange& edit, std::span<const SurfaceExchange::Face> faces) const;
  void commit(Journal& journal);
  void exchange(Journal& journal, const JournalStep& step) noexcept;

  std::shared_ptr<const Reference> reference_;
  PresentSurface present_;
  /// Of each element what certifies it. Empty if all is flat.
  std::vector<std::vector<PresentKey>> covers_;
};

}  // namespace tetmend
