// SPDX-License-Identifier: MIT
// The walk around an edge, and the search of the best covering mesh of its shell.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/micro/example.h"
#include "kernel/shell.h"
#include "search/covering_search.h"

namespace {

using namespace tetmend;
using benchmark::Counter;

void shell_walk(benchmark::State& state) {
  const TetMesh& mesh = bench::example_mesh();
  const auto degree = static_cast<unsigned>(state.range(0));
  const std::vector<TetEdge> edges = bench::edges_of_degree(mesh, degree);
  state.SetLabel(std::to_string(edges.size()) + " edges");
  Shell shell;
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(find_shell(mesh, edges[next], shell, Territory()));
    benchmark::ClobberMemory();
    next = next + 1 == edges.size() ? 0 : next + 1;
  }
  const auto tets = static_cast<double>(state.iterations()) * degree;
  state.counters["per_tet"] = Counter(tets, Counter::kIsRate | Counter::kInvert);
}
BENCHMARK(shell_walk)->ArgName("ring")->DenseRange(3, 9);

/// A shell with one thin tet, such as the shells around bad tets.
struct ShellPoints {
  Point upper;
  Point lower;
  std::vector<Point> ring;
  std::vector<Quality> old_sides;
  Quality worst = 1;
};

ShellPoints shaken_shell(unsigned degree, std::mt19937& random) {
  const auto real = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) * 0x1p-32;
  };
  ShellPoints shell;
  const double height = real(0.2, 1);
  shell.upper = Point(0, 0, height);
  shell.lower = Point(0, 0, -height);
  for (unsigned i = 0; i < degree; ++i) {
    const double place = i == 0 ? real(0.6, 0.95) : i;  // the first two are close together
    const double turn = 2 * std::numbers::pi * place / degree;
    const Point shift(real(-0.1, 0.1), real(-0.1, 0.1), real(-0.1, 0.1));
    shell.ring.push_back(Point(std::cos(turn), std::sin(turn), 0) + shift);
  }
  for (unsigned i = 0; i < degree; ++i) {
    const Point& next = shell.ring[(i + 1) % degree];
    shell.old_sides.push_back(
        static_cast<Quality>(minimum_sine(shell.lower, shell.upper, shell.ring[i], next)));
    shell.worst = std::min(shell.worst, shell.old_sides.back());
  }
  return shell;
}

/// With floor: every new tet must beat the worst old one, as in a run. Without: it must be
/// positive.
void covering_search(benchmark::State& state) {
  constexpr unsigned kShells = 64;
  const auto degree = static_cast<unsigned>(state.range(0));
  const bool with_floor = state.range(1) != 0;
  std::mt19937 random(degree);
  std::vector<ShellPoints> shells;
  while (shells.size() < kShells) {
    shells.push_back(shaken_shell(degree, random));
    if (!(shells.back().worst > 0)) shells.pop_back();
  }

  const auto search = std::make_unique<CoveringSearch>();
  Covering covering;
  std::size_t next = 0;
  double evaluations = 0;
  double found = 0;
  for (auto _ : state) {
    const ShellPoints& shell = shells[next];
    const CoveringProblem problem{.a = shell.lower,
                                  .b = shell.upper,
                                  .ring = shell.ring,
                                  .old_sides = shell.old_sides,
                                  .standard = {},
                                  .floor = with_floor ? shell.worst : 0};
    found += search->run(problem, covering) ? 1 : 0;
    benchmark::DoNotOptimize(covering);
    evaluations += search->evaluations();
    next = next + 1 == shells.size() ? 0 : next + 1;
  }
  state.counters["evaluations"] = Counter(evaluations, Counter::kAvgIterations);
  state.counters["found"] = Counter(found, Counter::kAvgIterations);
}
BENCHMARK(covering_search)
    ->ArgNames({"ring", "floor"})
    ->ArgsProduct({benchmark::CreateDenseRange(3, 12, 1), {0, 1}});

}  // namespace
