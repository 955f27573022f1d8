// SPDX-License-Identifier: MIT
#include "schedule/queue.h"

#include <algorithm>

#include <tbb/parallel_sort.h>

#include "ops/operator.h"
#include "schedule/sweep.h"

namespace tetmend {

namespace {

/// Something near the tet changed at `since` or later.
bool changed_since(const TetMesh& mesh, const TetVertices& vertices, Date since) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](VertexHandle v) { return mesh.changed(v) >= since; });
}

/// Drops all but the worst tets that the selection takes.
void keep_worst(const SelectionTest& test, Quality below, std::vector<QueuedTet>& tets) {
  const auto lower = static_cast<std::size_t>(std::count_if(
      tets.begin(), tets.end(), [&](const QueuedTet& tet) { return tet.quality < below; }));
  const std::size_t count = test.take(tets.size(), lower);
  if (count == tets.size()) return;
  std::nth_element(tets.begin(), tets.begin() + static_cast<std::ptrdiff_t>(count), tets.end());
  tets.resize(count);
}

bool takes_all(const Selection& selection) {
  const Selection all;
  return selection.at_least == 0 && selection.worst == all.worst && selection.share >= 1;
}

}  // namespace

std::vector<QueuedTet> queue_tets(PassScope& scope, const TetMesh& mesh, const Selection& selection,
                                  Date since) {
  const SelectionTest test(mesh, selection, scope.values(), scope.measures());
  const Quality limit = test.limit();
  auto tets =
      collect<QueuedTet>(scope, mesh.tet_slots(),
                         [&](std::size_t begin, std::size_t end, std::vector<QueuedTet>& out) {
                           mesh.visit_below(limit, begin, end, [&](TetHandle t) {
                             if (mesh.is_frozen(t) || !changed_since(mesh, mesh.vertices(t), since))
                               return;
                             if (test.admits(t))
                               out.push_back({mesh.quality(t), t, mesh.vertices(t)});
                           });
                         });
  if (!takes_all(selection)) keep_worst(test, selection.below, tets);
  return tets;
}

std::vector<QueuedVertex> queue_vertices(PassScope& scope, const TetMesh& mesh,
                                         const Selection& selection, Date since, bool at_surface) {
  const auto take = [&](const TetVertices& vertices, std::vector<QueuedVertex>& out) {
    for (const VertexHandle v : vertices) {
      if (is_worth_a_try(at_surface, mesh, v) && mesh.changed(v) >= since) out.push_back({v});
    }
  };
  std::vector<QueuedVertex> all;
  if (takes_all(selection)) {
    const SelectionTest test(mesh, selection, scope.values(), scope.measures());
    all = collect<QueuedVertex>(
        scope, mesh.tet_slots(),
        [&](std::size_t begin, std::size_t end, std::vector<QueuedVertex>& out) {
          mesh.visit_below(selection.below, begin, end, [&](TetHandle t) {
            if (test.admits(t)) take(mesh.vertices(t), out);
          });
        });
  } else {
    for (const QueuedTet& tet : queue_tets(scope, mesh, selection, 0)) take(tet.vertices, all);
  }
  keep_each_once(scope, mesh, all);
  return all;
}

void keep_each_once(PassScope& scope, const TetMesh& mesh, std::vector<QueuedVertex>& vertices) {
  const PassScope::Scan timed(scope);
  // Of most vertices of a mesh, each comes once for each of its tets.
  constexpr std::size_t kFew = 8;
  if (vertices.size() < mesh.vertex_slots() / kFew) {
    tbb::parallel_sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return;
  }
  std::vector<bool> is_in(mesh.vertex_slots());
  for (const QueuedVertex entry : vertices) is_in[entry.vertex.index()] = true;
  vertices.clear();
  for (std::uint32_t i = 0; i < is_in.size(); ++i) {
    if (is_in[i]) vertices.push_back({VertexHandle(i)});
  }
}

}  // namespace tetmend
