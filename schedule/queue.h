// SPDX-License-Identifier: MIT
// The items of a sweep: selected tets, or the movable vertices of selected tets, around which
// something changed since a pass last looked at them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "schedule/run.h"
#include "schedule/selection.h"

namespace tetmend {

/// A tet as it was when it was queued, worst first. Slots are re-used, so the vertices tell whether
/// it is still there.
struct QueuedTet {
  Quality quality = 0;
  TetHandle tet;
  TetVertices vertices;
  std::uint64_t todo = ~std::uint64_t{0};  ///< one bit for each attempt that is still to be made

  std::span<const VertexHandle> corners() const { return vertices; }
  bool is_there(const TetMesh& mesh) const { return mesh.vertices(tet) == vertices; }
  friend bool operator<(const QueuedTet& x, const QueuedTet& y) {
    return x.quality != y.quality ? x.quality < y.quality : x.tet < y.tet;
  }
};

/// A vertex, in slot order.
struct QueuedVertex {
  VertexHandle vertex;

  std::span<const VertexHandle> corners() const { return {&vertex, 1}; }
  bool is_there(const TetMesh& mesh) const { return !mesh.is_deleted(vertex); }
  friend bool operator<(QueuedVertex x, QueuedVertex y) { return x.vertex < y.vertex; }
  friend bool operator==(QueuedVertex x, QueuedVertex y) { return x.vertex == y.vertex; }
};

/// The selected tets of which a vertex's star changed at `since` or later. A number of worst tets
/// is taken among these.
/// @throws Error for a property that does not exist.
std::vector<QueuedTet> queue_tets(PassScope& scope, const TetMesh& mesh, const Selection& selection,
                                  Date since);

/// The movable vertices of selected tets whose star changed at `since` or later, in slot order. A
/// number of worst tets is taken among all.
/// @param at_surface also those of a surface that may change
/// @throws Error for a property that does not exist.
std::vector<QueuedVertex> queue_vertices(PassScope& scope, const TetMesh& mesh,
                                         const Selection& selection, Date since,
                                         bool at_surface = false);

/// Sorted, and without repeats. Cost: linear in both, or n log n.
void keep_each_once(PassScope& scope, const TetMesh& mesh, std::vector<QueuedVertex>& vertices);

}  // namespace tetmend
