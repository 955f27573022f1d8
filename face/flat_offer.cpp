// SPDX-License-Identifier: MIT
// A bad tet goes by experience, and there are three kinds: one that has a vertex which would move
// in its plane or on its line; the same with all vertices on the surface, as in a thin wall; and one
// that has only a face of the surface, which can be split. The shares are those of 18 meshes, CAD
// and scans, run with the fixed surface and with the flat one.
#include "face/flat_offer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "envelope/features.h"
#include "envelope/kept_points.h"
#include "kernel/chunks.h"

namespace tetmend::face {

namespace {

struct FreedTets {
  std::size_t beside_movable = 0;  ///< a vertex would move, another lies inside
  std::size_t in_wall = 0;         ///< a vertex would move, all lie on the surface
  std::size_t at_face = 0;         ///< no vertex would move, a face lies on the surface
};

class FlatSurface {
 public:
  FlatSurface(const TetMesh& mesh, const std::vector<SurfacePlace>& places)
      : mesh_(mesh), places_(places) {}

  void add(TetHandle t, FreedTets& freed) const {
    bool moves = false;
    bool all = true;
    for (const VertexHandle v : mesh_.vertices(t)) {
      const SurfacePlace place = places_[v.index()];
      moves = moves || place == SurfacePlace::smooth || place == SurfacePlace::ridge;
      all = all && place != SurfacePlace::inside;
    }
    if (moves) {
      ++(all ? freed.in_wall : freed.beside_movable);
    } else if (can_be_split(t)) {
      ++freed.at_face;
    }
  }

 private:
  /// A face lies on the boundary or between two labels, and none is named inside a region.
  bool can_be_split(TetHandle t) const {
    bool at_surface = false;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const bool is_boundary = mesh_.is_boundary(face);
      if (!is_boundary && !mesh_.is_constrained(face)) continue;
      if (!is_boundary && mesh_.label(mesh_.twin(face).tet()) == mesh_.label(t)) return false;
      at_surface = true;
    }
    return at_surface;
  }

  const TetMesh& mesh_;
  const std::vector<SurfacePlace>& places_;
};

std::vector<SurfacePlace> places_on_flat(const TetMesh& mesh, const MeshData& input) {
  const std::vector<char> kept = find_kept_points(input);
  return find_features(
             mesh,
             {.flat = true, .kept = kept_vertices(mesh, kept), .held = held_vertices(mesh, kept)})
      .places;
}

}  // namespace

std::size_t estimate_freed_by_flat(const TetMesh& mesh, const MeshData& input, std::size_t bad) {
  if (!input.mid_nodes.empty() || bad == 0) return 0;
  const std::vector<SurfacePlace> places = places_on_flat(mesh, input);
  const FlatSurface surface(mesh, places);
  FreedTets freed;
  for (const FreedTets& part :
       map_chunks<FreedTets>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
         FreedTets counted;
         mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
           if (!mesh.is_frozen(t)) surface.add(t, counted);
         });
         return counted;
       })) {
    freed.beside_movable += part.beside_movable;
    freed.in_wall += part.in_wall;
    freed.at_face += part.at_face;
  }
  // Bad tets side by side leave each other no room, least of all for splits.
  const double room = 1 - static_cast<double>(bad) / static_cast<double>(mesh.tet_count());
  constexpr double kBesideMovable = 0.9;
  constexpr double kInWall = 0.5;
  constexpr double kAtFace = 0.7;
  const double sum = kBesideMovable * static_cast<double>(freed.beside_movable) +
                     kInWall * room * static_cast<double>(freed.in_wall) +
                     kAtFace * room * room * room * static_cast<double>(freed.at_face);
  return std::min(bad, static_cast<std::size_t>(std::lround(sum)));
}

}  // namespace tetmend::face
