// SPDX-License-Identifier: MIT
#include "trace/run_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/example_traces.h"

using namespace tetmend;

namespace {

/// Two runs over one mesh: the first only smooths.
struct TwoRuns {
  TwoRuns() {
    TetMesh mesh(test::delaunay_ball(120, 3));
    TetMesh again = mesh;
    test::record(mesh, folder / "a.trace", {}, {}, Schedule("smooth.lua", "smooth{}"));
    test::record(again, folder / "b.trace");
  }
  test::TempFolder folder;
};

Quality quality_of(const SlotMesh& mesh, const HistorySubject& tet) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    HistorySubject vertices(mesh.vertices(t).begin(), mesh.vertices(t).end());
    std::sort(vertices.begin(), vertices.end());
    if (vertices == tet) return mesh.quality(t);
  }
  FAIL("no such tet");
  return 0;
}

Point centroid(const SlotMesh& mesh, const HistorySubject& tet) {
  Point sum = Point::Zero();
  for (const VertexHandle v : tet) sum += mesh.point(v);
  return sum / 4;
}

/// The sum of the four parts is the whole only for a point inside.
bool contains(const SlotMesh& mesh, const HistorySubject& tet, const Point& p) {
  const auto volume = [](const Point& a, const Point& b, const Point& c, const Point& d) {
    return std::abs((b - a).cross(c - a).dot(d - a));
  };
  std::array<Point, 4> c;
  for (std::size_t i = 0; i < 4; ++i) c[i] = mesh.point(tet[i]);
  const double parts = volume(p, c[1], c[2], c[3]) + volume(c[0], p, c[2], c[3]) +
                       volume(c[0], c[1], p, c[3]) + volume(c[0], c[1], c[2], p);
  return parts <= volume(c[0], c[1], c[2], c[3]) * (1 + 1e-9);
}

}  // namespace

TEST_CASE("tets that only one of two runs left bad are found by their place, with both qualities") {
  const TwoRuns runs;
  const TraceFile a(runs.folder / "a.trace");
  const TraceFile b(runs.folder / "b.trace");
  const RunComparison found = compare_runs(a, b);
  CHECK(found.same_beginning);
  // The second schedule ends with a standard of its own, which is told.
  CHECK(found.same_goal ==
        (format_comparison(a, b, found, 0).find("goals of the runs differ") == std::string::npos));
  CHECK(found.bad_in_a > found.bad_in_b);
  REQUIRE(found.worse_in_a.size() > 5);
  CHECK(found.worse_in_a.size() <= found.bad_in_a);
  Replay end_a(a, 0);
  Replay end_b(b, 0);
  end_a.seek(a.event_count());
  end_b.seek(b.event_count());
  Quality last = -1;
  for (const TetPair& pair : found.worse_in_a) {
    CHECK(pair.bad_quality == quality_of(end_a.mesh(), pair.bad));
    CHECK(pair.good_quality == quality_of(end_b.mesh(), pair.good));
    CHECK(pair.bad_quality < 1);
    CHECK(pair.good_quality >= 1);
    CHECK(pair.bad_quality >= last);
    last = pair.bad_quality;
    CHECK(contains(end_b.mesh(), pair.good, centroid(end_a.mesh(), pair.bad)));
  }
  // Every bad tet of a has a place in b: good there, or bad.
  const RunComparison other = compare_runs(b, a);
  CHECK(other.worse_in_b.size() == found.worse_in_a.size());
  CHECK(other.worse_in_a.size() == found.worse_in_b.size());
}

TEST_CASE("a run beside itself has no differences") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const RunComparison same = compare_runs(file, file);
  CHECK(same.worse_in_a.empty());
  CHECK(same.worse_in_b.empty());
  CHECK(same.bad_in_a == same.bad_in_b);
  CHECK(same.same_goal);
  const std::string text = format_comparison(file, file, same, 3);
  CHECK(text.find(fmt::format(" {} ", file.calls().size())) != std::string::npos);
  CHECK(text.find("+0") != std::string::npos);
  CHECK(text.find("different meshes") == std::string::npos);
}

TEST_CASE("two runs side by side are told with differences, one axis of time and both histories") {
  const TwoRuns runs;
  const TraceFile a(runs.folder / "a.trace");
  const TraceFile b(runs.folder / "b.trace");
  const RunComparison found = compare_runs(a, b);
  const std::string text = format_comparison(a, b, found, 2);
  CHECK(text.find("schedule smooth.lua") != std::string::npos);
  CHECK(text.find("n_bad a") != std::string::npos);
  CHECK(text.find(as_question(found.worse_in_a[0].bad)) != std::string::npos);
  CHECK(text.find(as_question(found.worse_in_a[1].good)) != std::string::npos);
  CHECK(text.find("  b: Tet ") != std::string::npos);
  const auto json = nlohmann::json::parse(comparison_json(a, b, found));
  REQUIRE(found.over_b.size() == b.passes().size() + 1);
  CHECK(found.over_a.front().n_bad == found.over_b.front().n_bad);  // of one mesh
  CHECK(found.over_b.front().n_bad > found.over_b.back().n_bad);
  CHECK(found.over_b.back().n_bad == b.passes().back().now.n_bad);
  CHECK(found.over_b.back().seconds == b.passes().back().events.end_seconds);
  CHECK(json["bad_over_time_b"].size() == found.over_b.size());
  CHECK(json["bad_over_time_b"].back()["n_bad"] == found.over_b.back().n_bad);
  CHECK(json["bad_in_a_good_in_b"].size() == found.worse_in_a.size());
  CHECK(json["a"]["all"]["calls"] == a.calls().size());
  CHECK(json["b"]["all"]["calls"] == b.calls().size());
}

TEST_CASE("runs that began with different meshes say so") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(60, 3));
  TetMesh other(test::delaunay_ball(70, 4));
  test::record(mesh, folder / "a.trace", {}, {}, Schedule("smooth.lua", "smooth{}"));
  test::record(other, folder / "b.trace", {}, {}, Schedule("smooth.lua", "smooth{}"));
  const TraceFile a(folder / "a.trace");
  const TraceFile b(folder / "b.trace");
  const RunComparison found = compare_runs(a, b);
  CHECK_FALSE(found.same_beginning);
  CHECK(format_comparison(a, b, found, 0).find("different meshes") != std::string::npos);
}
