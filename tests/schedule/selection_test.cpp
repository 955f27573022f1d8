// SPDX-License-Identifier: MIT
// Selections: each condition by itself and together, compared with a plain loop over the tets.
#include "schedule/selection.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/mesh_builder.h"
#include "schedule/queue.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// A ball of two regions: labels 1 and 2 left and right.
TetMesh ball() {
  MeshData data = delaunay_ball(300, 5);
  for (MeshData::Tet& tet : data.tets) {
    double x = 0;
    for (const std::uint32_t v : tet.vertices) x += data.points[v].x();
    tet.label = x < 0 ? 1 : 2;
  }
  return TetMesh(data);
}

std::set<TetHandle> selected(TetMesh& mesh, const Selection& selection,
                             const TetValues* values = nullptr) {
  Registry registry;
  Run run(mesh, registry);
  run.set_values(values);
  PassScope scope(run, "test");
  std::set<TetHandle> tets;
  for (const QueuedTet& tet : queue_tets(scope, mesh, selection, 0)) tets.insert(tet.tet);
  return tets;
}

std::set<TetHandle> where(const TetMesh& mesh, const std::function<bool(TetHandle)>& condition) {
  std::set<TetHandle> tets;
  for (const TetHandle t : live_tets(mesh)) {
    if (condition(t)) tets.insert(t);
  }
  return tets;
}

/// 5 for one tet, 1 for all others.
class Heat final : public TetValues {
 public:
  explicit Heat(TetHandle hot) : hot_(hot) {}
  Of find(std::string_view name) const override {
    if (name != "heat") return {};
    return [hot = hot_](const TetMesh&, TetHandle t) { return t == hot ? 5.0 : 1.0; };
  }
  std::vector<std::string> names() const override { return {"heat"}; }

 private:
  TetHandle hot_;
};

/// The worst of some tets.
std::set<TetHandle> worst(const TetMesh& mesh, std::set<TetHandle> tets, std::size_t count) {
  std::vector<TetHandle> sorted(tets.begin(), tets.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](TetHandle x, TetHandle y) { return mesh.quality(x) < mesh.quality(y); });
  sorted.resize(std::min(count, sorted.size()));
  return {sorted.begin(), sorted.end()};
}

}  // namespace

TEST_CASE("by default the bad tets are selected, and all on demand") {
  TetMesh mesh = ball();
  const auto bad = where(mesh, [&](TetHandle t) { return mesh.quality(t) < kBadThreshold; });
  REQUIRE(bad.size() > 50);
  REQUIRE(bad.size() < mesh.tet_count());
  CHECK(selected(mesh, {}) == bad);
  CHECK(selected(mesh, {.below = Selection::kAll}).size() == mesh.tet_count());
  CHECK(selected(mesh, {.below = 0.2f}) ==
        where(mesh, [&](TetHandle t) { return mesh.quality(t) < 0.2f; }));
}

TEST_CASE("the number is limited from above by count and share, from below among the bad tets") {
  TetMesh mesh = ball();
  const auto bad = where(mesh, [&](TetHandle t) { return mesh.quality(t) < kBadThreshold; });
  const auto all = where(mesh, [](TetHandle) { return true; });
  CHECK(selected(mesh, {.worst = 17}) == worst(mesh, bad, 17));
  CHECK(selected(mesh, {.worst = 100000}) == bad);
  CHECK(selected(mesh, {.below = Selection::kAll, .share = 0.1}).size() ==
        (mesh.tet_count() + 9) / 10);
  CHECK(selected(mesh, {.below = -1, .at_least = 20}) == worst(mesh, bad, 20));
  CHECK(selected(mesh, {.below = -1, .at_least = 100000}) == bad);
  const auto dire = where(mesh, [&](TetHandle t) { return mesh.quality(t) < 0.3f; });
  REQUIRE(dire.size() > 20);
  CHECK(selected(mesh, {.below = 0.3f, .at_least = 20}) == dire);
}

TEST_CASE("tets are selected by the label of their region") {
  TetMesh mesh = ball();
  const auto left = where(mesh, [&](TetHandle t) { return mesh.label(t) == 1; });
  REQUIRE(left.size() > 100);
  CHECK(selected(mesh, {.below = Selection::kAll, .labels = {1}}) == left);
  CHECK(selected(mesh, {.below = Selection::kAll, .labels = {1, 2}}).size() == mesh.tet_count());
  CHECK(selected(mesh, {.below = Selection::kAll, .labels = {7}}).empty());
}

TEST_CASE("tets with all vertices in a box are selected") {
  TetMesh mesh = ball();
  const Eigen::AlignedBox3d box(Point(0, -1, -1), Point(1, 1, 1));
  const auto inside = where(mesh, [&](TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    return std::all_of(v.begin(), v.end(), [&](VertexHandle w) { return mesh.point(w).x() >= 0; });
  });
  REQUIRE(inside.size() > 50);
  CHECK(selected(mesh, {.below = Selection::kAll, .box = box}) == inside);
}

TEST_CASE("tets are selected by a value of a run and by a quality measure") {
  TetMesh mesh = ball();
  const TetHandle hot = *live_tets(mesh).begin();
  const Heat heat(hot);
  const ValueRange above{.name = "heat", .low = 4};
  CHECK(selected(mesh, {.below = Selection::kAll, .value = above}, &heat) ==
        std::set<TetHandle>{hot});
  const ValueRange sharp{.name = "min_angle", .high = 20};
  const auto expected = where(mesh, [&](TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    return minimum_dihedral_angle(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]),
                                  mesh.point(v[3])) <= 20;
  });
  REQUIRE(expected.size() > 10);
  CHECK(selected(mesh, {.below = Selection::kAll, .value = sharp}) == expected);
  const ValueRange unknown{.name = "taste"};
  CHECK_THROWS_AS(selected(mesh, {.value = unknown}), Error);
}

TEST_CASE("conditions hold together, and the worst are chosen among those that meet them") {
  TetMesh mesh = ball();
  const auto left_and_bad = where(
      mesh, [&](TetHandle t) { return mesh.label(t) == 1 && mesh.quality(t) < kBadThreshold; });
  CHECK(selected(mesh, {.labels = {1}}) == left_and_bad);
  CHECK(selected(mesh, {.worst = 5, .labels = {1}}) == worst(mesh, left_and_bad, 5));
}

TEST_CASE("descriptions differ where selections differ") {
  const std::vector<Selection> all = {{},
                                      {.below = 0.4f},
                                      {.at_least = 3},
                                      {.worst = 3},
                                      {.share = 0.5},
                                      {.labels = {3}},
                                      {.box = Eigen::AlignedBox3d(Point(0, 0, 0), Point(1, 1, 1))},
                                      {.value = ValueRange{.name = "heat"}}};
  std::set<std::string> texts;
  for (const Selection& selection : all) texts.insert(selection.describe());
  CHECK(texts.size() == all.size());
  CHECK(Selection().describe() == Selection{.below = kBadThreshold}.describe());
}

TEST_CASE("a part of a mesh has its share of a number of tets, rounded up") {
  const Selection all = {.at_least = 100, .worst = 32};
  const auto part = [&](std::uint64_t of, std::uint64_t whole) { return all.of_part(of, whole); };
  CHECK(part(1, 3).at_least == 34);
  CHECK(part(1, 3).worst == 11);
  CHECK(part(1, 4).at_least == 25);
  CHECK(part(1, 4).worst == 8);
  CHECK(part(1, 1'000'000).worst == 1);
  CHECK(part(0, 7).worst == 0);
  CHECK(part(7, 7).describe() == all.describe());
  CHECK(Selection().of_part(1, 3).describe() == Selection().describe());
  // The product of these does not fit into 64 bits.
  constexpr std::uint64_t kLarge = 1'000'000'000'000;
  const std::uint64_t whole = (std::uint64_t{1} << 34) - 1;
  CHECK(Selection{.worst = kLarge}.of_part(std::uint64_t{1} << 29, whole).worst == 31'250'000'002);
}

TEST_CASE("where dates begin later, only what has changed since then is tried") {
  TetMesh mesh = ball();
  Registry registry;
  Run run(mesh, registry);
  run.set_first_date(1);
  CHECK(run.begin_sweep("a pass") == 1);
  CHECK(run.begin_sweep("a pass") == 2);
  PassScope scope(run, "test");
  CHECK(queue_tets(scope, mesh, {.below = Selection::kAll}, 1).empty());
  const VertexHandle v(0);
  MeshBuilder::set_changed(mesh, v, 1);
  const auto queued = queue_tets(scope, mesh, {.below = Selection::kAll}, 1);
  CHECK(!queued.empty());
  for (const QueuedTet& tet : queued) {
    CHECK(std::find(tet.vertices.begin(), tet.vertices.end(), v) != tet.vertices.end());
  }
}

TEST_CASE("vertices of selected tets are queued once, and fixed ones never") {
  TetMesh mesh = ball();
  Registry registry;
  Run run(mesh, registry);
  PassScope scope(run, "test");
  for (const Selection& selection :
       {Selection{}, Selection{.worst = 9}, Selection{.labels = {2}}}) {
    std::set<VertexHandle> expected;
    for (const TetHandle t : selected(mesh, selection)) {
      for (const VertexHandle v : mesh.vertices(t)) {
        if (!mesh.is_fixed(v)) expected.insert(v);
      }
    }
    const auto queued = queue_vertices(scope, mesh, selection, 0);
    std::set<VertexHandle> vertices;
    for (const QueuedVertex& entry : queued) vertices.insert(entry.vertex);
    CHECK(vertices == expected);
    CHECK(queued.size() == expected.size());
  }
}
