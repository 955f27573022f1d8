// SPDX-License-Identifier: MIT
// Schedules select tets by arrays of the mesh that came in.
#include <set>

#include <doctest/doctest.h>
#include <tetmend/improve.h>

#include "tests/face/meshes.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr unsigned kCellsAcross = 8;

/// With an array `age`: 1 in the half of small x, 5 in the other one.
template <class T>
Mesh aged_cube() {
  MeshArrays cube = shaken_cube(kCellsAcross, 1.0);
  std::vector<T> age;
  for (const auto& tet : cube.tets) {
    double x = 0;
    for (const std::uint32_t v : tet) x += cube.points[v][0];
    age.push_back(x / 4 < kCellsAcross / 2.0 ? T{1} : T{5});
  }
  cube.tet_data = {{"age", 1, age}, {"force", 3, std::vector<double>(3 * cube.tets.size())}};
  return Mesh(std::move(cube));
}

/// The largest x of a tet that is gone.
double reach(const Mesh& before, const std::vector<std::uint32_t>& tet_map) {
  double most = 0;
  for (std::size_t t = 0; t < tet_map.size(); ++t) {
    if (tet_map[t] != kGone) continue;
    double least = kCellsAcross;
    for (const std::uint32_t v : before.tets()[t]) least = std::min(least, before.points()[v][0]);
    most = std::max(most, least);
  }
  return most;
}

const std::string kYoung =
    R"(for i = 1, 3 do apply("edge_removal", {on = {property = {"age", low = 0, high = 3}}}) end)";

template <class T>
void check_young() {
  const Mesh before = aged_cube<T>();
  Mesh mesh = before;
  const Result some = improve(mesh, {.script = kYoung});
  CHECK(some.passes.front().accepted() > 10);
  CHECK(reach(before, some.tet_map) < kCellsAcross / 2.0 + 1);
  Mesh other = before;
  const Result all = improve(other, {.script = "for i = 1, 3 do apply('edge_removal') end"});
  CHECK(reach(before, all.tet_map) > kCellsAcross / 2.0 + 1);
  CHECK(all.passes.front().accepted() > some.passes.front().accepted());
}

}  // namespace

TEST_CASE("a schedule selects tets by an array of real or whole numbers of the mesh") {
  check_young<double>();
  check_young<float>();
  check_young<std::int32_t>();
  check_young<std::int64_t>();
}

TEST_CASE("a name that neither an array nor a measure has is an error that lists both") {
  Mesh mesh = aged_cube<double>();
  for (const std::string name : {"agee", "force"}) {  // the second has three numbers for each tet
    const std::string message = message_of([&] {
      improve(mesh, {.script = "apply('edge_removal', {on = {property = {'" + name + "'}}})"});
    });
    CHECK(message.find(name) != std::string::npos);
    CHECK(message.find("min_sine") != std::string::npos);
    CHECK(message.find("arrays of the tets: age") != std::string::npos);
  }
}

TEST_CASE("the sessions of solvers select by arrays that move with the mesh") {
  Improver session(aged_cube<double>(), {.script = kYoung});
  std::vector<std::array<double, 3>> points(session.mesh().points().begin(),
                                            session.mesh().points().end());
  for (auto& p : points) p[0] += 100;
  REQUIRE(session.move(points));
  const Mesh before = session.mesh();
  const ImproverStep step = session.improve();
  CHECK(step.accepted > 10);
  for (std::size_t t = 0; t < step.tet_map.size(); ++t) {
    if (step.tet_map[t] != kGone) continue;
    double least = 1000;
    for (const std::uint32_t v : before.tets()[t]) least = std::min(least, before.points()[v][0]);
    CHECK(least < 100 + kCellsAcross / 2.0 + 1);
  }
}
