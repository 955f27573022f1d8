// SPDX-License-Identifier: MIT
// Where parts of a mesh touch without being joined.
//
//   vertices of the boundary, by their coordinates: those that lie on others
//   triangles of the boundary along a curve, boxes around each eight of them, around each eight of
//   these, and so on; then each vertex down the boxes that hold it, to triangles of other corners
#include "envelope/unjoined.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "envelope/element.h"
#include "kernel/chunks.h"
#include "kernel/grouped.h"
#include "kernel/hilbert.h"

namespace tetmend {

namespace {

constexpr double kReach = 1e-7;  // of the longest edge of a triangle
constexpr std::size_t kOfBox = 8;

class Finder {
 public:
  explicit Finder(const TetMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
      if (!mesh.is_deleted(VertexHandle(v)) && mesh.is_boundary(VertexHandle(v))) {
        vertices_.push_back(v);
      }
    }
  }

  UnjoinedPoints run() {
    find_places();
    add_triangles();
    add_boxes();
    UnjoinedPoints points;
    points.coincident = vertices_.size() - places_;
    std::vector<char> hangs_at(place_.size(), 0);
    for_chunks(vertices_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t v = vertices_[i];
        if (place_[v] == v && hangs(v)) hangs_at[v] = 1;
      }
    });
    for (const std::uint32_t v : vertices_) points.hanging += hangs_at[place_[v]] != 0 ? 1 : 0;
    return points;
  }

 private:
  const Point& point(std::uint32_t v) const { return mesh_.point(VertexHandle(v)); }

  /// Vertices of the same coordinates have the same place: the first of them.
  void find_places() {
    place_.resize(mesh_.vertex_slots());
    std::size_t size = 64;
    while (size < 2 * vertices_.size()) size *= 2;
    constexpr std::uint32_t kEmpty = UINT32_MAX;
    std::vector<std::uint32_t> table(size, kEmpty);
    for (const std::uint32_t v : vertices_) {
      std::uint64_t hash = 0;
      for (int axis = 0; axis < 3; ++axis) {  // 0 and -0 are the same
        hash = (hash ^ std::bit_cast<std::uint64_t>(point(v)[axis] + 0.0)) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
      }
      std::size_t at = hash & (size - 1);
      while (table[at] != kEmpty && point(table[at]) != point(v)) at = (at + 1) & (size - 1);
      if (table[at] == kEmpty) {
        table[at] = v;
        ++places_;
      }
      place_[v] = table[at];
    }
  }

  void add_triangles() {
    std::vector<Point> centres;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const SurfaceTriangle& each : mesh_.surface_triangles()) {
      if (each.interior || each.loose) continue;
      const auto& v = each.vertices;
      triangles.push_back({place_[v[0].index()], place_[v[1].index()], place_[v[2].index()]});
    }
    if (places_ < vertices_.size()) {  // thousands may lie on each other: one of them is enough
      for (auto& triangle : triangles) std::sort(triangle.begin(), triangle.end());
      std::sort(triangles.begin(), triangles.end());
      triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    }
    for (const auto& [a, b, c] : triangles) {
      centres.emplace_back((point(a) + point(b) + point(c)) / 3);
    }
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    sort_along_curve(centres, order);
    triangles_.reserve(triangles.size());
    for (const std::uint32_t i : order) triangles_.push_back(triangles[i]);
  }

  std::array<Point, 3> corners(const std::array<std::uint32_t, 3>& triangle) const {
    return {point(triangle[0]), point(triangle[1]), point(triangle[2])};
  }

  static double reach(const std::array<Point, 3>& p) {
    return kReach * std::sqrt(std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(),
                                        (p[0] - p[2]).squaredNorm()}));
  }

  /// Level 0 has a box for each triangle.
  void add_boxes() {
    std::vector<Box> boxes(triangles_.size());
    for_chunks(boxes.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::array<Point, 3> p = corners(triangles_[i]);
        const Point around = Point::Constant(reach(p));
        const Box box = box_of(p);
        boxes[i] = {box.min() - around, box.max() + around};
      }
    });
    while (true) {
      levels_.push_back(std::move(boxes));
      const std::vector<Box>& below = levels_.back();
      if (below.size() <= kOfBox) return;
      boxes.assign((below.size() + kOfBox - 1) / kOfBox, Box());
      for (std::size_t i = 0; i < below.size(); ++i) boxes[i / kOfBox].extend(below[i]);
    }
  }

  /// Precondition, here and below: v is a place.
  bool hangs(std::uint32_t v) const {
    const std::size_t top = levels_.size() - 1;
    return hangs(v, top, 0, levels_[top].size());
  }

  bool hangs(std::uint32_t v, std::size_t level, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (!levels_[level][i].contains(point(v))) continue;
      if (level == 0 ? lies_on(v, triangles_[i])
                     : hangs(v, level - 1, kOfBox * i,
                             std::min(kOfBox * (i + 1), levels_[level - 1].size()))) {
        return true;
      }
    }
    return false;
  }

  bool lies_on(std::uint32_t v, const std::array<std::uint32_t, 3>& triangle) const {
    if (std::find(triangle.begin(), triangle.end(), v) != triangle.end()) return false;
    const std::array<Point, 3> p = corners(triangle);
    const double most = reach(p);
    return (nearest_point(p, 3, point(v)) - point(v)).squaredNorm() <= most * most;
  }

  const TetMesh& mesh_;
  std::vector<std::uint32_t> vertices_;  // on the boundary
  std::vector<std::uint32_t> place_;     // by vertex slot
  std::size_t places_ = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles_;  // of places
  std::vector<std::vector<Box>> levels_;
};

}  // namespace

UnjoinedPoints find_unjoined(const TetMesh& mesh) {
  return Finder(mesh).run();
}

std::vector<std::string> describe(const UnjoinedPoints& points, std::size_t of_all) {
  std::vector<std::string> notes;
  const auto lie = [](std::size_t count) { return count == 1 ? "lies" : "lie"; };
  if (points.coincident > 0) {
    notes.push_back(
        fmt::format("{} of {} points {} on others and are not joined: what meets there is surface "
                    "to both sides",
                    grouped(points.coincident), grouped(of_all), lie(points.coincident)));
  }
  if (points.hanging > 0) {
    notes.push_back(fmt::format(
        "{} of {} points {} on a face or an edge of others: what meets there is not joined, and is "
        "surface to both sides",
        grouped(points.hanging), grouped(of_all), lie(points.hanging)));
  }
  return notes;
}

}  // namespace tetmend
