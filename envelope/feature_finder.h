// SPDX-License-Identifier: MIT
// How the features of a surface are found. Only for the sources that do it.
//
//   faces -> sides, sorted by edge -> which edges are smooth -> patches -> feature edges -> corners ->
//   lines
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "envelope/features.h"
#include "envelope/planes.h"
#include "kernel/geometry.h"

namespace tetmend {

/// Finds the features of one surface.
class FeatureFinder {
 public:
  FeatureFinder(SurfaceInput surface, std::span<const Point> points, double flatness,
                const FeatureOptions& options)
      : points_(points),
        options_(options),
        least_cosine_(std::cos(options.angle * std::numbers::pi / 180)),
        flatness_(flatness),
        kinds_(std::move(surface.kinds)),
        kept_(std::move(surface.kept)),
        held_(std::move(surface.held)),
        named_(std::move(surface.named)),
        walls_(std::move(surface.walls)) {
    found_.faces = std::move(surface.faces);
    kept_.insert(kept_.end(), options.kept.begin(), options.kept.end());
    held_.insert(held_.end(), options.held.begin(), options.held.end());
    kept_.insert(kept_.end(), held_.begin(), held_.end());
  }

  SurfaceFeatures find() {
    note_vertices();
    hold_faces();
    sort_named_edges();
    sort_sides();
    join_faces();
    if (options_.flat) {
      split_by_planes();
    } else {
      number_patches();
    }
    collect_edges();
    find_corners();
    make_lines();
    return std::move(found_);
  }

 private:
  using Ends = std::array<VertexHandle, 2>;
  using Kind = SurfaceInput::Kind;
  using Named = SurfaceInput::NamedEdge;
  struct Side {
    Ends ends;
    std::uint32_t face;
    bool up;  // the face runs from the lower end to the higher
  };
  struct FeatureEdge {
    Ends ends;
    std::uint32_t first_side, last_side;
    Label label;
    bool named;
    bool held;
  };

  static Ends ends_of(VertexHandle a, VertexHandle b) { return a < b ? Ends{a, b} : Ends{b, a}; }
  const Point& point(VertexHandle v) const { return points_[v.index()]; }
  void keep(VertexHandle v) { kept_.push_back(v); }
  template <std::size_t N>
  bool are_held(const std::array<VertexHandle, N>& vertices) const {
    return !held_.empty() && std::all_of(vertices.begin(), vertices.end(), [this](VertexHandle v) {
      return std::binary_search(held_.begin(), held_.end(), v);
    });
  }
  void note_vertices();
  void hold_faces();
  void sort_named_edges();
  void sort_sides();
  void join_faces();
  bool is_smooth(std::size_t begin, std::size_t end) const;
  Point normal(std::uint32_t face) const {
    const auto& v = found_.faces[face].vertices;
    const Point n = (point(v[1]) - point(v[0])).cross(point(v[2]) - point(v[0]));
    const double length = n.norm();
    return length > 0 ? Point(n / length) : Point::Zero();
  }
  void number_patches();
  void split_by_planes();
  void add_patch(std::uint32_t face, const Plane& plane);
  void collect_edges();
  void find_corners();
  std::vector<std::uint32_t> count_fans() const;
  void mark_pinched();
  bool bends(std::uint32_t e, std::uint32_t f, VertexHandle v) const;
  bool same_sides(const FeatureEdge& a, const FeatureEdge& b, VertexHandle middle) const;
  void make_lines();
  void walk(VertexHandle from, std::uint32_t edge, std::vector<char>& done);
  void add_line(const std::vector<VertexHandle>& chain, std::uint32_t edge);
  std::size_t straight_end(const std::vector<VertexHandle>& chain, std::size_t begin) const;
  std::span<const std::uint32_t> edges_at(VertexHandle v) const {
    const auto begin = first_edge_[v.index()];
    return {edges_of_.data() + begin, first_edge_[v.index() + 1] - begin};
  }

  const std::span<const Point> points_;
  const FeatureOptions& options_;
  double least_cosine_;
  double flatness_;
  SurfaceFeatures found_;
  std::vector<Kind> kinds_;  // of each face
  std::vector<VertexHandle> kept_;
  std::vector<VertexHandle> held_;         // sorted
  std::vector<Named> named_;               // sorted
  std::vector<Ends> walls_;                // edges of faces named inside a region, sorted
  std::vector<Side> sides_;                // sorted by edge
  std::vector<std::uint32_t> group_;       // first side of each edge, then the number of sides
  std::vector<char> smooth_;               // of each edge
  std::vector<std::uint32_t> neighbours_;  // 3 of each face across smooth edges, or itself
  std::vector<FeatureEdge> edges_;
  std::vector<std::uint32_t> edges_of_;  // by vertex
  std::vector<std::uint32_t> first_edge_;
};

}  // namespace tetmend
