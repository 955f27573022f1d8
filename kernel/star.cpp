// SPDX-License-Identifier: MIT
// Breadth-first walks over the star of a vertex.
#include "kernel/star.h"

#include <limits>

#include "kernel/shell.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// The walk comes to the neighbours soon: memory is asked for their cells at once.
void prefetch_neighbours(const TetMesh& mesh, TetHandle t) {
  for (const HalfFace twin : mesh.neighbours(t)) {
    if (!twin.is_outside()) mesh.prefetch(twin.tet());
  }
}

constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

/// Calls visit(opposite, entered) for each tet of the star until it returns true, or `most` tets are
/// not all: the half-face opposite v, and the one through which the walk came, invalid for the first.
template <class Visit>
StarKind walk_star(const TetMesh& mesh, VertexHandle v, Workspace& workspace, std::size_t most,
                   std::vector<HalfFace>& queue, Visit&& visit) {
  queue.clear();
  const TetHandle first = mesh.tet_of(v);
  if (!first.is_valid()) return StarKind::whole;
  if (!workspace.holds(mesh.vertices(first))) return StarKind::border;
  IndexSet& seen = workspace.star_set;
  seen.clear();
  seen.insert(first.index());
  queue.push_back(HalfFace(first, mesh.local_index(first, v)));
  if (visit(queue.back(), HalfFace())) return StarKind::whole;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const HalfFace opposite = queue[i];
    const auto& neighbours = mesh.neighbours(opposite.tet());
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = neighbours[f];
      if (f == opposite.face() || twin.is_outside() || !seen.insert(twin.tet().index())) continue;
      if (!workspace.holds(mesh.vertices(twin.tet())[twin.face()])) return StarKind::border;
      if (queue.size() == most) return StarKind::too_large;
      queue.push_back(HalfFace(twin.tet(), mesh.local_index(twin.tet(), v)));
      prefetch_neighbours(mesh, twin.tet());
      if (visit(queue.back(), twin)) return StarKind::whole;
    }
  }
  return StarKind::whole;
}

bool visit_nothing(HalfFace, HalfFace) {
  return false;
}

}  // namespace

StarKind find_star(const TetMesh& mesh, VertexHandle v, Workspace& workspace,
                   std::vector<HalfFace>& out) {
  return walk_star(mesh, v, workspace, kMaxStar, out, visit_nothing);
}

bool collect_link(const TetMesh& mesh, VertexHandle v, Workspace& workspace,
                  std::vector<HalfFace>& out) {
  return walk_star(mesh, v, workspace, kAnySize, out, visit_nothing) == StarKind::whole;
}

std::span<const HalfFace> link(const TetMesh& mesh, VertexHandle v, Workspace& workspace) {
  collect_link(mesh, v, workspace, workspace.link_buffer);
  return workspace.link_buffer;
}

std::span<const TetHandle> star(const TetMesh& mesh, VertexHandle v, Workspace& workspace) {
  collect_link(mesh, v, workspace, workspace.link_buffer);
  workspace.star_buffer.clear();
  for (const HalfFace f : workspace.link_buffer) workspace.star_buffer.push_back(f.tet());
  return workspace.star_buffer;
}

std::span<const VertexHandle> one_ring(const TetMesh& mesh, VertexHandle v, Workspace& workspace) {
  constexpr std::uint32_t kIsVertex = 1u << 31;  // beyond the numbers of tets, in the same set
  std::vector<VertexHandle>& ring = workspace.ring_buffer;
  ring.clear();
  const auto add = [&](VertexHandle w) {
    if (workspace.star_set.insert(w.index() | kIsVertex)) ring.push_back(w);
  };
  // A tet shares a face with the one that the walk came from, and adds what lies opposite of it.
  walk_star(mesh, v, workspace, kAnySize, workspace.link_buffer,
            [&](HalfFace opposite, HalfFace entered) {
              if (entered == HalfFace()) {
                for (const VertexHandle w : mesh.vertices(opposite)) add(w);
              } else {
                add(mesh.vertices(entered.tet())[entered.face()]);
              }
              return false;
            });
  return ring;
}

std::optional<TetEdge> find_in_star(const TetMesh& mesh, VertexHandle a, VertexHandle b,
                                    Workspace& workspace) {
  std::optional<TetEdge> found;
  const auto search = [&](VertexHandle v, std::size_t most) {
    return walk_star(mesh, v, workspace, most, workspace.search_buffer,
                     [&](HalfFace opposite, HalfFace) {
                       found = edge_in(mesh, opposite.tet(), a, b);
                       return found.has_value();
                     });
  };
  if (search(a, kMaxStar) != StarKind::too_large) return found;
  if (mesh.is_deleted(b) || !mesh.tet_of(b).is_valid()) return std::nullopt;
  if (search(b, kMaxStar) == StarKind::too_large) search(a, kAnySize);
  return found;
}

}  // namespace tetmend
