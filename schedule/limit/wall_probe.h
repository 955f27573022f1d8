// SPDX-License-Identifier: MIT
// Which dihedral angles the walls allow to the tet on a wall, in any mesh with these walls.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <vector>

#include "schedule/limit/walls.h"
#include "search/apex_search.h"

namespace tetmend {

/// Looks at one wall, from the side of a tet, and at the walls next to it.
///
/// The tet on the wall either ends at the next wall around an edge or leaves a gap there. If it
/// ends there, two of its faces are walls and so its apex is known: the tet is *determined* by
/// the sector. If not, the gap is filled by further tets, the last of which stands on the next
/// wall.
class WallProbe {
 public:
  /// Precondition: is_wall(mesh, wall). Cost: three sectors.
  WallProbe(const TetMesh& mesh, HalfFace wall);

  HalfFace wall() const { return wall_; }
  const Sector& sector(unsigned i) const { return sectors_[i]; }

  /// The tets that an argument is about, besides the tet on the wall itself. Bit i stands for the
  /// tet on the next wall around edge i, kBeyond for those on the next walls around the other edges
  /// of determined tets.
  using Scope = std::bitset<4>;
  static constexpr std::size_t kBeyond = 3;

  /// False only if in every mesh with these walls one of the tets in scope has an angle outside the
  /// range (give or take kAngleSlack). Angles in radians.
  bool allows(AngleRange range, Scope scope) const;

  /// The walls on which the tets of a scope stand.
  std::vector<HalfFace> walls(Scope scope) const;

  /// The determined tet of sector i is possible, as far as the sectors tell, and has an angle
  /// outside the range.
  bool may_share_bad_tet(unsigned i, AngleRange range) const;

 private:
  /// The tet on the wall whose apex is that of sector i. Angles in radians by local edge, vertices
  /// in positive order; not valid where the sector is not convex.
  struct DeterminedTet {
    bool valid = false;
    TetVertices vertices;
    std::array<double, 6> angles{};

    double angle_at(VertexHandle a, VertexHandle b) const;
    bool is_within(AngleRange range) const;
    bool has(VertexHandle v) const {
      return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
    }
  };

  DeterminedTet determined_tet(unsigned i) const;
  /// Between the tet and the next wall around an edge there is nothing, or a gap that is no
  /// smaller.
  bool leaves_gap(const DeterminedTet& tet, HalfFace wall, unsigned edge, const Sector& sector,
                  double least) const;
  /// The same at all edges of its two walls; `least_gap` where the scope has it, 0 elsewhere.
  bool leaves_room(unsigned i, double least_gap, Scope scope) const;

  const TetMesh& mesh_;
  HalfFace wall_;
  std::array<double, 3> corners_{};
  std::array<Sector, 3> sectors_;
  std::array<DeterminedTet, 3> determined_;
};

}  // namespace tetmend
