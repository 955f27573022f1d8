// SPDX-License-Identifier: MIT
// One edit of the surface: what becomes of its vertices, feature edges and patches.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "envelope/present_surface.h"
#include "kernel/surface_guard.h"

namespace tetmend {

/// Reads an edit. A working memory: made once, used for one edit after another.
class SurfaceExchange {
 public:
  struct Face {
    std::array<VertexHandle, 3> vertices;
    std::array<Point, 3> points;
    std::uint32_t patch;
  };
  struct Vertex {
    VertexHandle vertex;
    Point point = Point::Zero();     ///< afterwards; of a lost one before
    unsigned before = 0, after = 0;  ///< numbers of faces
    bool moved = false;
    SurfacePlace place = SurfacePlace::inside;  ///< afterwards
  };
  struct Edge {  ///< a feature edge
    std::array<VertexHandle, 2> vertices;
    std::uint32_t line;
  };

  /// False: the edit breaks the surface, a line or a patch, moves or loses a corner, or makes what
  /// is there already. Nothing is said about shapes.
  bool read(const PresentSurface& surface, std::span<const SurfaceFace> before,
            std::span<const SurfaceFace> after);

  std::span<const Face> before() const { return before_; }
  std::span<const Face> after() const { return after_; }
  /// All vertices of both, ascending.
  std::span<const Vertex> vertices() const { return vertices_; }
  const Vertex& vertex(VertexHandle v) const;
  /// Feature edges that vanish; those that come instead; and those with a moved vertex.
  std::span<const Edge> lost() const { return lost_; }
  std::span<const Edge> gained() const { return gained_; }
  std::span<const Edge> moved() const { return moved_; }

  /// Of an edge of `after`: a feature edge, afterwards.
  bool is_feature(const PresentSurface& surface, VertexHandle a, VertexHandle b) const;

 private:
  struct Side {  // of a face
    VertexHandle low, high;
    bool up;
    std::uint32_t face;
    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
    friend auto operator<=>(const Side&, const Side&) = default;
  };
  using Sides = std::vector<Side>;

  bool read_faces(const PresentSurface& surface, std::span<const SurfaceFace> before,
                  std::span<const SurfaceFace> after);
  void list_vertices();
  bool check_vertices(const PresentSurface& surface);
  static void list_sides(std::span<const Face> faces, Sides& sides);
  static std::span<const Side> sides_at(const Sides& sides, VertexHandle a, VertexHandle b);
  bool find_lines(const PresentSurface& surface);
  bool follow(const PresentSurface& surface, std::size_t first, std::vector<char>& done);
  bool replace_path(VertexHandle from, VertexHandle to, std::uint32_t line);
  bool assign_patches(const PresentSurface& surface);
  bool assign_from_border();
  bool check_edges(const PresentSurface& surface) const;
  bool check_gained(const Edge& edge) const;
  bool keeps_topology() const;
  unsigned faces_outside(const PresentSurface& surface, VertexHandle a, VertexHandle b) const;
  Vertex* find(VertexHandle v);

  std::vector<Face> before_, after_;
  std::vector<Vertex> vertices_;
  Sides sides_before_, sides_after_;
  std::vector<Edge> lost_, gained_, moved_;
  std::vector<std::uint32_t> queue_;
  // Of each gained edge: one of the lost ones it stands for, both in the same direction.
  std::vector<std::array<VertexHandle, 2>> stands_for_;
};

}  // namespace tetmend
