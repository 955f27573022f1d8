// SPDX-License-Identifier: MIT
// Brings all that a file holds besides its mesh over to the improved mesh.
//
//   what has not changed keeps its values
//   point data: linear in the old tet that holds the new place of a point; integers come from the
//     vertex of that tet with the greatest weight
//   identifiers, whole numbers that are all different: what is left keeps its own, new ones are above
//     the largest
//   data and parts of tets: those of the old tet that holds the centroid; on request the mean of the
//     old tets by the volume that they share with the new one, which keeps the integral
//   groups: a new point is in one that holds all vertices of its old tet
//   triangles, edges and other elements are the same: only the numbers of their vertices change;
//     where the surface may change, a new one is like the nearest old one that was like it
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "face/surface_marks.h"
#include "kernel/mesh_data.h"

namespace tetmend::face {

/// True if `data` holds more than TetMesh knows.
bool holds_more(const MeshData& data);

/// Triangles between tets of one label but two parts, to be named as constraints.
std::vector<MeshData::Triangle> walls_between_parts(const MeshData& data);

/// What carry() did.
struct Carried {
  std::vector<CarriedArray> arrays;  ///< how each came over, and what that did to its integral
  std::vector<std::string> notes;    ///< what files beside the mesh have to know
};

/// Gives `now`, what TetMesh::to_data() made of the improved mesh, all that `before` holds besides.
/// Triangles that `before` does not name go. The maps are those of maps.h.
/// @param conserve arrays of the tets, see check_conserve()
/// @param marks what `now` has for labels where the surface may change; null: it is fixed
Carried carry(const MeshData& before, std::span<const std::uint32_t> vertex_map,
              std::span<const std::uint32_t> tet_map, std::span<const std::string> conserve,
              MeshData& now, const SurfaceMarks* marks = nullptr);

/// Of a component of an array over the mesh.
struct ComponentIntegral {
  double then = 0;
  double size = 0;  ///< that of its absolute value, then
  double now = 0;
};
/// What is told of an array.
CarriedArray carried_array(const DataArray& array, bool is_of_points, bool is_conserved,
                           std::span<const ComponentIntegral> integrals);

/// @throws OptionError unless each name is that of an array of real numbers of the tets
void check_conserve(const MeshData& data, std::span<const std::string> conserve);

}  // namespace tetmend::face
