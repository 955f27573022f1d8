// SPDX-License-Identifier: MIT
#include "schedule/single_attempt.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/mesh_view.h"
#include "kernel/star.h"

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

struct Place {
  Target target;
  TetVertices tet;  // that it was found in
};

/// The first of the tets looked at that has a target of these vertices, or the first that lists
/// them in this order, where there is one.
class TargetSearch {
 public:
  TargetSearch(const TetMesh& mesh, TargetKind kind, std::span<const VertexHandle> wanted)
      : mesh_(mesh), kind_(kind), wanted_(wanted) {}

  /// False: no other need be looked at.
  bool look_at(TetHandle t) {
    visit_targets(mesh_, t, kind_, [&](Target target, std::span<const VertexHandle> vertices) {
      if (in_order_ || !are_same(vertices, wanted_)) return;
      in_order_ = std::equal(vertices.begin(), vertices.end(), wanted_.begin());
      if (in_order_ || !found_) found_ = {target, mesh_.vertices(t)};
    });
    return !in_order_;
  }
  const std::optional<Place>& found() const { return found_; }

 private:
  const TetMesh& mesh_;
  TargetKind kind_;
  std::span<const VertexHandle> wanted_;
  std::optional<Place> found_;
  bool in_order_ = false;
};

/// In the tet of vertices `from`, or in any if there are none.
std::optional<Place> find_target(const TetMesh& mesh, TargetKind kind,
                                 std::span<const VertexHandle> wanted,
                                 std::span<const VertexHandle> from) {
  TargetSearch search(mesh, kind, wanted);
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !(from.empty() || are_same(mesh.vertices(t), from))) continue;
    if (!search.look_at(t)) break;
  }
  return search.found();
}

/// Among the tets around the first vertex, by slot; in any where parts touch in it alone.
std::optional<Place> find_near(const TetMesh& mesh, TargetKind kind,
                               std::span<const VertexHandle> wanted) {
  if (wanted.empty() || wanted.front().index() >= mesh.vertex_slots() ||
      mesh.is_deleted(wanted.front())) {
    return std::nullopt;
  }
  const Star around = star(mesh, wanted.front());
  std::vector<TetHandle> tets(around.begin(), around.end());
  std::sort(tets.begin(), tets.end());
  TargetSearch search(mesh, kind, wanted);
  for (const TetHandle t : tets) {
    if (!search.look_at(t)) break;
  }
  return search.found() ? search.found() : find_target(mesh, kind, wanted, {});
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

void attempt_there(Run& run, PassScope& scope, const TetAttempts& attempts, const Place& place) {
  scope.expect(1);
  attempts.attempt_once(run.worker(), place.target, place.tet);
  scope.take_verdicts(run.worker());
  run.note_added_vertices(run.worker());
}

}  // namespace

void attempt_once(Run& run, const SingleAttempt& options) {
  make_pass(run, "attempt", [&](PassScope& scope) {
    const TetAttempts attempts(run.registry(), options.what);
    const MeshView view(run.mesh());
    const TargetKind kind = attempts.target_kind();
    const auto place = find_target(run.mesh(), kind, to_handles(view, options.vertices),
                                   to_handles(view, options.tet));
    if (!place) {
      throw Error(fmt::format("attempt: {}: no {} has the vertices {}{}{}", options.what.name(),
                              to_string(kind), fmt::join(options.vertices, ", "),
                              options.tet.empty() ? "" : " in a tet of ",
                              fmt::join(options.tet, ", ")));
    }
    attempt_there(run, scope, attempts, *place);
  });
}

void attempt_at(Run& run, const Composition& what, std::span<const VertexHandle> vertices) {
  make_pass(run, "attempt", [&](PassScope& scope) {
    const TetAttempts attempts(run.registry(), what);
    const TargetKind kind = attempts.target_kind();
    const auto place = find_near(run.mesh(), kind, vertices);
    if (!place) {
      std::vector<std::uint32_t> numbers;
      for (const VertexHandle v : vertices) numbers.push_back(v.index());
      throw Error(fmt::format("attempt: {}: no {} has the vertices {}", what.name(),
                              to_string(kind), fmt::join(numbers, ", ")));
    }
    attempt_there(run, scope, attempts, *place);
  });
}

}  // namespace tetmend
