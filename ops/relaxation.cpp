// SPDX-License-Identifier: MIT
#include "ops/relaxation.h"

#include <algorithm>

#include "kernel/star.h"
#include "ops/shell_search.h"
#include "ops/smoothing.h"

namespace tetmend {

namespace {

/// Shell transformations on the edges of the bad tets around v.
void reconnect(OperatorContext& context, VertexHandle v) {
  const TetMesh& mesh = context.mesh;
  Scratch& scratch = context.scratch;
  if (!collect_link(mesh, v, context.workspace, scratch.link)) return;
  for (const HalfFace opposite : scratch.link) {
    const TetHandle t = opposite.tet();
    for (unsigned e = 0; e < 6; ++e) {
      // An earlier transformation may have taken the slot.
      if (mesh.is_deleted(t) || mesh.quality(t) >= kBadThreshold) break;
      if (find_searchable_shell(context, TetEdge(t, e), scratch.shell) != Verdict::accepted)
        continue;
      if (propose_covering(context, scratch.shell, {}, true) != Verdict::accepted) continue;
      Transaction step(context.mesh, context.workspace);
      if (step.replace_cavity(scratch.old_tets, scratch.new_tets) == EditResult::made &&
          is_better(step, scratch)) {
        step.keep();
      }
    }
  }
}

}  // namespace

void climb(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits) {
  const TetMesh& mesh = context.mesh;
  if (mesh.is_fixed(v)) return;
  Scratch& scratch = context.scratch;
  if (!collect_link(mesh, v, context.workspace, scratch.link)) return;
  load_ball(mesh, scratch.link, scratch.ball);
  Point point = mesh.point(v);
  const double start = scratch.ball.worst(point);
  if (start >= limits.enough || scratch.ball.optimise(point, limits) <= start) return;
  transaction.move_vertex(v, point, scratch.link);
}

void relax(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits) {
  const TetMesh& mesh = context.mesh;
  Scratch& scratch = context.scratch;
  for (int round = 0; round < 2; ++round) {
    const auto ring = one_ring(mesh, v, context.workspace);
    scratch.neighbours.assign(ring.begin(), ring.end());
    scratch.neighbours.push_back(v);
    for (const VertexHandle w : scratch.neighbours) climb(context, transaction, w, limits);
    if (round > 0) break;
    reconnect(context, v);
    // The second round of smoothing is as dear as the first; it cannot make up for this much.
    constexpr Quality kHopeless = 0.5f;
    transaction.compare(scratch.before, scratch.now);
    if (scratch.now[0] < kHopeless * std::max(scratch.before[0], 0.0f)) break;
  }
}

}  // namespace tetmend
