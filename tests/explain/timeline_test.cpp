// SPDX-License-Identifier: MIT
#include "explain/timeline.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "kernel/statistics.h"
#include "tests/support/example_traces.h"
#include "trace/traced_standard.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

/// The figures of the mesh as it is, by the library's own count.
QualityIndicators truth_of(const SlotMesh& mesh) {
  TetMesh built(mesh.to_data());
  built.set_standard(mesh.standard());
  return quality_indicators(built);
}

}  // namespace

TEST_CASE("the curves are those of the mesh at each sample") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  const Timeline timeline = make_timeline(file, replay, nullptr, 60);
  CHECK(replay.position() == 0);
  REQUIRE(timeline.samples.size() > 20);
  CHECK(timeline.samples.size() < 130);
  CHECK(timeline.samples.front().position == 0);
  CHECK(timeline.samples.back().position == file.event_count());
  CHECK(timeline.samples.front().n_bad > timeline.samples.back().n_bad);
  for (const Timeline::Sample& sample : timeline.samples) {
    replay.seek(sample.position);
    const QualityIndicators truth = truth_of(replay.mesh());
    CHECK(sample.n_bad == truth.n_bad);
    CHECK(sample.q_worst == truth.q_worst);
  }
}

TEST_CASE("equal numbers of changes mean equal meshes, and each change makes another mesh") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  const Timeline timeline = make_timeline(file, replay);
  REQUIRE(timeline.changes.size() > 50);
  const auto state = [&] {
    return std::pair(replay.mesh().fingerprint(), describe(replay.mesh().standard()));
  };
  CHECK(timeline.changes_before(0) == 0);
  CHECK(timeline.changes_before(file.event_count()) == timeline.changes.size());
  replay.seek(0);
  auto last = state();
  for (std::size_t i = 0; i < 50; ++i) {
    replay.seek(timeline.changes[i] - 1);
    CHECK(state() == last);
    replay.seek(timeline.changes[i]);
    CHECK(state() != last);
    last = state();
  }
}

TEST_CASE("the curves follow a run that changes its goal") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  test::record(mesh, folder / "trace", {}, {},
               Schedule("goals", "smooth{} goal{min = 40} smooth{} goal{min = 10} smooth{}"));
  const TraceFile file(folder / "trace");
  Replay replay(file);
  const Timeline timeline = make_timeline(file, replay, nullptr, file.event_count());
  std::size_t goals = 0;
  for (const Timeline::Sample& sample : timeline.samples) {
    const Goal before = replay.mesh().standard().goal();
    replay.seek(sample.position);
    const QualityIndicators truth = truth_of(replay.mesh());
    CHECK(sample.n_bad == truth.n_bad);
    CHECK(sample.q_worst == truth.q_worst);
    if (replay.mesh().standard().goal() == before) continue;
    ++goals;
    CHECK(timeline.changes_before(sample.position) ==
          timeline.changes_before(sample.position - 1) + 1);
  }
  CHECK(goals == 2);
}

TEST_CASE("a small trace has a sample wherever a number changes") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  const Timeline timeline = make_timeline(file, replay);
  for (std::size_t i = 1; i + 1 < timeline.samples.size(); ++i) {
    const Timeline::Sample& now = timeline.samples[i];
    const Timeline::Sample& last = timeline.samples[i - 1];
    CHECK((now.n_bad != last.n_bad || now.q_worst != last.q_worst));
    CHECK(std::binary_search(timeline.changes.begin(), timeline.changes.end(), now.position));
  }
}

TEST_CASE("the sample of a position is the last one that is not after it") {
  Timeline timeline;
  timeline.samples = {{0, 9, 0.1}, {10, 5, 0.2}, {20, 1, 0.3}};
  CHECK(timeline.at(0).n_bad == 9);
  CHECK(timeline.at(9).n_bad == 9);
  CHECK(timeline.at(10).n_bad == 5);
  CHECK(timeline.at(99).n_bad == 1);
}
