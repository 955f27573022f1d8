// SPDX-License-Identifier: MIT
#include "face/surface_points.h"

#include <array>
#include <cstddef>
#include <vector>

#include <tetmend/improve.h>

#include "envelope/element.h"
#include "kernel/tet_faces.h"

namespace tetmend::face {

namespace {

using Corners = std::array<std::uint32_t, 3>;

std::vector<Corners> surface(const MeshData& data) {
  std::vector<Corners> faces;
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    if (other == nullptr || data.tets[face.tet].label != data.tets[other->tet].label) {
      faces.push_back(face.vertices);
    }
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

void label_surface_points(const MeshData& before, std::span<const std::uint32_t> vertex_map,
                          MeshData& now) {
  if (before.point_labels.empty() || now.point_labels.empty()) return;
  std::vector<char> is_new(now.points.size(), 1);
  for (const std::uint32_t v : vertex_map) {
    if (v != kGone) is_new[v] = 0;
  }
  std::vector<std::uint32_t> points;
  for (const Corners& face : surface(now)) {
    for (const std::uint32_t v : face) {
      if (is_new[v] == 0) continue;
      points.push_back(v);
      is_new[v] = 0;
    }
  }
  if (points.empty()) return;
  const std::vector<Corners> faces = surface(before);
  std::vector<Element> elements(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) elements[i].points[k] = before.points[faces[i][k]];
  }
  const ElementTree tree(elements, std::vector<std::uint32_t>(faces.size(), 0), 1);
  for (const std::uint32_t v : points) {
    const ElementTree::Nearest nearest = tree.nearest(elements, 0, now.points[v]);
    const Corners& face = faces[nearest.element];
    std::array<Label, 3> labels{};
    for (unsigned k = 0; k < 3; ++k) labels[k] = before.point_labels[face[k]];
    now.point_labels[v] = common_label(elements[nearest.element].points, labels, nearest.point);
  }
}

}  // namespace tetmend::face
