// SPDX-License-Identifier: MIT
// The surface as it is now: for each vertex its place, its faces and its feature edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "envelope/features.h"
#include "kernel/surface_guard.h"

namespace tetmend {

/// A face or, with an invalid third vertex, a feature edge; vertices ascending.
using PresentKey = std::array<VertexHandle, 3>;

PresentKey key_of(std::array<VertexHandle, 3> face);
PresentKey key_of(VertexHandle a, VertexHandle b);

/// What is known of a vertex of the surface.
struct SurfaceVertex {
  struct Corner {  ///< of a face: the other vertices, counterclockwise
    VertexHandle next, previous;
    std::uint32_t patch;
    friend bool operator==(const Corner&, const Corner&) = default;
  };
  struct Spoke {  ///< a feature edge
    VertexHandle end;
    std::uint32_t line;
    friend bool operator==(const Spoke&, const Spoke&) = default;
  };
  struct Served {  ///< a face or feature edge that certifies an element of the reference
    PresentKey key;
    std::uint32_t element;
    friend bool operator==(const Served&, const Served&) = default;
  };

  SurfacePlace place = SurfacePlace::inside;
  std::vector<Corner> corners;
  std::vector<Spoke> spokes;
  std::vector<Served> served;  ///< by what has this vertex for its first
  friend bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};

/// Vertices by slot. What workers in different territories change has no vertex in common, and what
/// they read of foreign vertices is their points alone, which nobody moves then.
class PresentSurface {
 public:
  /// @param points by vertex slot
  PresentSurface(std::span<const Point> points, const SurfaceFeatures& features);
  PresentSurface(const PresentSurface& other);
  PresentSurface(PresentSurface&&) noexcept = default;
  PresentSurface& operator=(const PresentSurface&) = delete;
  PresentSurface& operator=(PresentSurface&&) noexcept = default;
  ~PresentSurface() = default;

  std::size_t slots() const { return vertices_.size(); }
  /// Null for a vertex that is not on the surface.
  const SurfaceVertex* find(VertexHandle v) const {
    return v.index() < vertices_.size() ? vertices_[v.index()].get() : nullptr;
  }
  SurfaceVertex* find(VertexHandle v) {
    return v.index() < vertices_.size() ? vertices_[v.index()].get() : nullptr;
  }
  const Point& point(VertexHandle v) const { return points_[v.index()]; }
  SurfacePlace place(VertexHandle v) const {
    const SurfaceVertex* vertex = find(v);
    return vertex == nullptr ? SurfacePlace::inside : vertex->place;
  }
  /// SurfaceGuard::kNone if there is no such face; in any order, or in this sense.
  std::uint32_t patch(const std::array<VertexHandle, 3>& face) const;
  std::uint32_t patch_of_oriented(const std::array<VertexHandle, 3>& face) const;
  std::uint32_t line(VertexHandle a, VertexHandle b) const;

  /// Puts a vertex and its point in place and takes out what was there.
  void exchange(VertexHandle v, std::unique_ptr<SurfaceVertex>& vertex, Point& point) noexcept {
    vertices_[v.index()].swap(vertex);
    // Other workers may read the point of a vertex that stays where it is.
    if (points_[v.index()] != point) std::swap(points_[v.index()], point);
  }
  void resize(std::size_t slots);
  void renumber(std::span<const VertexHandle> new_vertex, std::size_t slots);

  /// Same vertices, in the same order of faces, edges and certificates, at the same points.
  friend bool operator==(const PresentSurface& a, const PresentSurface& b);

 private:
  std::vector<std::unique_ptr<SurfaceVertex>> vertices_;
  std::vector<Point> points_;  // of vertices on the surface
};

}  // namespace tetmend
