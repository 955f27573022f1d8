// SPDX-License-Identifier: MIT
// What the walls of a mesh allow at best, and why each bad tet of the mesh is still there.
//
// A wall is a face that must stay. Two facts carry the proofs. Each side of a wall has one tet; its
// apex is a point, and the three dihedral angles at the wall say which (search/apex_search.h). And
// the angles at an edge between two walls add up to the angle between the walls. Either one tet
// fills it alone, and its vertices are known; or several share it, and the one on the next wall has
// at most what the first leaves (wall_probe.h). Only places that cannot mean the same tet are
// counted. A wall that only stands in the way, as the far side of a thin plate does, is not looked
// at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// Why a bad tet is still there: the first of these that holds.
enum class Hindrance : std::uint8_t {
  frozen,      ///< it must stay as it is
  surface,     ///< the boundary forces a bad tet at this place
  constraint,  ///< constrained faces or frozen tets do, or a constraint fixes one of its vertices
  no_free_vertex,  ///< its vertices all lie on the boundary; whether that must be so is not known
  search           ///< nothing known: the search ended without success
};
inline constexpr std::size_t kHindranceCount = 5;

/// With underscores, as in JSON.
std::string_view to_string(Hindrance hindrance);

/// Bounds that hold for every mesh with the same walls, whatever vertices are inside.
struct SurfaceLimit {
  std::size_t n_forced = 0;  ///< no mesh has fewer bad tets besides frozen ones
  std::size_t n_bad = 0;     ///< bad tets of this mesh that are not frozen
  // In steps of 0.001 degrees; nothing where no sharp edge bounds them.
  std::optional<double> q_worst;                   ///< no mesh is better
  std::optional<double> theta_min;                 ///< degrees; none has a larger one
  std::optional<double> theta_max;                 ///< degrees; none has a smaller one
  std::array<std::size_t, kHindranceCount> bad{};  ///< of this mesh, by Hindrance

  std::size_t bad_by(Hindrance hindrance) const { return bad[static_cast<std::size_t>(hindrance)]; }
};

/// Proves that tets are bad in every mesh with the same walls, one wall and its neighbours at a
/// time (see WallProbe). More may be forced than is found. n_forced and the bounds depend on the
/// walls and the order of their vertices, but not on the tets between them or the number of
/// threads. Cost: one pass over the walls and their sectors (0.07 s for 125 thousand), and up to a
/// millisecond for each bad tet on a wall.
SurfaceLimit compute_surface_limit(const TetMesh& mesh);

}  // namespace tetmend
