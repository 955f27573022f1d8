// SPDX-License-Identifier: MIT
#include "face/surface_points.h"

#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <tetmend/improve.h>

#include "envelope/element.h"
#include "face/bodies.h"
#include "kernel/tet_faces.h"

namespace tetmend::face {

namespace {

using TriangleCorners = std::array<std::uint32_t, 3>;

/// A face, with a tet that has it on one of its sides.
struct SurfaceFace {
  TriangleCorners vertices;
  std::uint32_t tet = 0;
};

std::vector<SurfaceFace> surface(const MeshData& data) {
  std::vector<SurfaceFace> faces;
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    if (other != nullptr && data.tets[face.tet].label == data.tets[other->tet].label) return;
    faces.push_back({face.vertices, face.tet});
    if (other != nullptr) faces.push_back({other->vertices, other->tet});
  });
  return faces;
}

/// Twice the area of p, a, b, as a share of that of the triangle: the weight of the third corner.
double weight(const Point& p, const Point& a, const Point& b, double area) {
  return area > 0 ? (a - p).cross(b - p).norm() / area : 1;
}

}  // namespace

Label common_label(const std::array<Point, 3>& at, const std::array<Label, 3>& labels,
                   const Point& p) {
  constexpr double kNone = 1e-9;
  const double area = (at[1] - at[0]).cross(at[2] - at[0]).norm();
  bool any = false;
  Label label = 0;
  for (unsigned k = 0; k < 3; ++k) {
    if (weight(p, at[(k + 1) % 3], at[(k + 2) % 3], area) <= kNone) continue;
    if (any && labels[k] != label) return 0;
    label = labels[k];
    any = true;
  }
  return label;
}

namespace {

/// The surface of the old mesh, body by body.
class OldSurface {
 public:
  OldSurface(const MeshData& before, const Bodies& bodies)
      : before_(before), faces_(surface(before)), elements_(faces_.size()) {
    std::vector<std::uint32_t> body_of;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        elements_[i].points[k] = before.points[faces_[i].vertices[k]];
      }
      body_of.push_back(bodies.of_tet(faces_[i].tet));
    }
    tree_ = ElementTree(elements_, body_of, bodies.count());
  }

  /// What a point of one of these bodies takes from the nearest face of them.
  Label label_at(const Point& p, std::span<const std::uint32_t> bodies) const {
    ElementTree::Nearest nearest;
    for (const std::uint32_t body : bodies) {
      const ElementTree::Nearest here = tree_.nearest(elements_, body, p);
      if (here.distance2 < nearest.distance2) nearest = here;
    }
    std::array<Label, 3> labels{};
    for (unsigned k = 0; k < 3; ++k) {
      labels[k] = before_.point_labels[faces_[nearest.element].vertices[k]];
    }
    return common_label(elements_[nearest.element].points, labels, nearest.point);
  }

 private:
  const MeshData& before_;
  std::vector<SurfaceFace> faces_;
  std::vector<Element> elements_;
  ElementTree tree_;
};

}  // namespace

void label_surface_points(const MeshData& before, std::span<const std::uint32_t> vertex_map,
                          MeshData& now) {
  if (before.point_labels.empty() || now.point_labels.empty()) return;
  std::vector<std::uint32_t> old_point(now.points.size(), kGone);
  for (std::uint32_t v = 0; v < vertex_map.size(); ++v) {
    if (vertex_map[v] != kGone) old_point[vertex_map[v]] = v;
  }
  std::vector<char> is_done(now.points.size(), 0);
  std::vector<std::uint32_t> points;
  for (const SurfaceFace& face : surface(now)) {
    for (const std::uint32_t v : face.vertices) {
      if (old_point[v] != kGone || std::exchange(is_done[v], 1) != 0) continue;
      points.push_back(v);
    }
  }
  if (points.empty()) return;
  std::vector<std::uint32_t> all(now.tets.size());
  std::iota(all.begin(), all.end(), 0U);
  const Origins origins(now, old_point, all, Bodies(before));
  const OldSurface old(before, origins.bodies());
  Origin origin;
  for (const std::uint32_t v : points) {
    origins.of_point(v, origin);
    if (origin.bodies.empty()) origin.bodies = {0};  // there is one
    now.point_labels[v] = old.label_at(now.points[v], origin.bodies);
  }
}

}  // namespace tetmend::face
