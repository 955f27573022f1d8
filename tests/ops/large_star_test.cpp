// SPDX-License-Identifier: MIT
// Attempts around a vertex of thousands of tets: they end at once, and the vertex stays.
#include <doctest/doctest.h>

#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/vertex_ball.h"
#include "tests/support/hub.h"
#include "tests/support/lone_worker.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr std::uint32_t kRing = 2500;  // a star of 5000 tets
constexpr VertexHandle kHub{0};

}  // namespace

TEST_CASE("operators that need the whole star refuse a vertex of 5,000 tets") {
  LoneWorker worker(hub(kRing));
  for (const char* name : {"smoothing", "mean_smoothing", "edge_contraction", "vertex_removal"}) {
    CAPTURE(name);
    CHECK(worker.attempt(name, Target::of(kHub)) == Verdict::not_applicable);
  }
  const TetHandle t = worker.mesh.tet_of(kHub);
  CHECK(worker.attempt("joint_smoothing", Target::of(t)) == Verdict::not_applicable);
}

TEST_CASE("the same operators look at a vertex of 1,000 tets") {
  LoneWorker worker(hub(kMaxStar / 2));
  CHECK(worker.attempt("smoothing", Target::of(kHub)) == Verdict::accepted);
  CHECK(worker.attempt("edge_contraction", Target::of(kHub)) != Verdict::not_applicable);
}

TEST_CASE("relaxing around a new vertex walks no further around a neighbour of 5,000 tets") {
  LoneWorker worker(hub(kRing));
  OperatorContext context{worker.mesh, worker.workspace, worker.states};
  Transaction transaction(worker.mesh, worker.workspace);
  BallState state;
  climb(context, transaction, kHub, {}, state);
  CHECK(transaction.empty());
  CHECK(state.link.size() <= kMaxStar);
}
