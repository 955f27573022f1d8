// SPDX-License-Identifier: MIT
#include "ops/refilling.h"

#include <algorithm>

namespace tetmend {

PolyhedronProblem better_filling(const TetMesh& mesh, const Polyhedron& polyhedron,
                                 Quality desperate) {
  Quality worst = mesh.quality(polyhedron.tets()[0]);
  double lack = 0;
  for (const TetHandle t : polyhedron.tets()) {
    worst = std::min(worst, mesh.quality(t));
    lack += deficit(mesh.quality(t));
  }
  PolyhedronProblem problem;
  problem.surface = polyhedron.surface();
  problem.floor = std::max(worst, 0.0f) + kQualityTolerance;
  if (worst >= desperate) problem.deficit_limit = lack;
  return problem;
}

Verdict refill(OperatorContext& context, const PolyhedronProblem& problem, VertexHandle added) {
  Scratch& scratch = context.scratch;
  const Polyhedron& polyhedron = scratch.polyhedron;
  PolyhedronSearch& search = scratch.polyhedron_search;
  if (!search.run(problem)) {
    return search.was_cut_short() ? Verdict::budget_spent : Verdict::no_improvement;
  }
  const auto vertices = polyhedron.vertices();
  const auto vertex = [&](unsigned n) { return n < vertices.size() ? vertices[n] : added; };
  scratch.old_tets.assign(polyhedron.tets().begin(), polyhedron.tets().end());
  scratch.new_tets.clear();
  for (const auto& [a, b, c, d] : search.tets()) {
    scratch.new_tets.push_back({vertex(a), vertex(b), vertex(c), vertex(d)});
  }
  return Verdict::accepted;
}

}  // namespace tetmend
