// SPDX-License-Identifier: MIT
// Meshes of any size: what they are worked with as, and that files get their digits back.
#include "kernel/scale.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/rulers.h"
#include "kernel/statistics.h"
#include "kernel/surface_fingerprint.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

MeshData scaled(MeshData data, int exponent) {
  for (Point& p : data.points) {
    for (double& x : p) x = std::ldexp(x, exponent);
  }
  return data;
}

std::string building_error(const MeshData& data) {
  try {
    TetMesh mesh(data);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("boxes from a millionth to a million million wide are worked with as they are") {
  for (const int exponent : {-20, -3, 0, 39}) {
    const std::vector<Point> points = {{1, 2, 3}, {1 + std::ldexp(1.0, exponent), 2, 3}};
    CHECK(Scale::of(points).is_one());
  }
  CHECK(Scale::of({}).is_one());
  CHECK(Scale::of(std::vector<Point>{{1e300, 0, 0}}).is_one());
}

TEST_CASE("other boxes become from a half to one wide") {
  for (const int exponent : {-530, -21, 40, 531}) {
    CAPTURE(exponent);
    const std::vector<Point> points = {{0, 0, 0}, {0, std::ldexp(1.25, exponent), 0}};
    const Scale scale = Scale::of(points);
    CHECK(scale.to_work(points[1].y()) == 0.625);
    CHECK(scale.to_file(0.625) == points[1].y());
    CHECK(scale.exponent() == exponent + 1);
  }
}

TEST_CASE("a mesh multiplied by a power of two is the same to all but its file") {
  const MeshData data = zoo_data("ball_60");
  const TetMesh plain = make_mesh(data);
  const MeshStatistics expected = compute_statistics(plain);
  const MeshRulers rulers = measure_rulers(plain);
  for (const int exponent : {-500, -60, 60, 500}) {
    CAPTURE(exponent);
    const MeshData input = scaled(data, exponent);
    const TetMesh mesh = make_mesh(input);
    for (const TetHandle t : live_tets(mesh)) REQUIRE(mesh.quality(t) == plain.quality(t));
    CHECK(mesh.to_data().points == input.points);
    CHECK(TetMesh(mesh).to_data().tets == input.tets);
    CHECK(surface_fingerprint(mesh) != surface_fingerprint(plain));

    const MeshStatistics found = compute_statistics(mesh);
    CHECK(found.theta_min == expected.theta_min);
    CHECK(found.n_bad == expected.n_bad);
    CHECK(found.q_mean == expected.q_mean);
    CHECK(found.scaled_volume != 0);
    CHECK(found.volume == std::ldexp(expected.volume, 3 * exponent));
    const double shortest = measure_rulers(mesh).shortest_edge;
    CHECK(shortest == std::ldexp(rulers.shortest_edge, exponent));
    CHECK(measure_rulers(mesh)[Ruler::least_altitude].worst ==
          std::ldexp(rulers[Ruler::least_altitude].worst, exponent));
    CHECK(measure_rulers(mesh)[Ruler::step].worst ==
          std::ldexp(rulers[Ruler::step].worst, exponent));
    CHECK(measure_rulers(mesh).work == doctest::Approx(rulers.work));
  }
}

TEST_CASE("a volume that no double holds is written out all the same") {
  CHECK(volume_text(0.75, 0, 6) == "0.75");
  CHECK(volume_text(0.75, 10, 6) == "8.05306e+08");
  CHECK(volume_text(0.75, 500, 6) == "2.6306e+451");
  CHECK(volume_text(-0.75, -500, 3) == "-2.14e-452");
}

TEST_CASE("meshes that are too small, too large or both are refused with a reason") {
  const MeshData data = zoo_data("ball_20");
  CHECK(building_error(data).empty());
  CHECK(building_error(scaled(data, 700)).find("too large: its width must be from") !=
        std::string::npos);
  CHECK(building_error(scaled(data, -700)).find("too small") != std::string::npos);
  CHECK(building_error(scaled(data, -1060)).find("too small") != std::string::npos);

  MeshData mixed = scaled(data, 500);
  mixed.points.push_back({1e-300, 0, 0});
  CHECK(building_error(mixed).find("coordinates from 1e-300 to ") != std::string::npos);
  MeshData denormal = scaled(data, -500);
  denormal.points.push_back({5e-324, 0, 0});
  CHECK(building_error(denormal).find("too far apart") != std::string::npos);
}

TEST_CASE("a coordinate that all points share must fit as well") {
  MeshData flat = scaled(one_tet(), -332);
  for (Point& p : flat.points) p.x() = 1e300;
  CHECK(building_error(flat).find("too far apart") != std::string::npos);
}

TEST_CASE("noise beside zero is no reason to refuse a mesh of ordinary size") {
  MeshData data = zoo_data("ball_20");
  data.points[0].x() = 5e-324;
  data.points[1].y() = -1e-200;
  CHECK(building_error(data).empty());
  CHECK(make_mesh(data).to_data().points == data.points);
}

TEST_CASE("a tet that is too short for the mesh around it is named") {
  MeshData data = one_tet();
  MeshData small = scaled(one_tet(), -100);
  data.points.insert(data.points.end(), small.points.begin(), small.points.end());
  data.tets.push_back({{4, 5, 6, 7}, 9});
  for (const int exponent : {0, 400}) {
    const MeshData input = scaled(data, exponent);
    MeshData given = input;
    std::string message;
    try {
      TetMesh::build(given, {});
    } catch (const BuildError& error) {
      message = error.what();
      CHECK(error.tet() == 1);
    }
    CHECK(message.starts_with("tet 2 (vertices 5 6 7 8): shorter than"));
    CHECK(given.points == input.points);
    CHECK(given.tets == input.tets);
  }
}

TEST_CASE("a tiny tet that is flat is kept, for its quality is that of a flat one") {
  MeshData data = one_tet();
  for (const double x : {0.0, 1e-30, 2e-30, 3e-30}) data.points.push_back({x, x, x});
  data.tets.push_back({{4, 5, 6, 7}});
  BuildReport report;
  const TetMesh mesh(data, &report);
  CHECK(report.flat_tets == 1);
  CHECK(compute_statistics(mesh).q_worst == 0);
}
