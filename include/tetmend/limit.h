// SPDX-License-Identifier: MIT
// What the surface of a mesh allows at best, and why each bad tet is still there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <tetmend/error.h>

namespace tetmend {

/// Why a bad tet is still there: the first of these that holds.
enum class Hindrance : std::uint8_t {
  frozen,      ///< it must stay as it is
  surface,     ///< the boundary forces a bad tet at this place
  constraint,  ///< constrained faces or frozen tets do, or a constraint fixes one of its vertices
  no_free_vertex,  ///< its vertices all lie on the boundary; whether that must be so is not known
  search           ///< nothing known: the search ended without success
};
/// The number of values of Hindrance.
inline constexpr std::size_t kHindranceCount = 5;

/// With underscores, as in JSON.
TETMEND_API std::string_view to_string(Hindrance hindrance);

/// Bounds that hold for every mesh with the same walls, whatever vertices are inside. Walls are the
/// boundary, the constrained faces and what is frozen.
struct SurfaceLimit {
  std::size_t n_forced = 0;  ///< no mesh has fewer bad tets besides frozen ones
  std::size_t n_bad = 0;     ///< bad tets of this mesh that are not frozen
  // In steps of 0.001 degrees; nothing where no sharp edge bounds them.
  std::optional<double> q_worst;                   ///< no mesh is better
  std::optional<double> theta_min;                 ///< degrees; none has a larger one
  std::optional<double> theta_max;                 ///< degrees; none has a smaller one
  std::array<std::size_t, kHindranceCount> bad{};  ///< of this mesh, by Hindrance

  /// Bad tets of this mesh that are still there for that reason.
  std::size_t bad_by(Hindrance hindrance) const { return bad[static_cast<std::size_t>(hindrance)]; }
};

}  // namespace tetmend
