// SPDX-License-Identifier: MIT
// What more cores would make of the default schedule: measured on one thread from the time of each
// block.
//
//   for 1, 2, 4, ... 256 threads with the blocks that the size of the mesh asks for:
//     time, speed-up
//   for 1, 2, 4, ... 256 blocks with one thread for each:
//     deferred work, work of one thread alone, critical path, speed-up
//   the passes in detail for the largest number
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <queue>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "kernel/formats/mesh_io.h"
#include "schedule/schedule.h"

namespace tetmend {
namespace {

/// How the time of passes splits up: what more threads would make of it. Measured on one thread.
struct TimeSplit {
  static constexpr std::size_t kSpans = 9;  // 1, 2, 4, ... 256 threads

  double total = 0;
  double scans = 0;                    // over the whole mesh, which split evenly
  double blocks = 0;                   // sum over all blocks
  std::array<double, kSpans> spans{};  // of the blocks on 2^i threads, largest block first

  /// All that only one thread can do.
  double alone() const { return std::max(0.0, total - scans - blocks); }
  /// Seconds on 2^i threads.
  double at(std::size_t i) const {
    return alone() + scans / static_cast<double>(std::size_t{1} << i) + spans[i];
  }
  TimeSplit& operator+=(const TimeSplit& other) {
    total += other.total;
    scans += other.scans;
    blocks += other.blocks;
    for (std::size_t i = 0; i < kSpans; ++i) spans[i] += other.spans[i];
    return *this;
  }
};

/// When the last of some threads is done that take tasks of the given lengths in that order.
double span_of(std::span<const double> sorted, std::size_t threads) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
  for (std::size_t i = 0; i < threads; ++i) free_at.push(0);
  double last = 0;
  for (const double seconds : sorted) {
    const double end = free_at.top() + seconds;
    free_at.pop();
    free_at.push(end);
    last = std::max(last, end);
  }
  return last;
}

/// Hears how long the blocks of each pass took.
class BlockTimes final : public ProgressListener {
 public:
  using Spans = std::array<double, TimeSplit::kSpans>;

  void progress(std::string_view, unsigned, double) override {}
  void blocks_done(std::span<const double> seconds) override {
    std::vector<double> sorted(seconds.begin(), seconds.end());
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    for (std::size_t i = 0; i < now_.size(); ++i) now_[i] += span_of(sorted, std::size_t{1} << i);
  }
  void pass_done(std::string_view, unsigned, const QualityIndicators&) override {
    passes.push_back(std::exchange(now_, {}));
  }

  std::vector<Spans> passes;  // as Run::records

 private:
  Spans now_{};
};

struct Totals {
  TimeSplit split;
  std::size_t items = 0;
  std::size_t deferred = 0;

  void add(const PassRecord& pass, const BlockTimes::Spans& spans) {
    split += {pass.seconds, pass.seconds_in_scans, pass.seconds_in_blocks, spans};
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
  const Registry registry = Registry::builtin();
  Run run(mesh, registry);
  if (blocks > 0) run.set_block_count(blocks);
  BlockTimes times;
  run.set_listener(&times);
  improve(run);
  Measured result;
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const PassRecord& pass = run.records[i];
    result.all.add(pass, times.passes[i]);
    result.passes[pass.name].add(pass, times.passes[i]);
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
