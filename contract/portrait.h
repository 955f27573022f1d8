// SPDX-License-Identifier: MIT
// What an accepted attempt must keep of a mesh, and what it must make better.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "contract/moving_surface.h"
#include "kernel/tet_mesh.h"

namespace tetmend::contract {

/// All that an operator must keep, and what it must improve. Computed from points and connectivity;
/// no cached value enters. Of a surface that may change, its shape when it was first seen counts, not
/// its faces.
struct Portrait {
  using Face = std::array<VertexHandle, 3>;  // from its smallest vertex on, the sense kept

  std::vector<std::tuple<Face, std::uint32_t, Label>> boundary;  // surface triangle, region
  std::vector<std::tuple<Face, Label>> constrained_faces;        // from each side
  std::set<std::array<VertexHandle, 2>> constrained_edges;
  std::vector<std::tuple<VertexHandle, double, double, double>> fixed;
  std::vector<std::pair<TetHandle, TetVertices>> frozen;
  std::map<Label, long double> volumes;
  long double absolute_volume = 0;
  std::vector<Quality> qualities;             // ascending
  std::set<TetVertices> doubtful;             // tets not certified positive, vertices sorted
  std::size_t not_positive = 0;               // in exact arithmetic
  std::shared_ptr<const SurfaceShape> shape;  // null: the surface is fixed
};

/// Cost: n log n in the number of tets, with exact arithmetic where it is needed.
Portrait portrait(const TetMesh& mesh);
/// Of the same mesh later on, a surface of which is held to the same shape.
Portrait portrait_after(const Portrait& before, const TetMesh& mesh);

/// What the mesh has lost in an accepted attempt, given its portrait before; empty when nothing.
/// Also rebuilds the mesh from plain arrays. Cost: as of a portrait.
std::string complaint_about_loss(const Portrait& before, const TetMesh& mesh);
/// The same, and a quality vector that is not better.
std::string complaint_about(const Portrait& before, const TetMesh& mesh);

}  // namespace tetmend::contract
