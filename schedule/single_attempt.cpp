// SPDX-License-Identifier: MIT
#include "schedule/single_attempt.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/mesh_view.h"

namespace tetmend {

namespace {

/// Calls visit(target, its vertices) for all targets of a kind in a tet.
template <class Visit>
void visit_targets(const TetMesh& mesh, TetHandle t, TargetKind kind, const Visit& visit) {
  if (kind == TargetKind::tet) return visit(Target::of(t), std::span(mesh.vertices(t)));
  for (unsigned i = 0; i < 4 && kind == TargetKind::vertex; ++i) {
    const VertexHandle v = mesh.vertices(t)[i];
    visit(Target::of(v), std::span(&v, 1));
  }
  for (unsigned e = 0; e < 6 && kind == TargetKind::edge; ++e) {
    const auto vertices = mesh.vertices(TetEdge(t, e));
    visit(Target::of(TetEdge(t, e)), std::span<const VertexHandle>(vertices));
  }
  for (unsigned f = 0; f < 4 && kind == TargetKind::face; ++f) {
    const auto vertices = mesh.vertices(HalfFace(t, f));
    visit(Target::of(HalfFace(t, f)), std::span<const VertexHandle>(vertices));
  }
}

std::optional<Target> find_target(const TetMesh& mesh, TargetKind kind,
                                  std::span<const VertexHandle> wanted) {
  std::optional<Target> found;
  bool in_order = false;
  for (std::uint32_t i = 0; i < mesh.tet_slots() && !in_order; ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    visit_targets(
        mesh, TetHandle(i), kind, [&](Target target, std::span<const VertexHandle> vertices) {
          if (in_order || vertices.size() != wanted.size()) return;
          in_order = std::equal(vertices.begin(), vertices.end(), wanted.begin());
          const bool same =
              std::is_permutation(vertices.begin(), vertices.end(), wanted.begin(), wanted.end());
          if (in_order || (same && !found)) found = target;
        });
  }
  return found;
}

}  // namespace

void attempt_once(Run& run, const SingleAttempt& options) {
  PassScope scope(run, "attempt");
  const auto op = run.registry().make(options.operator_name, options.settings);
  const MeshView view(run.mesh());
  std::vector<VertexHandle> vertices;
  for (const std::uint32_t number : options.vertices) {
    if (number >= view.point_count()) {
      throw Error(fmt::format("attempt: there is no vertex {}; the mesh has {}, counted from 0",
                              number, view.point_count()));
    }
    vertices.emplace_back(view.vertex_slots().empty() ? number : view.vertex_slots()[number]);
  }
  const std::optional<Target> target = find_target(run.mesh(), op->info().target, vertices);
  if (!target) {
    throw Error(fmt::format("attempt: {}: no {} has the vertices {}", options.operator_name,
                            to_string(op->info().target), fmt::join(options.vertices, ", ")));
  }
  scope.expect(1);
  run.worker().attempt(*op, *target);
  scope.take_verdicts(run.worker());
  run.note_added_vertices(run.worker());
}

}  // namespace tetmend
