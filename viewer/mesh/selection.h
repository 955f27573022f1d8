// SPDX-License-Identifier: MIT
// The tet, edge, face or vertex that the user looks at: found by a ray, drawn as lines and faces, told in
// words.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kernel/shell.h"
#include "kernel/tet_mesh.h"
#include "viewer/mesh/camera.h"
#include "viewer/mesh/scene.h"

namespace tetmend::viewer {

/// Nothing, or one of the four.
using Selection = std::variant<std::monostate, TetHandle, TetEdge, HalfFace, VertexHandle>;

/// What a click takes: what is close to the mouse, or always the same kind.
enum class PickKind { nearest, tet, edge, face, vertex };

struct Hit {
  TetHandle tet;
  glm::dvec3 point{0};  ///< in world coordinates
};

/// The first triangle of the surface that the ray meets. Cost: linear in the triangles, a few
/// milliseconds for a million.
std::optional<Hit> cast(const Scene& scene, const Ray& ray);

/// The first bad tet that the ray meets, of those that are seen through the rest. Cost: likewise.
std::optional<Hit> cast_through(const Scene& scene, const Ray& ray);

/// The tet of the hit, or its edge, face or vertex. PickKind::nearest takes a vertex or an edge only when
/// the mouse is within a few pixels of it.
Selection refine(const TetMesh& mesh, const Hit& hit, PickKind kind, const Camera& camera,
                 const Canvas& canvas);

/// Around the selection, large enough to see it in its surroundings. Precondition: not nothing.
Ball ball_around(const TetMesh& mesh, const Selection& selection);

/// Faces and lines on top of the picture. An edge shows its shell: the skirt polygon, and the outlines
/// of supporting faces and link faces.
struct Highlight {
  std::vector<SurfaceVertex> faces;
  std::vector<Line> lines;
};
Highlight highlight(const TetMesh& mesh, const Selection& selection, const glm::dvec3& origin);

/// A vertex, an edge, a face or a tet that is marked by its corners: what a call aimed at, in a mesh
/// that may not have it any more.
Highlight highlight_points(std::span<const Point> corners, const glm::dvec3& origin);

/// A row of a table, in words of the paper.
struct Row {
  std::string name, value;
  /// What the value names: one for the whole of it, or one for each of its words.
  std::vector<Selection> links;
};
std::vector<Row> describe(const TetMesh& mesh, const Selection& selection);

/// A vertex with its number to be written beside it. The role is "a", "b", "p1", ... in a shell, or
/// empty.
struct NamedVertex {
  VertexHandle vertex;
  std::string role;
  friend bool operator==(const NamedVertex&, const NamedVertex&) = default;
};
/// Of a tet or a face its corners, of an edge its shell, of a vertex it and its neighbours.
std::vector<NamedVertex> names_of(const TetMesh& mesh, const Selection& selection);

}  // namespace tetmend::viewer
