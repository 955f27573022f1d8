// SPDX-License-Identifier: MIT
// Patches, feature lines and corners of the surface of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <tetmend/api.h>

#include "kernel/surface_guard.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// What counts as a feature.
struct TETMEND_API FeatureOptions {
  /// Two faces whose outward normals differ by more, and two edges of a line whose directions do,
  /// meet at a feature. Degrees.
  double angle = 40;
  /// Patches are flat and lines straight, up to flatness(). Wherever faces of different planes
  /// meet is a feature.
  bool flat = false;
  /// Vertices that stay, besides those that the mesh asks for.
  std::vector<VertexHandle> kept;
  /// Faces and edges of the surface all of whose vertices are among these stay as they are. They are
  /// kept, too.
  std::vector<VertexHandle> held = {};
};

/// The surface of a mesh: its boundary, and its faces between labels.
///
/// A *patch* is a set of faces joined by edges that are no features. A *feature edge* lies between
/// faces of different labels (of the triangles, or of the tets on both sides), at a bend, where more
/// or fewer than two faces meet, at a face named inside a region, at a face that is held, or is named by
/// the file. A *line*
/// is a chain of feature edges between corners, or a ring of them. A *corner* is a vertex of one
/// feature edge, or of more than two; where a line bends, or what lies at its sides changes; where
/// sheets touch; and each vertex that the file requires or that is frozen.
struct TETMEND_API SurfaceFeatures {
  struct Patch {
    std::array<Label, 2> sides{};  ///< of the tets behind and before it; no second one outside
    Label label = 0;               ///< of its triangles
    bool named = false;            ///< the file lists its triangles
    bool interior = false;         ///< between two labels
    bool held = false;             ///< none of its triangles may go
    Point origin = Point::Zero();  ///< of its plane, if flat
    Point normal = Point::Zero();  ///< outward unit normal of its plane, if flat
  };
  struct Line {
    Label label = 0;
    bool named = false;               ///< the file lists its edges
    bool held = false;                ///< none of its edges may go
    Point origin = Point::Zero();     ///< if straight
    Point direction = Point::Zero();  ///< unit, if straight
  };
  struct Face {
    std::array<VertexHandle, 3> vertices;  ///< counterclockwise as in SurfaceFace
    std::uint32_t patch = 0;
  };
  struct Edge {
    std::array<VertexHandle, 2> vertices;  ///< along the line
    std::uint32_t line = 0;
  };

  std::vector<Face> faces;
  std::vector<Edge> edges;  ///< feature edges, line after line, in their order
  std::vector<Patch> patches;
  std::vector<Line> lines;
  std::vector<SurfacePlace> places;  ///< by vertex slot
};

/// What the features of a surface follow from, besides the points.
struct TETMEND_API SurfaceInput {
  struct Kind {  ///< faces of different kinds are never of one patch
    std::array<Label, 2> sides{};
    Label label = 0;
    bool named = false;
    bool interior = false;
    bool held = false;  ///< found with the features
  };
  struct NamedEdge {
    std::array<VertexHandle, 2> vertices;
    Label label = 0;
  };

  std::vector<SurfaceFeatures::Face> faces;
  std::vector<Kind> kinds;       ///< of each face
  std::vector<NamedEdge> named;  ///< by the file, also those that are not on the surface
  std::vector<std::array<VertexHandle, 2>> walls;  ///< edges of faces named inside a region
  /// Vertices that stay: frozen ones, those of walls and of triangles that are no face.
  std::vector<VertexHandle> kept;
  std::vector<VertexHandle> held;  ///< required ones: see FeatureOptions
};

/// Of a mesh; with deleted vertex slots and frozen tets, as it is. Cost: linear, but for sorting the
/// faces between labels.
TETMEND_API SurfaceInput read_surface(const TetMesh& mesh);

/// The points of all vertex slots, as they lie in the mesh; of a deleted vertex anything.
TETMEND_API std::span<const Point> points_by_slot(const TetMesh& mesh);

/// How far the points of a flat patch or a straight line may lie from it: 1e-13 of the diagonal of
/// the mesh, or what rounding of its coordinates makes.
TETMEND_API double flatness(const TetMesh& mesh);
/// Of a mesh with that box.
TETMEND_API double flatness(const Point& low, const Point& high);

/// Finds them. Precondition: none; folded and non-manifold surfaces have more corners. Cost: sorting
/// the edges of the surface.
TETMEND_API SurfaceFeatures find_features(const TetMesh& mesh, const FeatureOptions& options);
/// @param points by vertex
TETMEND_API SurfaceFeatures find_features(SurfaceInput surface, std::span<const Point> points,
                                          double flatness, const FeatureOptions& options);

}  // namespace tetmend
