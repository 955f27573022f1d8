// SPDX-License-Identifier: MIT
// Sweeps in blocks: each target is tried where it can be, and the number of threads does not show.
#include "schedule/sweep.h"

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/workspace.h"
#include "schedule/passes.h"
#include "schedule/schedule.h"
#include "tests/support/registry.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"
#include "trace/text_trace.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct Item {
  VertexHandle vertex;

  std::span<const VertexHandle> corners() const { return {&vertex, 1}; }
  bool is_there(const TetMesh& mesh) const { return !mesh.is_deleted(vertex); }
  friend bool operator<(Item x, Item y) { return x.vertex < y.vertex; }
};

std::vector<Item> all_vertices(const TetMesh& mesh) {
  std::vector<Item> items;
  for (const VertexHandle v : live_vertices(mesh)) items.push_back({v});
  return items;
}

TetMesh bad_cube() {
  return TetMesh::sorted(kuhn_cube(12, 0.33, 3));
}

struct SweepOutcome {
  TetMesh mesh;
  QualityIndicators after;
};

SweepOutcome improved(const TetMesh& input, std::size_t blocks, int threads,
                      TraceSink* trace = nullptr) {
  SweepOutcome outcome{input, {}};
  on_threads(threads, [&] {
    Run run(outcome.mesh, kRegistry);
    run.set_block_count(blocks);
    run.set_trace(trace);
    improve(run);
  });
  outcome.after = quality_indicators(outcome.mesh);
  return outcome;
}

}  // namespace

TEST_CASE("each item is tried once, in ascending order inside a block, and again when deferred") {
  TetMesh mesh = bad_cube();
  for (const int threads : {1, 3}) {
    on_threads(threads, [&] {
      Run run(mesh, kRegistry);
      run.set_block_count(8);
      std::mutex lock;
      std::map<VertexHandle, int> tries;
      std::map<Worker*, VertexHandle> last;
      bool ordered = true;
      {
        PassScope scope(run, "test");
        work_off(run, scope, all_vertices(mesh), 0, [&](Worker& worker, Item& item) {
          const std::lock_guard<std::mutex> guard(lock);
          const bool first = ++tries[item.vertex] == 1;
          if (worker.workspace().territory().is_whole()) {
            ordered = ordered && (!last.contains(&worker) || last[&worker] < item.vertex);
            last[&worker] = item.vertex;
          } else {
            ordered = ordered && worker.workspace().territory().holds(item.vertex);
          }
          return item.vertex.index() % 10 != 0 || !first;  // every tenth is deferred once
        });
        scope.finish();
      }
      CHECK(ordered);
      CHECK(tries.size() == mesh.vertex_count());
      bool as_expected = true;
      for (const auto& [v, count] : tries) {
        as_expected = as_expected && count == (v.index() % 10 == 0 ? 2 : 1);
      }
      CHECK(as_expected);
      CHECK(run.records.back().items == mesh.vertex_count());
      CHECK(run.records.back().deferred == (mesh.vertex_count() + 9) / 10);
    });
  }
}

TEST_CASE("an item that is deferred everywhere is tried in the end with the whole mesh") {
  TetMesh mesh = bad_cube();
  Run run(mesh, kRegistry);
  run.set_block_count(8);
  PassScope scope(run, "test");
  std::size_t whole = 0;
  std::mutex lock;
  work_off(run, scope, all_vertices(mesh), 0, [&](Worker& worker, Item&) {
    const std::lock_guard<std::mutex> guard(lock);
    if (worker.workspace().territory().is_whole()) ++whole;
    return worker.workspace().territory().is_whole();
  });
  CHECK(whole == mesh.vertex_count());
}

TEST_CASE("a cancelled sweep tries nothing more") {
  TetMesh mesh = bad_cube();
  Run run(mesh, kRegistry);
  run.set_block_count(8);
  std::atomic<bool> cancel = true;
  run.set_cancel_flag(&cancel);
  PassScope scope(run, "test");
  std::atomic<int> tries = 0;
  work_off(run, scope, all_vertices(mesh), 0, [&](Worker&, Item&) {
    ++tries;
    return true;
  });
  CHECK(tries == 0);
}

TEST_CASE("when work on a block throws, the mesh is in order and the run can go on") {
  for (const int threads : {1, 3}) {
    CAPTURE(threads);
    TetMesh mesh = bad_cube();
    on_threads(threads, [&] {
      Run run(mesh, kRegistry);
      run.set_block_count(8);
      const auto contraction = kRegistry.make("edge_contraction");
      std::atomic<int> accepted = 0;
      {
        PassScope scope(run, "test");
        CHECK_THROWS_AS(work_off(run, scope, all_vertices(mesh), 0,
                                 [&](Worker& worker, Item& item) {
                                   const Verdict verdict =
                                       worker.attempt(*contraction, Target::of(item.vertex));
                                   if (verdict == Verdict::accepted && ++accepted == 10) {
                                     throw Error("enough");
                                   }
                                   return true;
                                 }),
                        Error);
      }
      CHECK(run.records.empty());
      CHECK(accepted >= 10);
      CHECK(mesh.vertex_count() == live_vertices(mesh).size());
      CHECK(mesh.tet_count() == live_tets(mesh).size());
      CHECK(to_string(check_integrity(mesh)) == "");
      const QualityIndicators before = quality_indicators(mesh);
      improve(run);
      CHECK(quality_indicators(mesh).n_bad < before.n_bad);
      CHECK(to_string(check_integrity(mesh)) == "");
    });
  }
}

TEST_CASE("a pass that an exception ended leaves no record, and is made anew") {
  struct Thrower final : ProgressListener {
    void progress(std::string_view, unsigned, double) override { throw Error("enough"); }
    void pass_done(std::string_view, unsigned, const QualityIndicators&) override {}
  };
  TetMesh mesh = bad_cube();
  Thrower thrower;
  Run run(mesh, kRegistry);
  run.set_block_count(1);
  run.set_listener(&thrower);
  CHECK_THROWS_AS(local_reconnection(run), Error);
  CHECK(run.records.empty());
  CHECK(mesh == bad_cube());
  run.set_listener(nullptr);
  local_reconnection(run);
  REQUIRE(run.records.size() == 1);
  CHECK(run.records[0].accepted() > 0);
}

TEST_CASE("what is collected comes in the order of the slots") {
  TetMesh mesh = bad_cube();
  Run run(mesh, kRegistry);
  PassScope scope(run, "test");
  const std::vector<std::uint32_t> found = on_threads(4, [&] {
    return collect<std::uint32_t>(scope, 100'000,
                                  [](std::size_t begin, std::size_t end, auto& out) {
                                    for (std::size_t i = begin; i < end; ++i) {
                                      if (i % 3 == 0) out.push_back(static_cast<std::uint32_t>(i));
                                    }
                                  });
  });
  REQUIRE(found.size() == 33'334);
  for (std::size_t n = 0; n < found.size(); ++n) REQUIRE(found[n] == 3 * n);
}

TEST_CASE("an improved mesh is the same, bit for bit, for every number of threads") {
  const TetMesh input = bad_cube();
  const SweepOutcome one = improved(input, 8, 1);
  for (const int threads : {2, 4}) {
    CAPTURE(threads);
    CHECK(improved(input, 8, threads).mesh == one.mesh);
  }
  TextTrace trace;
  CHECK(improved(input, 8, 4, &trace).mesh == one.mesh);
  CHECK(!trace.text().empty());
}

TEST_CASE("blocks do not cost quality, and keep surface, volume and integrity") {
  const TetMesh input = bad_cube();
  const QualityIndicators before = quality_indicators(input);
  const SweepOutcome whole = improved(input, 1, 2);
  for (const std::size_t blocks : {2, 8, 20}) {
    CAPTURE(blocks);
    const SweepOutcome outcome = improved(input, blocks, 2);
    CHECK(to_string(check_integrity(outcome.mesh)) == "");
    CHECK(surface_fingerprint(outcome.mesh) == surface_fingerprint(input));
    CHECK(total_volume(outcome.mesh) == doctest::Approx(total_volume(input)).epsilon(1e-12));
    CHECK(outcome.mesh.tet_count() == live_tets(outcome.mesh).size());
    CHECK(outcome.mesh.vertex_count() == live_vertices(outcome.mesh).size());
    const double gained = static_cast<double>(before.n_bad - whole.after.n_bad);
    CHECK(static_cast<double>(before.n_bad - outcome.after.n_bad) > 0.98 * gained);
    CHECK(outcome.after.q_worst > whole.after.q_worst - 0.08);
  }
}

TEST_CASE("a time limit ends a sweep of slow items after the next one") {
  TetMesh mesh = bad_cube();
  Run run(mesh, kRegistry);
  run.set_block_count(1);
  run.set_time_limit(0.02);
  std::size_t tried = 0;
  {
    PassScope scope(run, "slow");
    work_off(run, scope, all_vertices(mesh), 0, [&](Worker&, Item&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      ++tried;
      return true;
    });
  }
  CHECK(run.out_of_time());
  CHECK(tried <= 11);  // of 2,197
}
