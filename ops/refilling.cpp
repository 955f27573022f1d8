// SPDX-License-Identifier: MIT
#include "ops/refilling.h"

#include <algorithm>

namespace tetmend {

Verdict refill(OperatorContext& context, PointMask kept, const RefillLimits& limits) {
  const TetMesh& mesh = context.mesh;
  Scratch& scratch = context.scratch;
  const Polyhedron& polyhedron = scratch.polyhedron;
  PolyhedronSearch& search = scratch.polyhedron_search;
  Quality worst = mesh.quality(polyhedron.tets()[0]);
  double lack = 0;
  for (const TetHandle t : polyhedron.tets()) {
    worst = std::min(worst, mesh.quality(t));
    lack += deficit(mesh.quality(t));
  }
  PolyhedronProblem problem;
  problem.surface = polyhedron.surface();
  problem.kept = kept;
  problem.floor = std::max(worst, 0.0f) + kQualityTolerance;
  if (worst >= limits.desperate) problem.deficit_limit = lack;
  problem.max_nodes = limits.max_nodes;
  if (!search.run(problem)) {
    return search.was_cut_short() ? Verdict::budget_spent : Verdict::no_improvement;
  }

  scratch.old_tets.assign(polyhedron.tets().begin(), polyhedron.tets().end());
  scratch.new_tets.clear();
  const auto v = polyhedron.vertices();
  for (const auto& [a, b, c, d] : search.tets()) {
    scratch.new_tets.push_back({v[a], v[b], v[c], v[d]});
  }
  return Verdict::accepted;
}

}  // namespace tetmend
