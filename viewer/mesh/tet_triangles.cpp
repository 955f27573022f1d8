// SPDX-License-Identifier: MIT
#include "viewer/mesh/tet_triangles.h"

#include <algorithm>
#include <cmath>

namespace tetmend::viewer {

namespace {

glm::dvec3 normal_of(const std::array<glm::dvec3, 3>& c) {
  const glm::dvec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
  const double length = glm::length(n);
  return length > 0 ? n / length : glm::dvec3(0, 0, 1);
}

Polygon to_polygon(const std::array<glm::dvec3, 3>& corners) {
  Polygon polygon;
  for (const glm::dvec3& corner : corners) polygon.add(corner, true);
  return polygon;
}

}  // namespace

TetTriangles::TetTriangles(const SceneInput& input, const std::vector<std::uint8_t>& shown,
                           const std::vector<std::uint8_t>& taken)
    : in_(input),
      mesh_(input.mesh),
      settings_(input.settings),
      shown_(shown),
      taken_(taken),
      angles_(input.mesh.standard().of_angles()),
      map_(find_colour_map(input.settings.map)),
      exact_(planes_of(input.settings, input.ball, true)) {}

bool TetTriangles::is_exposed(HalfFace face) const {
  const HalfFace twin = mesh_.twin(face);
  return twin.is_outside() || !is_shown(twin.tet());
}

bool TetTriangles::is_bad(TetHandle t) const {
  if (!settings_.bad || static_cast<double>(mesh_.quality(t)) >= settings_.bad_below) return false;
  const TetVertices& v = mesh_.vertices(t);
  const double of_angles =
      angles_.quality(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
  return static_cast<double>(static_cast<Quality>(of_angles)) < settings_.bad_below;
}

bool TetTriangles::is_cut_away(TetHandle t) const {
  if (exact_.empty()) return false;
  const auto c = corners(mesh_, t);
  bool is_whole = true;
  for (const Plane& plane : exact_) {
    unsigned below = 0;
    for (const glm::dvec3& p : c) below += plane.height(p) < 0 ? 1 : 0;
    if (below == 0) return true;
    is_whole = is_whole && below == 4;
  }
  if (is_whole || exact_.size() == 1) return false;
  // Two planes may take away together what neither does alone.
  for (const auto& f : kFaceVertices) {
    if (remains(to_polygon({c[f[0]], c[f[1]], c[f[2]]}), exact_.size())) return false;
  }
  for (std::size_t i = 0; i < exact_.size(); ++i) {
    if (remains(cross_section(c, exact_[i]), i)) return false;
  }
  return true;
}

bool TetTriangles::remains(Polygon polygon, std::size_t skipped_plane) const {
  for (std::size_t i = 0; i < exact_.size() && polygon.size > 0; ++i) {
    if (i != skipped_plane) polygon = clip(polygon, exact_[i], false);
  }
  return polygon.size > 0;
}

/// Only colours by distance tell faces of a tet apart.
Colour TetTriangles::colour_of(HalfFace face, const Colour& of_tet) const {
  if (in_.reference == nullptr || settings_.colour != kDistance) return of_tet;
  if (!is_surface_face(mesh_, face)) return of_tet;
  const double distance = in_.reference->of(mesh_, face).distance;
  if (distance == 0) return kUnchangedColour;
  return map_.at(1 - (distance - in_.colour_range.low) /
                         (in_.colour_range.high - in_.colour_range.low));
}

Colour TetTriangles::colour_of(TetHandle t) const {
  if (settings_.colour == kDistance) return kInsideColour;
  if (in_.colour_values.empty()) return is_bad(t) ? kBadColour : region_colour(mesh_.label(t));
  const auto value = static_cast<double>(in_.colour_values[t.index()]);
  return map_.at((value - in_.colour_range.low) / (in_.colour_range.high - in_.colour_range.low));
}

std::array<glm::dvec3, 4> TetTriangles::shrunk(TetHandle t) const {
  auto c = corners(mesh_, t);
  if (settings_.shrink == 0) return c;
  const glm::dvec3 centre = (c[0] + c[1] + c[2] + c[3]) / 4.0;
  for (glm::dvec3& p : c) p += settings_.shrink * (centre - p);
  return c;
}

/// A tet that is seen, or has a neighbour that is seen: what shows between shrunk tets.
bool TetTriangles::is_near_the_eye(TetHandle t) const {
  const auto touches_outside = [&](TetHandle tet) {
    for (unsigned f = 0; f < 4; ++f) {
      if (is_exposed(HalfFace(tet, f))) return true;
    }
    return false;
  };
  if (touches_outside(t)) return true;
  for (const HalfFace n : mesh_.neighbours(t)) {
    if (!n.is_outside() && touches_outside(n.tet())) return true;
  }
  return false;
}

void TetTriangles::add_cut(Polygon polygon, const glm::dvec3& normal, const Colour& colour,
                           std::size_t skipped_plane, std::vector<SurfaceVertex>& out) const {
  for (std::size_t i = 0; i < exact_.size() && polygon.size > 0; ++i) {
    if (i != skipped_plane) polygon = clip(polygon, exact_[i], true);
  }
  if (polygon.size > 0) add_polygon(out, polygon, normal, colour, in_.ball.centre);
}

void TetTriangles::add_faces(TetHandle t, const Colour& colour,
                             std::vector<SurfaceVertex>& out) const {
  if (!is_shrunk()) {
    for (unsigned f = 0; f < 4; ++f) {
      if (!is_exposed(HalfFace(t, f))) continue;
      const auto c = corners(mesh_, HalfFace(t, f));
      add_cut(to_polygon(c), normal_of(c), colour_of(HalfFace(t, f), colour), exact_.size(), out);
    }
    return;
  }
  if (!shrinks_all_ && !is_near_the_eye(t)) return;
  const auto c = shrunk(t);
  for (unsigned f = 0; f < 4; ++f) {
    const auto& face = kFaceVertices[f];
    const std::array<glm::dvec3, 3> corner = {c[face[0]], c[face[1]], c[face[2]]};
    add_cut(to_polygon(corner), normal_of(corner), colour_of(HalfFace(t, f), colour), exact_.size(),
            out);
  }
}

void TetTriangles::add_surface(TetHandle t, std::vector<SurfaceVertex>& out) const {
  const Colour colour = colour_of(t);
  add_faces(t, colour, out);
  for (std::size_t i = 0; i < exact_.size(); ++i) {
    const Polygon section = cross_section(shrunk(t), exact_[i]);
    if (section.size > 0) add_cut(section, exact_[i].normal, colour, i, out);
  }
}

/// The worse a tet, the stronger its red.
std::uint8_t TetTriangles::alpha_of(Quality quality) const {
  constexpr double kLeast = 60;
  constexpr double kMost = 215;
  const double lack =
      1 - std::max(0.0, static_cast<double>(quality)) / std::max(settings_.bad_below, 1e-9);
  return static_cast<std::uint8_t>(kLeast + (kMost - kLeast) * std::clamp(lack, 0.0, 1.0));
}

void TetTriangles::add_through(TetHandle t, std::vector<SurfaceVertex>& out) const {
  Colour colour = kBadColour;
  colour.alpha = alpha_of(mesh_.quality(t));
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace twin = mesh_.twin(HalfFace(t, f));
    if (!twin.is_outside() && taken_[twin.tet().index()] != 0) continue;  // inside the red
    const auto c = corners(mesh_, HalfFace(t, f));
    if (settings_.bad_beyond_cuts) {
      add_triangle(out, c, colour, in_.ball.centre);
    } else {  // no splinters out of an exact cut
      add_cut(to_polygon(c), normal_of(c), colour, exact_.size(), out);
    }
  }
}

void TetTriangles::add_ghosts(TetHandle t, std::vector<SurfaceVertex>& out) const {
  if (mesh_.is_deleted(t) || (is_shown(t) && exact_.empty())) return;
  for (unsigned f = 0; f < 4; ++f) {
    if (!mesh_.is_boundary(HalfFace(t, f))) continue;
    Colour colour = region_colour(mesh_.label(t));
    colour.alpha = static_cast<std::uint8_t>(std::lround(255 * settings_.ghosts));
    add_triangle(out, corners(mesh_, HalfFace(t, f)), colour, in_.ball.centre);
  }
}

void add_polygon(std::vector<SurfaceVertex>& out, const Polygon& polygon, const glm::dvec3& normal,
                 const Colour& colour, const glm::dvec3& origin) {
  std::array<std::int8_t, 3> n{};
  for (int i = 0; i < 3; ++i) {
    n[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(std::lround(127 * normal[i]));
  }
  for (unsigned i = 1; i + 1 < polygon.size; ++i) {
    // Corners 0, i, i + 1: opposite them lie side i, the side back to 0, and the side from 0.
    const unsigned edges = (polygon.drawn[i] ? 1U : 0U) |
                           (i + 2 == polygon.size && polygon.drawn[i + 1] ? 2U : 0U) |
                           (i == 1 && polygon.drawn[0] ? 4U : 0U);
    for (const unsigned corner : {0U, i, i + 1}) {
      out.push_back({glm::vec3(polygon.corners[corner] - origin), colour, n,
                     static_cast<std::uint8_t>(edges)});
    }
  }
}

void add_triangle(std::vector<SurfaceVertex>& out, const std::array<glm::dvec3, 3>& corners,
                  const Colour& colour, const glm::dvec3& origin) {
  add_polygon(out, to_polygon(corners), normal_of(corners), colour, origin);
}

std::array<glm::dvec3, 3> corners(const TetMesh& mesh, HalfFace face) {
  const auto v = mesh.vertices(face);
  return {to_glm(mesh.point(v[0])), to_glm(mesh.point(v[1])), to_glm(mesh.point(v[2]))};
}

std::array<glm::dvec3, 4> corners(const TetMesh& mesh, TetHandle tet) {
  const auto& v = mesh.vertices(tet);
  return {to_glm(mesh.point(v[0])), to_glm(mesh.point(v[1])), to_glm(mesh.point(v[2])),
          to_glm(mesh.point(v[3]))};
}

}  // namespace tetmend::viewer
