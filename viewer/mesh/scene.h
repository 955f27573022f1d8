// SPDX-License-Identifier: MIT
// The triangles and lines of a picture, made from a mesh and the settings: only what can be seen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/tet_mesh.h"
#include "viewer/mesh/colour_map.h"
#include "viewer/mesh/polygon.h"
#include "viewer/mesh/reference_surface.h"
#include "viewer/mesh/visibility.h"

namespace tetmend::viewer {

/// One corner of a triangle, as the graphics card reads it. Three in a row are a triangle.
struct SurfaceVertex {
  glm::vec3 position;  ///< relative to Scene::origin
  Colour colour;
  std::array<std::int8_t, 3> normal;  ///< times 127
  std::uint8_t edges;  ///< bit i: the side opposite corner i of the triangle is drawn
};
static_assert(sizeof(SurfaceVertex) == 20);

/// A straight line of a width in pixels.
struct Line {
  glm::vec3 from;
  glm::vec3 to;
  Colour colour;
  float width;
};

struct Scene {
  glm::dvec3 origin{0};  ///< of all positions, in world coordinates
  std::vector<SurfaceVertex> surface;
  std::vector<TetHandle> surface_tets;  ///< of each triangle of `surface`
  std::vector<SurfaceVertex> through;   ///< constraints and bad tets, seen through the rest
  std::vector<TetHandle> through_tets;  ///< likewise; invalid for constraints
  std::vector<SurfaceVertex> ghosts;    ///< boundary of what is hidden
  std::vector<TetHandle> ghost_tets;
  std::size_t tets_shown = 0;  ///< whole or cut
  std::size_t bad_shown = 0;   ///< bad tets among `through`
  std::string note;            ///< what was left out of the picture, or empty

  /// For those who copy the triangles: under another number everything is another. Since it has
  /// this one, the triangles listed were rewritten in `surface`, `through` and `ghosts`, or are new;
  /// what lies beyond the end is gone.
  std::uint64_t number = 0;
  std::array<std::vector<std::uint32_t>, 3> rewritten;
};

/// More bad tets than this are not seen through the rest; the worst are taken.
inline constexpr std::size_t kMostBadTets = 20000;
/// With more tets shown than this, only those next to what is seen are shrunk and drawn.
inline constexpr std::size_t kMostShrunkTets = 60000;

/// What a scene is made of.
struct SceneInput {
  const TetMesh& mesh;
  const SceneSettings& settings;
  TetFigures figures;                              ///< of settings.measure
  std::span<const float> colour_values;            ///< of settings.colour; empty for "region"
  Range colour_range;                              ///< ends of the colour map
  std::optional<std::span<const TetHandle>> only;  ///< the tets to show, each once; all without
  Ball ball;                                       ///< encloses the mesh
  std::size_t most_bad = kMostBadTets;             ///< seen through the rest
  ReferenceSurface* reference = nullptr;           ///< null: there is none
};

/// Cost: a few passes over the tets, about 30 ms for a million; with `only`, that of these tets.
Scene build_scene(const SceneInput& input);

/// A scene that is kept up while the mesh changes.
class SceneKeeper {
 public:
  const Scene& scene() const { return scene_; }
  /// As build_scene().
  void build(const SceneInput& input);
  /// The tets of these slots have come, gone, changed, or got other figures; settings, ball and
  /// regions are those of the last build, which was without `only`. The triangles are those of a
  /// scene built anew, in another order. Cost: that of the tets and their neighbours.
  void update(const SceneInput& input, std::span<const TetHandle> changed);

 private:
  friend class SceneWork;
  /// The triangles of each tet, as chains.
  struct Chains {
    std::vector<std::uint32_t> first;  // by slot
    std::vector<std::uint32_t> next;   // by triangle
  };
  using Bad = std::pair<Quality, std::uint32_t>;  // and its slot

  Scene scene_;
  std::vector<std::uint8_t> shown_;    // by slot
  std::vector<Quality> bad_quality_;   // by slot; infinite for a tet that is not bad
  std::vector<std::uint8_t> counted_;  // by slot: among tets_shown
  std::vector<std::uint8_t> taken_;    // by slot: bad, and seen through the rest
  std::size_t bad_count_ = 0;
  std::optional<std::vector<std::uint32_t>> only_;  // slots of the last build
  bool is_followed_ = false;                        // what comes now is there
  std::array<Chains, 3> chains_;
  std::set<Bad> taken_order_, rest_order_;
};

/// Appends a polygon as a fan. `normal` is a unit vector.
void add_polygon(std::vector<SurfaceVertex>& out, const Polygon& polygon, const glm::dvec3& normal,
                 const Colour& colour, const glm::dvec3& origin);
/// Appends a triangle with all its edges.
void add_triangle(std::vector<SurfaceVertex>& out, const std::array<glm::dvec3, 3>& corners,
                  const Colour& colour, const glm::dvec3& origin);

/// Corners of a face, and of a tet, in world coordinates.
std::array<glm::dvec3, 3> corners(const TetMesh& mesh, HalfFace face);
std::array<glm::dvec3, 4> corners(const TetMesh& mesh, TetHandle tet);

}  // namespace tetmend::viewer
