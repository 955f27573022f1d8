// SPDX-License-Identifier: MIT
// Traces to look at: one made by hand, and one of a true run.
#pragma once

#include <array>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/traced_run.h"
#include "trace/trace_file.h"

namespace tetmend::test {

/// Its events, and the position after each:
///    1 pass          5 candidate              9 recursion (0 1) ends: no improvement
///    2   visit       6 shell (0 1) ends      10   visit ends
///    3     recursion (0 1), level 0, call 0  11 pass ends
///    4       shell (0 1), level 0, call 1
///    7       recursion (0 2), level 1, call 2;  8 it ends: depth spent
inline void record_by_hand(const std::filesystem::path& file) {
  const TetMesh mesh(shell_mesh({.degree = 5}));
  TraceRecorder recorder(file, mesh, {});
  const std::array edge = {VertexHandle(0), VertexHandle(1)};
  const std::array link_edge = {VertexHandle(0), VertexHandle(2)};
  recorder.pass_begins("reconnect", 1);
  recorder.visit_begins(mesh.vertices(TetHandle(0)), 0.25F);
  recorder.attempt_begins({operator_name(Algorithm::recursion), edge, 0, ""});
  recorder.attempt_begins({operator_name(Algorithm::shell_transformation), edge, 0, ""});
  recorder.candidate_found();
  recorder.attempt_ends(Verdict::no_improvement, {}, {});
  recorder.attempt_begins({operator_name(Algorithm::recursion), link_edge, 1, ""});
  recorder.attempt_ends(Verdict::depth_spent, {}, {});
  recorder.attempt_ends(Verdict::no_improvement, {}, {});
  recorder.visit_ends();
  recorder.pass_ends({});
  recorder.finish();
}

struct HandmadeTrace {
  HandmadeTrace() { record_by_hand(folder / "by_hand.trace"); }
  TempFolder folder;
  std::filesystem::path path() const { return folder / "by_hand.trace"; }
};

/// The schedule of the paper on a ball of random points: recursion, smoothing, insertion.
struct TracedBall {
  TracedBall() {
    TetMesh mesh(delaunay_ball(120, 3));
    record(mesh, path());
  }
  TempFolder folder;
  std::filesystem::path path() const { return folder / "ball.trace"; }
};

}  // namespace tetmend::test
