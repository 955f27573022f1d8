// SPDX-License-Identifier: MIT
// Edits of a mesh: the general replace_cavity against a flip written by hand, and undoing.
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/micro/example.h"
#include "bench/micro/plain_flip.h"
#include "kernel/shell.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"

namespace {

using namespace tetmend;

constexpr int kRounds = 300;  // each from a fresh copy of the mesh

struct Flip {
  Shell shell;
  std::array<TetVertices, 2> created;

  std::span<const TetHandle> old() const { return std::span(shell.tets).first(3); }
};

/// 3-2 flips that the mesh allows and that do not touch each other.
std::vector<Flip> independent_flips(const TetMesh& start) {
  TetMesh mesh = start;
  Workspace workspace(mesh);
  std::vector<bool> used(mesh.vertex_slots());
  std::vector<Flip> flips;
  for (const TetEdge edge : bench::edges_of_degree(mesh, 3)) {
    Flip flip;
    find_shell(mesh, edge, flip.shell, Territory());
    const auto& [p, q, r] = std::array{flip.shell.ring[0], flip.shell.ring[1], flip.shell.ring[2]};
    const std::array around = {flip.shell.a, flip.shell.b, p, q, r};
    if (std::ranges::any_of(around, [&used](VertexHandle v) { return used[v.index()]; })) continue;
    flip.created = {TetVertices{flip.shell.a, p, q, r}, TetVertices{p, q, r, flip.shell.b}};
    Transaction transaction(mesh, workspace);
    if (transaction.replace_cavity(flip.old(), flip.created) != EditResult::made) continue;
    for (const VertexHandle v : around) used[v.index()] = true;
    flips.push_back(flip);
  }
  return flips;
}

const std::vector<Flip>& example_flips() {
  static const std::vector<Flip> kFlips = independent_flips(bench::example_mesh());
  return kFlips;
}

double per_flip(double seconds) {
  return seconds / static_cast<double>(example_flips().size());
}

void flip_by_hand(benchmark::State& state) {
  const bench::PlainMesh start(bench::example_mesh());
  for (auto _ : state) {
    bench::PlainMesh mesh = start;
    state.SetIterationTime(per_flip(bench::seconds_of([&mesh] {
      for (const Flip& flip : example_flips()) mesh.flip_3_2(flip.shell);
    })));
  }
}
BENCHMARK(flip_by_hand)->UseManualTime()->Iterations(kRounds);

/// The same flips, each in a transaction of its own that is kept.
void flip_by_replace_cavity(benchmark::State& state) {
  for (auto _ : state) {
    TetMesh mesh = bench::example_mesh();
    Workspace workspace(mesh);
    state.SetIterationTime(per_flip(bench::seconds_of([&] {
      for (const Flip& flip : example_flips()) {
        Transaction transaction(mesh, workspace);
        transaction.replace_cavity(flip.old(), flip.created);
        transaction.keep();
      }
    })));
  }
}
BENCHMARK(flip_by_replace_cavity)->UseManualTime()->Iterations(kRounds);

/// The same flips in one transaction; only undoing is timed.
void undo_of_flip(benchmark::State& state) {
  TetMesh mesh = bench::example_mesh();
  Workspace workspace(mesh);
  for (auto _ : state) {
    Transaction transaction(mesh, workspace);
    for (const Flip& flip : example_flips()) transaction.replace_cavity(flip.old(), flip.created);
    state.SetIterationTime(per_flip(bench::seconds_of([&transaction] { transaction.undo(); })));
  }
}
BENCHMARK(undo_of_flip)->UseManualTime()->Iterations(kRounds);

/// What a refused attempt costs: flip, comparison of the quality vectors, undo.
void flip_compare_undo(benchmark::State& state) {
  TetMesh mesh = bench::example_mesh();
  Workspace workspace(mesh);
  const std::vector<Flip>& flips = example_flips();
  std::vector<Quality> before;
  std::vector<Quality> now;
  std::size_t next = 0;
  for (auto _ : state) {
    Transaction transaction(mesh, workspace);
    transaction.replace_cavity(flips[next].old(), flips[next].created);
    transaction.compare(before, now);
    benchmark::DoNotOptimize(before.data());
    transaction.undo();
    next = next + 1 == flips.size() ? 0 : next + 1;
  }
}
BENCHMARK(flip_compare_undo);

}  // namespace
