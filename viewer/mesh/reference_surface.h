// SPDX-License-Identifier: MIT
// Another surface that the one of the mesh is compared with: how far is each triangle from it?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "envelope/element.h"
#include "envelope/triangle_set.h"
#include "kernel/tet_mesh.h"

namespace tetmend::viewer {

/// How far the surface was allowed to move, as `improve --surface` says it. At most one is not 0.
struct Allowance {
  double share = 0;   ///< of the mean edge length of each triangle of the reference
  double length = 0;  ///< as files have lengths
  bool is_known() const { return share > 0 || length > 0; }
  /// "1%" or "0.01"; "flat" and "fixed" leave nothing to compare with.
  /// @throws Error for any other text.
  static Allowance parse(std::string_view text);
};

/// How far a triangle, or a whole surface, lies from the reference.
struct Departure {
  double distance = 0;  ///< as files have lengths
  double share = 0;     ///< in parts of the tolerance; 0 if that is not known
};

/// The same for a whole mesh.
struct SurfaceDeparture {
  Departure most;                 ///< distance and share need not come from the same place
  std::size_t triangles = 0;      ///< of the surface
  std::size_t others = 0;         ///< that the reference has not, corner for corner
  std::optional<Departure> back;  ///< likewise, of the reference from the surface; if asked for
};

/// The surface of a mesh: its boundary, and its faces between two labels. Remembers answers, so only
/// one thread at a time may ask.
class ReferenceSurface {
 public:
  using Corners = TriangleSet::Corners;

  /// Cost: a pass over the tets. The tree is built when it is asked for.
  ReferenceSurface(const TetMesh& mesh, const Allowance& allowance, std::string name);

  const std::string& name() const { return name_; }
  const Allowance& allowance() const { return allowance_; }
  /// Turned as in their mesh, in the lengths that `scale` makes of those of files.
  std::vector<Corners> triangles(const Scale& scale) const;

  /// The farthest of 15 samples of a face, each to the nearest place of the reference, wherever that
  /// is. The share is that of the triangle in whose tolerance the sample fits best. Where the
  /// reference sticks out no such sample tells: if the last measure() was of both ways, a sample of
  /// the reference whose nearest place is on this face counts, too. Cost: some microseconds; less
  /// when the face was asked for before.
  Departure of(const TetMesh& mesh, HalfFace face);
  /// All faces of the surface; on all threads. Both ways: also 15 samples of each triangle of the
  /// reference, to the nearest place of the surface, in parts of the tolerance of that triangle.
  /// Those of triangles that the mesh has, corner for corner, are left out.
  SurfaceDeparture measure(const TetMesh& mesh, bool both_ways = false);
  /// Of all faces that were asked for since forget().
  Departure largest_seen() const;
  void forget();

 private:
  struct Hash {
    std::size_t operator()(const Corners& corners) const;
  };

  using Departures = std::unordered_map<Corners, Departure, Hash>;

  Departure of_point(const Point& p) const;
  Departure of_triangle(const Corners& corners) const;
  Departure measure_back(const TetMesh& mesh);
  Corners corners_of(const TetMesh& mesh, HalfFace face) const;
  const Departure& keep(const Corners& corners, const Departure& departure);
  void build();

  std::string name_;
  Allowance allowance_;
  Scale scale_;  // of its own mesh; all that follows is in the lengths it was worked with
  TriangleSet set_;
  std::vector<Element> elements_;  // empty until someone asks
  ElementTree tree_;
  Departures known_;
  Departure largest_;
  bool both_ways_ = false;
  Departures back_;  // of the reference, by the face of the mesh that is nearest to a sample
  Departure largest_back_;
};

/// Calls visit(face) for each face of the boundary and, once, between two labels, from the side of
/// the tet with the lower slot. Cost: linear.
template <class Visit>
void for_each_surface_face(const TetMesh& mesh, Visit visit) {
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh.twin(HalfFace(t, f));
      const bool is_wall = !twin.is_outside() && twin.tet().index() > slot &&
                           mesh.label(twin.tet()) != mesh.label(t);
      if (twin.is_outside() || is_wall) visit(HalfFace(t, f));
    }
  }
}

/// It belongs to the boundary or lies between two labels.
bool is_surface_face(const TetMesh& mesh, HalfFace face);

}  // namespace tetmend::viewer
