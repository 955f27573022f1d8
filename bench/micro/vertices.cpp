// SPDX-License-Identifier: MIT
// The star of a vertex, the best place in its ball, and the whole smoothing of a vertex.
#include <cstddef>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/micro/example.h"
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "ops/vertex_ball.h"

namespace {

using namespace tetmend;
using benchmark::Counter;

void star_walk(benchmark::State& state) {
  const TetMesh& mesh = bench::example_mesh();
  const std::vector<VertexHandle> vertices = bench::bad_vertices(mesh);
  Workspace workspace(mesh);
  std::vector<HalfFace> link;
  std::size_t next = 0;
  std::size_t tets = 0;
  for (auto _ : state) {
    collect_link(mesh, vertices[next], workspace, link);
    tets += link.size();
    next = next + 1 == vertices.size() ? 0 : next + 1;
  }
  state.counters["per_tet"] =
      Counter(static_cast<double>(tets), Counter::kIsRate | Counter::kInvert);
}
BENCHMARK(star_walk);

/// Loading a ball and climbing to its best place; the mesh stays.
void ball_optimiser(benchmark::State& state) {
  const TetMesh& mesh = bench::example_mesh();
  const std::vector<VertexHandle> vertices = bench::bad_vertices(mesh);
  Workspace workspace(mesh);
  std::vector<HalfFace> link;
  BallOptimiser ball;
  std::size_t next = 0;
  std::size_t tets = 0;
  for (auto _ : state) {
    collect_link(mesh, vertices[next], workspace, link);
    load_ball(mesh, link, ball);
    Point p = mesh.point(vertices[next]);
    benchmark::DoNotOptimize(ball.optimise(p, {.steps = 12}));
    tets += ball.size();
    next = next + 1 == vertices.size() ? 0 : next + 1;
  }
  state.counters["tets"] = Counter(static_cast<double>(tets), Counter::kAvgIterations);
}
BENCHMARK(ball_optimiser);

/// One sweep of the operator over all vertices at bad tets, each sweep from a fresh copy of the
/// mesh; the time is that of one vertex.
void smoothing(benchmark::State& state) {
  const std::vector<VertexHandle> vertices = bench::bad_vertices(bench::example_mesh());
  Registry registry = Registry::builtin();
  const auto operation = registry.make("smoothing");
  OperatorStates states;
  double moved = 0;
  for (auto _ : state) {
    TetMesh mesh = bench::example_mesh();
    Workspace workspace(mesh);
    OperatorContext context{mesh, workspace, states};
    const double seconds = bench::seconds_of([&] {
      for (const VertexHandle v : vertices) {
        const Verdict verdict = operation->attempt(context, Target::of(v));
        moved += verdict == Verdict::accepted ? 1 : 0;
      }
    });
    state.SetIterationTime(seconds / static_cast<double>(vertices.size()));
  }
  state.counters["accepted"] =
      Counter(moved / static_cast<double>(vertices.size()), Counter::kAvgIterations);
}
BENCHMARK(smoothing)->UseManualTime()->Iterations(50);

}  // namespace
