// SPDX-License-Identifier: MIT
#include "ops/relaxation.h"

#include <algorithm>

#include "kernel/star.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// Shell transformations on the edges of the bad tets around v.
void reconnect(OperatorContext& context, VertexHandle v, RelaxationState& state) {
  const TetMesh& mesh = context.mesh;
  const Judge judge = Judge::strict();
  Shell& shell = state.shell.shell;
  if (find_star(mesh, v, context.workspace, state.ball.link) != StarKind::whole) return;
  for (const HalfFace opposite : state.ball.link) {
    const TetHandle t = opposite.tet();
    for (unsigned e = 0; e < 6; ++e) {
      // An earlier transformation may have taken the slot.
      if (mesh.is_deleted(t) || mesh.quality(t) >= kBadThreshold) break;
      if (find_searchable_shell(context, TetEdge(t, e), shell) != Verdict::accepted) continue;
      const Verdict verdict =
          propose_covering(context, judge, shell, {}, Core::allowed, state.shell);
      if (verdict == Verdict::accepted) take_step(context, judge, state.shell.replacement);
    }
  }
}

}  // namespace

void relax(OperatorContext& context, Transaction& transaction, VertexHandle v,
           const BallOptimiser::Limits& limits, RelaxationState& state, Where where) {
  for (int round = 0; round < 2; ++round) {
    const auto ring = one_ring(context.mesh, v);
    state.neighbours.assign(ring.begin(), ring.end());
    state.neighbours.push_back(v);
    for (const VertexHandle w : state.neighbours) {
      climb(context, transaction, w, limits, state.ball, where);
    }
    if (round > 0) break;
    reconnect(context, v, state);
    // The second round of smoothing is as costly as the first; it cannot make up for this much.
    constexpr Quality kHopeless = 0.5f;
    state.halfway.look_at(transaction);
    if (state.halfway.worst_now() < kHopeless * std::max(state.halfway.worst_before(), 0.0f)) break;
  }
}

}  // namespace tetmend
