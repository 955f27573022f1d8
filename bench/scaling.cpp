// SPDX-License-Identifier: MIT
// What more cores would make of the default schedule: measured on one thread from the time of each
// block.
//
//   for 1, 2, 4, ... 256 threads with the blocks that the size of the mesh asks for: time, speed-up
//   for 1, 2, 4, ... 256 blocks with one thread for each: deferred work, work of one thread alone,
//   critical path, speed-up; the passes in detail for the largest number
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "kernel/formats/mesh_io.h"
#include "schedule/schedule.h"

namespace tetmend {
namespace {

struct Totals {
  TimeSplit split;
  std::size_t items = 0;
  std::size_t deferred = 0;

  void add(const PassRecord& pass) {
    split += pass.split;
    items += pass.items;
    deferred += pass.deferred;
  }
  double deferred_share() const {
    return items > 0 ? 100 * static_cast<double>(deferred) / static_cast<double>(items) : 0;
  }
  double alone_share() const { return split.total > 0 ? 100 * split.alone() / split.total : 0; }
};

struct Measured {
  Totals all;
  std::map<std::string, Totals> passes;
  QualityIndicators after;
};

/// @param blocks 0: as the size of the mesh asks for
Measured measure(TetMesh mesh, std::size_t blocks) {
  Registry registry = Registry::builtin();
  Run run(mesh, registry);
  if (blocks > 0) run.set_block_count(blocks);
  improve(run);
  Measured result;
  for (const PassRecord& pass : run.records) {
    result.all.add(pass);
    result.passes[pass.name].add(pass);
  }
  result.after = quality_indicators(mesh);
  return result;
}

void print_threads(const Measured& measured) {
  fmt::print("\nblocks by the size of the mesh\n{:<22}", "threads");
  for (std::size_t i = 0; i < TimeSplit::kSpans; ++i) fmt::print("{:>8}", std::size_t{1} << i);
  const auto row = [](const std::string& name, const Totals& totals) {
    fmt::print("\n{:<22}", name);
    for (std::size_t i = 0; i < TimeSplit::kSpans; ++i) {
      fmt::print("{:8.2f}", totals.split.at(0) / totals.split.at(i));
    }
  };
  for (const auto& [name, totals] : measured.passes) row(name, totals);
  row("all: speed-up", measured.all);
  fmt::print("\n{:<22}", "all: seconds");
  for (std::size_t i = 0; i < TimeSplit::kSpans; ++i) {
    fmt::print("{:8.2f}", measured.all.split.at(i));
  }
  fmt::print("\n\n{:<22}{:>10}{:>12}{:>10}\n", "pass", "alone %", "deferred %", "seconds");
  for (const auto& [name, totals] : measured.passes) {
    fmt::print("{:<22}{:10.2f}{:12.1f}{:10.2f}\n", name, totals.alone_share(),
               totals.deferred_share(), totals.split.total);
  }
}

void print_blocks(std::size_t blocks, std::size_t i, const Measured& measured, double base) {
  const double path = measured.all.split.at(i);
  fmt::print("{:8}{:10.2f}{:12.1f}{:12.2f}{:10.1f}{:9}{:10.4f}\n", blocks,
             measured.all.alone_share(), measured.all.deferred_share(), path, base / path,
             measured.after.n_bad, measured.after.q_worst);
}

void run(const std::string& file, bool threads_only) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  TetMesh mesh = TetMesh::sorted(read_mesh(file));
  fmt::print("{}: {} tets\n", file, mesh.tet_count());
  // A copy would have no room to grow.
  if (threads_only) return print_threads(measure(std::move(mesh), 0));
  print_threads(measure(mesh, 0));
  fmt::print("\none thread for each block\n{:>8}{:>10}{:>12}{:>12}{:>10}{:>9}{:>10}\n", "blocks",
             "alone %", "deferred %", "critical s", "speed-up", "n_bad", "q_worst");
  double base = 0;
  for (std::size_t i = 0; i < TimeSplit::kSpans; ++i) {
    const std::size_t blocks = std::size_t{1} << i;
    const Measured measured = measure(mesh, blocks);
    if (i == 0) base = measured.all.split.total;
    print_blocks(blocks, i, measured, base);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace tetmend

int main(int argc, char** argv) {
  const bool threads_only = argc == 3 && std::string_view(argv[1]) == "--threads-only";
  if (argc != 2 && !threads_only) {
    fmt::print(stderr, "usage: scaling [--threads-only] MESH\n");
    return 2;
  }
  try {
    tetmend::run(argv[argc - 1], threads_only);
  } catch (const std::exception& error) {
    fmt::print(stderr, "scaling: {}\n", error.what());
    return 1;
  }
  return 0;
}
