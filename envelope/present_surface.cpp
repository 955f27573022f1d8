// SPDX-License-Identifier: MIT
#include "envelope/present_surface.h"

#include <algorithm>
#include <utility>

namespace tetmend {

PresentKey key_of(std::array<VertexHandle, 3> face) {
  std::sort(face.begin(), face.end());
  return face;
}

PresentKey key_of(VertexHandle a, VertexHandle b) {
  return a < b ? PresentKey{a, b, {}} : PresentKey{b, a, {}};
}

PresentSurface::PresentSurface(std::span<const Point> points, const SurfaceFeatures& features)
    : vertices_(points.size()), points_(points.size(), Point::Zero()) {
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
    if (features.places[i] == SurfacePlace::inside) continue;
    vertices_[i] = std::make_unique<SurfaceVertex>();
    vertices_[i]->place = features.places[i];
    points_[i] = points[i];
  }
  for (const auto& face : features.faces) {
    for (unsigned k = 0; k < 3; ++k) {
      const auto& v = face.vertices;
      vertices_[v[k].index()]->corners.push_back({v[(k + 1) % 3], v[(k + 2) % 3], face.patch});
    }
  }
  for (const auto& edge : features.edges) {
    for (unsigned k = 0; k < 2; ++k) {
      vertices_[edge.vertices[k].index()]->spokes.push_back({edge.vertices[1 - k], edge.line});
    }
  }
}

PresentSurface::PresentSurface(const PresentSurface& other)
    : vertices_(other.vertices_.size()), points_(other.points_) {
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (other.vertices_[i]) vertices_[i] = std::make_unique<SurfaceVertex>(*other.vertices_[i]);
  }
}

std::uint32_t PresentSurface::patch_of_oriented(const std::array<VertexHandle, 3>& face) const {
  if (const SurfaceVertex* vertex = find(face[0])) {
    for (const auto& corner : vertex->corners) {
      if (corner.next == face[1] && corner.previous == face[2]) return corner.patch;
    }
  }
  return SurfaceGuard::kNone;
}

std::uint32_t PresentSurface::patch(const std::array<VertexHandle, 3>& face) const {
  const std::uint32_t patch = patch_of_oriented(face);
  return patch != SurfaceGuard::kNone ? patch : patch_of_oriented({face[0], face[2], face[1]});
}

std::uint32_t PresentSurface::line(VertexHandle a, VertexHandle b) const {
  if (const SurfaceVertex* vertex = find(a)) {
    for (const auto& spoke : vertex->spokes) {
      if (spoke.end == b) return spoke.line;
    }
  }
  return SurfaceGuard::kNone;
}

void PresentSurface::resize(std::size_t slots) {
  points_.resize(slots, Point::Zero());
  vertices_.resize(slots);
}

void PresentSurface::renumber(std::span<const VertexHandle> new_vertex, std::size_t slots) {
  std::vector<std::unique_ptr<SurfaceVertex>> vertices(slots);
  std::vector<Point> points(slots, Point::Zero());
  std::vector<SurfaceVertex::Served> served;
  const auto number = [&](VertexHandle v) {
    return v.is_valid() ? new_vertex[v.index()] : VertexHandle();
  };
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (!vertices_[i]) continue;
    SurfaceVertex& vertex = *vertices_[i];
    for (auto& corner : vertex.corners) {
      corner.next = number(corner.next);
      corner.previous = number(corner.previous);
    }
    for (auto& spoke : vertex.spokes) spoke.end = number(spoke.end);
    for (const auto& entry : vertex.served) {
      const auto& k = entry.key;
      served.push_back({k[2].is_valid() ? key_of({number(k[0]), number(k[1]), number(k[2])})
                                        : key_of(number(k[0]), number(k[1])),
                        entry.element});
    }
    vertex.served.clear();
    points[new_vertex[i].index()] = points_[i];
    vertices[new_vertex[i].index()] = std::move(vertices_[i]);
  }
  for (const auto& entry : served) vertices[entry.key[0].index()]->served.push_back(entry);
  vertices_ = std::move(vertices);
  points_ = std::move(points);
}

bool operator==(const PresentSurface& a, const PresentSurface& b) {
  // A mesh may take back slots that it grew by; here they stay, without a vertex.
  for (std::size_t i = 0; i < std::max(a.vertices_.size(), b.vertices_.size()); ++i) {
    const SurfaceVertex* v = i < a.vertices_.size() ? a.vertices_[i].get() : nullptr;
    const SurfaceVertex* w = i < b.vertices_.size() ? b.vertices_[i].get() : nullptr;
    if ((v == nullptr) != (w == nullptr)) return false;
    if (v != nullptr && (!(*v == *w) || a.points_[i] != b.points_[i])) return false;
  }
  return true;
}

}  // namespace tetmend
