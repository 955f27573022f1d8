// SPDX-License-Identifier: MIT
#include "ops/refilling.h"

#include <algorithm>

namespace tetmend {

PolyhedronProblem better_filling(const TetMesh& mesh, const Polyhedron& polyhedron,
                                 const Judge& judge) {
  const Quality worst = worst_quality(mesh, polyhedron.tets());
  double lack = 0;
  for (const TetHandle t : polyhedron.tets()) lack += deficit(mesh.quality(t));
  PolyhedronProblem problem;
  problem.surface = polyhedron.surface();
  problem.floor = std::max(static_cast<Quality>(judge.floor(worst)), 0.0f) + kQualityTolerance;
  problem.deficit_limit = judge.deficit_limit(worst, lack);
  return problem;
}

Verdict refill(const PolyhedronProblem& problem, RefillingState& state, VertexHandle added) {
  const Polyhedron& polyhedron = state.polyhedron;
  PolyhedronSearch& search = state.search;
  auto& [old_tets, new_tets] = state.replacement;
  if (!search.run(problem)) {
    return search.was_cut_short() ? Verdict::budget_spent : Verdict::no_improvement;
  }
  const auto vertices = polyhedron.vertices();
  const auto vertex = [&](unsigned n) { return n < vertices.size() ? vertices[n] : added; };
  old_tets.assign(polyhedron.tets().begin(), polyhedron.tets().end());
  new_tets.clear();
  for (const auto& [a, b, c, d] : search.tets()) {
    new_tets.push_back({vertex(a), vertex(b), vertex(c), vertex(d)});
  }
  return Verdict::accepted;
}

}  // namespace tetmend
