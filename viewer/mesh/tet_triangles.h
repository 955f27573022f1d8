// SPDX-License-Identifier: MIT
// The triangles that a scene draws for one tet.
#pragma once

#include <span>
#include <vector>

#include "viewer/mesh/scene.h"

namespace tetmend::viewer {

/// Reads which tets are shown and which are seen through the rest, by slot. What it is made of must
/// outlive it.
class TetTriangles {
 public:
  TetTriangles(const SceneInput& input, const std::vector<std::uint8_t>& shown,
               const std::vector<std::uint8_t>& taken);

  /// A needle whose angles are good is not bad.
  bool is_bad(TetHandle t) const;
  /// Exact cuts leave nothing of it.
  bool is_cut_away(TetHandle t) const;
  /// Planes cut through tets.
  bool cuts_tets() const { return !exact_.empty(); }
  /// Tets are drawn shrunk; `all` of them, or those next to what is seen.
  bool is_shrunk() const { return settings_.shrink > 0; }
  void shrink_all(bool all) { shrinks_all_ = all; }

  // Each appends to `out`. The tet of the first is shown, that of the second is taken.
  void add_surface(TetHandle t, std::vector<SurfaceVertex>& out) const;
  void add_through(TetHandle t, std::vector<SurfaceVertex>& out) const;
  void add_ghosts(TetHandle t, std::vector<SurfaceVertex>& out) const;

 private:
  bool is_shown(TetHandle t) const { return shown_[t.index()] != 0; }
  bool is_exposed(HalfFace face) const;
  bool is_near_the_eye(TetHandle t) const;
  bool remains(Polygon polygon, std::size_t skipped_plane) const;
  Colour colour_of(TetHandle t) const;
  Colour colour_of(HalfFace face, const Colour& of_tet) const;
  std::uint8_t alpha_of(Quality quality) const;
  std::array<glm::dvec3, 4> shrunk(TetHandle t) const;
  void add_cut(Polygon polygon, const glm::dvec3& normal, const Colour& colour,
               std::size_t skipped_plane, std::vector<SurfaceVertex>& out) const;
  void add_faces(TetHandle t, const Colour& colour, std::vector<SurfaceVertex>& out) const;

  const SceneInput& in_;
  const TetMesh& mesh_;
  const SceneSettings& settings_;
  const std::vector<std::uint8_t>& shown_;
  const std::vector<std::uint8_t>& taken_;
  Standard angles_;
  const ColourMap& map_;
  std::vector<Plane> exact_;
  bool shrinks_all_ = true;
};

}  // namespace tetmend::viewer
