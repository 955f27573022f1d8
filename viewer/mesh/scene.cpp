// SPDX-License-Identifier: MIT
#include "viewer/mesh/scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/mesh/tet_values.h"

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

/// Makes a scene step by step; see build_scene().
class Builder {
 public:
  explicit Builder(const SceneInput& input)
      : in_(input),
        mesh_(input.mesh),
        settings_(input.settings),
        angles_(input.mesh.standard().of_angles()),
        map_(find_colour_map(input.settings.map)),
        exact_(planes_of(input.settings, input.ball, true)) {
    scene_.origin = input.ball.centre;
  }

  Scene build() {
    shown_ = chosen_tets(mesh_, settings_, in_.figures);
    for (std::size_t i = 0; i < in_.only.size(); ++i) shown_[i] &= in_.only[i];
    if (settings_.bad) list_bad();
    hide_cut_and_peeled(mesh_, settings_, in_.figures, in_.ball, shown_);
    for (const std::uint8_t s : shown_) scene_.tets_shown += s;
    if (settings_.shrink > 0) {
      add_shrunk();
    } else {
      add_visible_faces();
    }
    add_sections();
    add_bad();
    if (settings_.constraints) add_constraints();
    if (settings_.ghosts > 0) add_ghosts();
    return std::move(scene_);
  }

 private:
  bool is_shown(TetHandle t) const { return shown_[t.index()] != 0; }
  bool is_exposed(HalfFace face) const {
    const HalfFace twin = mesh_.twin(face);
    return twin.is_outside() || !is_shown(twin.tet());
  }
  /// A needle whose angles are good is not.
  bool is_bad(TetHandle t) const {
    if (!settings_.bad || static_cast<double>(mesh_.quality(t)) >= settings_.bad_below) {
      return false;
    }
    const TetVertices& v = mesh_.vertices(t);
    const double of_angles =
        angles_.quality(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
    return static_cast<double>(static_cast<Quality>(of_angles)) < settings_.bad_below;
  }

  Colour colour_of(TetHandle t) const {
    if (in_.colour_values.empty()) return is_bad(t) ? kBadColour : region_colour(mesh_.label(t));
    const auto value = static_cast<double>(in_.colour_values[t.index()]);
    return map_.at((value - in_.colour_range.low) / (in_.colour_range.high - in_.colour_range.low));
  }

  template <class Visit>
  void for_each_shown(Visit visit) const {
    for (std::uint32_t i = 0; i < shown_.size(); ++i) {
      if (shown_[i] != 0) visit(TetHandle(i));
    }
  }

  std::array<glm::dvec3, 4> shrunk(TetHandle t) const {
    auto c = corners(mesh_, t);
    if (settings_.shrink == 0) return c;
    const glm::dvec3 centre = (c[0] + c[1] + c[2] + c[3]) / 4.0;
    for (glm::dvec3& p : c) p += settings_.shrink * (centre - p);
    return c;
  }

  void add_surface(Polygon polygon, const glm::dvec3& normal, TetHandle t,
                   std::size_t skipped_plane) {
    for (std::size_t i = 0; i < exact_.size() && polygon.size > 0; ++i) {
      if (i != skipped_plane) polygon = clip(polygon, exact_[i], true);
    }
    if (polygon.size == 0) return;
    add_polygon(scene_.surface, polygon, normal, colour_of(t), scene_.origin);
    scene_.surface_tets.resize(scene_.surface.size() / 3, t);
  }

  void add_visible_faces() {
    for_each_shown([&](TetHandle t) {
      for (unsigned f = 0; f < 4; ++f) {
        if (!is_exposed(HalfFace(t, f))) continue;
        const auto c = corners(mesh_, HalfFace(t, f));
        add_surface(to_polygon(c), normal_of(c), t, exact_.size());
      }
    });
  }

  /// A tet that is seen, or has a neighbour that is seen: what shows between shrunk tets.
  bool is_near_the_eye(TetHandle t) const {
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

  void add_shrunk() {
    const bool all = scene_.tets_shown <= kMostShrunkTets || !exact_.empty();
    for_each_shown([&](TetHandle t) {
      if (!all && !is_near_the_eye(t)) return;
      const auto c = shrunk(t);
      for (const auto& face : kFaceVertices) {
        const std::array<glm::dvec3, 3> corner = {c[face[0]], c[face[1]], c[face[2]]};
        add_surface(to_polygon(corner), normal_of(corner), t, exact_.size());
      }
    });
    if (!all) note("many tets: only the outer two layers are drawn shrunk");
  }

  void add_sections() {
    for (std::size_t i = 0; i < exact_.size(); ++i) {
      for_each_shown([&](TetHandle t) {
        const Polygon section = cross_section(shrunk(t), exact_[i]);
        if (section.size > 0) add_surface(section, exact_[i].normal, t, i);
      });
    }
  }

  void note(const std::string& text) { scene_.note += (scene_.note.empty() ? "" : "; ") + text; }

  /// Before anything is cut or peeled away: bad tets are seen all the same.
  void list_bad() {
    std::vector<float> quality(shown_.size(), std::nanf(""));
    std::size_t count = 0;
    for_each_shown([&](TetHandle t) {
      if (!is_bad(t)) return;
      quality[t.index()] = mesh_.quality(t);
      ++count;
    });
    bad_ = worst_tets(quality, kMostBadTets);
    scene_.bad_shown = bad_.size();
    if (count > bad_.size()) {
      note(fmt::format("{} bad tets: the worst {} are seen through the rest", count, bad_.size()));
    }
  }

  void add_bad() {
    std::vector<std::uint8_t> taken(shown_.size());
    for (const TetHandle t : bad_) taken[t.index()] = 1;
    for (const TetHandle t : bad_) {
      Colour colour = kBadColour;
      colour.alpha = alpha_of(mesh_.quality(t));
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace twin = mesh_.twin(HalfFace(t, f));
        if (!twin.is_outside() && taken[twin.tet().index()] != 0) continue;  // inside the red
        add_triangle(scene_.through, corners(mesh_, HalfFace(t, f)), colour, scene_.origin);
      }
    }
  }

  /// The worse a tet, the stronger its red.
  std::uint8_t alpha_of(Quality quality) const {
    constexpr double kLeast = 60;
    constexpr double kMost = 215;
    const double lack =
        1 - std::max(0.0, static_cast<double>(quality)) / std::max(settings_.bad_below, 1e-9);
    return static_cast<std::uint8_t>(kLeast + (kMost - kLeast) * std::clamp(lack, 0.0, 1.0));
  }

  void add_constraints() {
    for (const SurfaceTriangle& triangle : mesh_.surface_triangles()) {
      if (!triangle.interior) continue;
      std::array<glm::dvec3, 3> c;
      for (unsigned i = 0; i < 3; ++i) c[i] = to_glm(mesh_.point(triangle.vertices[i]));
      add_triangle(scene_.through, c, kConstraintColour, scene_.origin);
      std::swap(c[1], c[2]);  // seen from both sides
      add_triangle(scene_.through, c, kConstraintColour, scene_.origin);
    }
  }

  void add_ghosts() {
    const auto alpha = static_cast<std::uint8_t>(std::lround(255 * settings_.ghosts));
    for (std::uint32_t i = 0; i < shown_.size(); ++i) {
      const TetHandle t(i);
      if (mesh_.is_deleted(t) || (is_shown(t) && exact_.empty())) continue;
      for (unsigned f = 0; f < 4; ++f) {
        if (!mesh_.is_boundary(HalfFace(t, f))) continue;
        Colour colour = region_colour(mesh_.label(t));
        colour.alpha = alpha;
        add_triangle(scene_.ghosts, corners(mesh_, HalfFace(t, f)), colour, scene_.origin);
      }
    }
  }

  const SceneInput& in_;
  const TetMesh& mesh_;
  const SceneSettings& settings_;
  const Standard angles_;
  const ColourMap& map_;
  std::vector<Plane> exact_;
  std::vector<std::uint8_t> shown_;
  std::vector<TetHandle> bad_;  // what is seen through the rest
  Scene scene_;
};

}  // namespace

Scene build_scene(const SceneInput& input) {
  return Builder(input).build();
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
