// SPDX-License-Identifier: MIT
// The figures of a mesh.
#include <doctest/doctest.h>
#include <tetmend/measure.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/rulers.h"
#include "kernel/statistics.h"
#include "schedule/limit/surface_limit.h"
#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/turned_ring.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("a mesh is measured as the kernel does, and stays as it is") {
  const Mesh mesh = load(asset("sheet.mesh"));
  const TetMesh plain(read_mesh(asset("sheet.mesh")));
  const Measurement measured = measure(mesh, {.measure = {"radius_ratio"}, .limit = true});
  const MeshStatistics expected = compute_statistics(plain);
  CHECK(measured.statistics.tets == mesh.tet_count());
  CHECK(measured.statistics.theta_min == expected.theta_min);
  CHECK(measured.statistics.histogram == expected.histogram);
  REQUIRE(measured.measures.size() == 1);
  CHECK(measured.measures[0].name == "radius_ratio");
  CHECK(measured.measures[0].worst == summarize(plain, find_quality_measure("radius_ratio")).worst);
  REQUIRE(measured.rulers);
  CHECK((*measured.rulers)[Ruler::sicn].mean == measure_rulers(plain)[Ruler::sicn].mean);
  CHECK(!measure(mesh, {.rulers = false}).rulers);
  REQUIRE(measured.limit);
  CHECK(measured.limit->theta_max == compute_surface_limit(plain).theta_max);
  CHECK(measured.build.constrained_faces > 0);
  CHECK(!measure(mesh).limit);
}

TEST_CASE("bad tets are counted, listed and bounded by the goal that is asked for") {
  const Mesh mesh = load(asset("sheet.mesh"));
  const Goal goal = {10, 170};
  const Measurement measured = measure(mesh, {.goal = goal, .limit = true, .bad_tets = true});
  const std::size_t bad = measured.statistics.n_bad;
  CHECK(bad == compute_statistics(TetMesh(read_mesh(asset("sheet.mesh"))), goal).n_bad);
  CHECK(bad < measure(mesh).statistics.n_bad);
  CHECK(measured.bad_tets.size() == bad);
  CHECK(measured.limit->n_bad == bad);
  for (const BadTet& tet : measured.bad_tets) {
    CHECK((tet.theta_min < 10 || tet.theta_max > 170));
  }
  CHECK_THROWS_AS(measure(mesh, {.goal = {80, 90}}), OptionError);
}

TEST_CASE("a measure that is unknown is found out, and each that is listed is known") {
  CHECK_THROWS_AS(measure(Mesh(two_tet_arrays()), {.measure = {"beauty"}}), OptionError);
  CHECK(message_of([] { check(MeasureOptions{.measure = {"beauty"}}); }).starts_with("measure: "));
  std::vector<std::string> names;
  for (const Measure& each : measures()) names.emplace_back(each.name);
  CHECK(measure(Mesh(two_tet_arrays()), {.measure = names}).measures.size() == names.size());
}

TEST_CASE("broken topology is told with the line of the file, or the number in the arrays") {
  MeshArrays turned;
  for (const Point& p : turned_ring().points) turned.points.push_back({p.x(), p.y(), p.z()});
  for (const MeshData::Tet& tet : turned_ring().tets) turned.tets.push_back(tet.vertices);
  const Mesh mesh(turned);
  CHECK(
      message_of([&] { measure(mesh); }) ==
      "tet 5 (vertices 5 6 7 1) and tet 4 (vertices 4 5 6 7) lie on the same side of their common "
      "face, counted from 0");
  const TempFolder folder;
  save(folder / "a.mesh", mesh);
  CHECK(message_of([&] {
          measure(load(folder / "a.mesh"));
        }).starts_with((folder / "a.mesh").string() + ":20: tet 6 (vertices 6 7 8 2) and tet 5"));
  CHECK(message_of([] { measure(Mesh()); }) == "the mesh has no tetrahedra");
}
