// SPDX-License-Identifier: MIT
// A bad tet goes by experience, and there are three kinds: one that has a vertex which would move
// in its plane or on its line; the same with all vertices on the surface, as in a thin wall; and one
// that has only a face of the surface, which can be split. The shares are those of 18 meshes, CAD
// and scans, run with the fixed surface and with the flat one.
#include "face/flat_offer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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

template <class Counted, class Count>
std::vector<Counted> count_bad(const TetMesh& mesh, const Count& count) {
  return map_chunks<Counted>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
    Counted counted{};
    mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
      if (!mesh.is_frozen(t)) count(t, counted);
    });
    return counted;
  });
}

/// What of bad tets goes, by kind.
constexpr double kBesideMovable = 0.9;
constexpr double kInWall = 0.5;
constexpr double kAtFace = 0.7;

/// No more than that can go: of a tet inside nothing does.
double most_freed(const TetMesh& mesh) {
  const auto counts = count_bad<std::size_t>(mesh, [&](TetHandle t, std::size_t& counted) {
    const TetVertices& v = mesh.vertices(t);
    const auto is_fixed = [&](VertexHandle w) { return mesh.is_fixed(w); };
    counted += std::any_of(v.begin(), v.end(), is_fixed) ? 1 : 0;
  });
  return kBesideMovable *
         static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
}

}  // namespace

std::size_t estimate_freed_by_flat(const TetMesh& mesh, const MeshData& input, std::size_t bad,
                                   std::size_t least) {
  if (!input.mid_nodes.empty() || bad == 0) return 0;
  if (most_freed(mesh) + 0.5 < static_cast<double>(least)) return 0;
  const std::vector<SurfacePlace> places = places_on_flat(mesh, input);
  const FlatSurface surface(mesh, places);
  FreedTets freed;
  for (const FreedTets& part : count_bad<FreedTets>(
           mesh, [&](TetHandle t, FreedTets&counted) { surface.add(t, counted); })) {
    freed.beside_movable += part.beside_movable;
    freed.in_wall += part.in_wall;
    freed.at_face += part.at_face;
  }
  // Bad tets side by side leave each other no room, least of all for splits.
  const double room = 1 - static_cast<double>(bad) / static_cast<double>(mesh.tet_count());
  const double sum = kBesideMovable * static_cast<double>(freed.beside_movable) +
                     kInWall * room * static_cast<double>(freed.in_wall) +
                     kAtFace * room * room * room * static_cast<double>(freed.at_face);
  return std::min(bad, static_cast<std::size_t>(std::lround(sum)));
}

}  // namespace tetmend::face
