// SPDX-License-Identifier: MIT
// The triangles and lines of a picture, made from a mesh and the settings: only what can be seen.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/tet_mesh.h"
#include "viewer/mesh/colour_map.h"
#include "viewer/mesh/polygon.h"
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
  std::vector<SurfaceVertex> through;   ///< bad tets and constraints, seen through the rest
  std::vector<SurfaceVertex> ghosts;    ///< boundary of what is hidden
  std::size_t tets_shown = 0;           ///< whole or cut
  std::size_t bad_shown = 0;            ///< bad tets among `through`
  std::string note;                     ///< what was left out of the picture, or empty
};

/// More bad tets than this are not seen through the rest; the worst are taken.
inline constexpr std::size_t kMostBadTets = 20000;
/// With more tets shown than this, only those next to what is seen are shrunk and drawn.
inline constexpr std::size_t kMostShrunkTets = 60000;

/// What a scene is made of.
struct SceneInput {
  const TetMesh& mesh;
  const SceneSettings& settings;
  TetFigures figures;                    ///< of settings.measure
  std::span<const float> colour_values;  ///< of settings.colour; empty for "region"
  Range colour_range;                    ///< ends of the colour map
  std::span<const std::uint8_t> only;    ///< by slot: the tets to show, if not empty
  Ball ball;                             ///< encloses the mesh
};

/// Cost: a few passes over the tets, about 30 ms for a million.
Scene build_scene(const SceneInput& input);

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
