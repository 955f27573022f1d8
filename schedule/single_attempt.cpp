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

bool are_same(std::span<const VertexHandle> some, std::span<const VertexHandle> others) {
  return std::is_permutation(some.begin(), some.end(), others.begin(), others.end());
}

/// In the tet of vertices `from`, or in any if there are none.
std::optional<Target> find_target(const TetMesh& mesh, TargetKind kind,
                                  std::span<const VertexHandle> wanted,
                                  std::span<const VertexHandle> from) {
  std::optional<Target> found;
  bool in_order = false;
  for (std::uint32_t i = 0; i < mesh.tet_slots() && !in_order; ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !(from.empty() || are_same(mesh.vertices(t), from))) continue;
    visit_targets(mesh, t, kind, [&](Target target, std::span<const VertexHandle> vertices) {
      if (in_order || !are_same(vertices, wanted)) return;
      in_order = std::equal(vertices.begin(), vertices.end(), wanted.begin());
      if (in_order || !found) found = target;
    });
  }
  return found;
}

/// @throws Error when there is no such vertex
std::vector<VertexHandle> to_handles(const MeshView& view, std::span<const std::uint32_t> numbers) {
  std::vector<VertexHandle> vertices;
  for (const std::uint32_t number : numbers) {
    if (number >= view.point_count()) {
      throw Error(fmt::format("attempt: there is no vertex {}; the mesh has {}, counted from 0",
                              number, view.point_count()));
    }
    vertices.emplace_back(view.vertex_slots().empty() ? number : view.vertex_slots()[number]);
  }
  return vertices;
}

}  // namespace

void attempt_once(Run& run, const SingleAttempt& options) {
  PassScope scope(run, "attempt");
  const auto op = run.registry().make(options.operator_name, options.settings);
  const MeshView view(run.mesh());
  const TargetKind kind = op->info().target;
  const auto target = find_target(run.mesh(), kind, to_handles(view, options.vertices),
                                  to_handles(view, options.tet));
  if (!target) {
    throw Error(fmt::format("attempt: {}: no {} has the vertices {}{}{}", options.operator_name,
                            to_string(kind), fmt::join(options.vertices, ", "),
                            options.tet.empty() ? "" : " in a tet of ",
                            fmt::join(options.tet, ", ")));
  }
  scope.expect(1);
  run.worker().attempt(*op, *target);
  scope.take_verdicts(run.worker());
  run.note_added_vertices(run.worker());
}

}  // namespace tetmend
