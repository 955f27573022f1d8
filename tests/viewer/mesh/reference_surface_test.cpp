// SPDX-License-Identifier: MIT
#include "viewer/mesh/reference_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/viewer/session.h"
#include "trace/recorder.h"
#include "trace/surface_setting.h"
#include "viewer/overlay.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

constexpr double kLift = 0.1;

/// A unit cube with the middle of its upper side lifted, `size` times as large.
MeshData lifted_cube(double size = 1, double lift = kLift) {
  MeshData data = test::kuhn_cube(4, 0, 1);
  for (Point& p : data.points) {
    if (p == Point(0.5, 0.5, 1)) p.z() += lift;
    p *= size;
  }
  return data;
}

MeshData cube(double size = 1) {
  return lifted_cube(size, 0);
}

std::size_t triangles_of(const std::vector<SurfaceVertex>& triangles, const Colour& c) {
  return static_cast<std::size_t>(
             std::count_if(triangles.begin(), triangles.end(),
                           [&](const SurfaceVertex& v) { return v.colour == c; })) /
         3;
}

}  // namespace

TEST_CASE("a surface has no distance from itself, however its mesh is made") {
  const TetMesh mesh(cube());
  ReferenceSurface reference(mesh, {}, "cube");
  const SurfaceDeparture same = reference.measure(mesh);
  CHECK(same.triangles == 6 * 2 * 16);
  CHECK(same.others == 0);
  CHECK(same.most.distance == 0);
  // Other triangles of the same shape.
  const SurfaceDeparture finer = reference.measure(TetMesh(test::kuhn_cube(3, 0, 1)));
  CHECK(finer.others == 6 * 2 * 9);
  CHECK(finer.most.distance < 1e-15);
}

TEST_CASE(
    "what was moved is as far away as it was moved, in lengths of the file and in tolerances") {
  for (const double size : {1.0, 1e-60, 1e60}) {
    CAPTURE(size);
    ReferenceSurface of_length(TetMesh(cube(size)), {0, 0.2 * size}, "cube");
    const SurfaceDeparture moved = of_length.measure(TetMesh(lifted_cube(size)));
    CHECK(moved.others == 6);
    CHECK(moved.most.distance == doctest::Approx(kLift * size).epsilon(1e-12));
    CHECK(moved.most.share == doctest::Approx(0.5).epsilon(1e-12));
  }
  // 1 % of the mean edge (1 + 1 + sqrt 2) / 3 of a quarter; at most 1 % of the diagonal.
  ReferenceSurface of_share(TetMesh(cube()), {0.01, 0}, "cube");
  const double tolerance = 0.01 * (2 + std::sqrt(2.0)) / 12;
  CHECK(of_share.measure(TetMesh(lifted_cube(1, tolerance / 2))).most.share ==
        doctest::Approx(0.5).epsilon(1e-9));
}

TEST_CASE("the largest distance of a triangle may lie inside of it") {
  // The lifted side seen from the flat one: no corner of the cube's is off, but for the middle.
  ReferenceSurface reference(TetMesh(lifted_cube()), {}, "lifted");
  const SurfaceDeparture back = reference.measure(TetMesh(test::kuhn_cube(1, 0, 1)));
  CHECK(back.most.distance > 0.5 * kLift);
  CHECK(back.most.distance < kLift);
}

TEST_CASE("the other way, the reference tells how far it sticks out of the mesh") {
  for (const double size : {1.0, 1e-60, 1e60}) {
    CAPTURE(size);
    ReferenceSurface reference(TetMesh(lifted_cube(size)), {0, 0.2 * size}, "lifted");
    const TetMesh flat(cube(size));
    CHECK_FALSE(reference.measure(flat).back.has_value());
    const double one_way = reference.largest_seen().distance;
    CHECK(one_way < 0.95 * kLift * size);
    const SurfaceDeparture both = reference.measure(flat, true);
    REQUIRE(both.back.has_value());
    CHECK(both.most.distance == one_way);
    CHECK(both.back->distance == doctest::Approx(kLift * size).epsilon(1e-12));
    CHECK(both.back->share == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(reference.largest_seen().distance == both.back->distance);
    double largest = 0;
    for_each_surface_face(
        flat, [&](HalfFace f) { largest = std::max(largest, reference.of(flat, f).distance); });
    CHECK(largest == both.back->distance);
    reference.measure(flat);
    CHECK(reference.largest_seen().distance == one_way);
  }
  // What both have, corner for corner, is left out.
  ReferenceSurface same(TetMesh(cube()), {}, "cube");
  CHECK(same.measure(TetMesh(cube()), true).back->distance == 0);
  const TetMesh finer(test::kuhn_cube(3, 0, 1));
  CHECK(same.measure(finer, true).back->distance == 0);  // and what lies on the same planes
}

TEST_CASE("an allowance is a share or a length, or there is none") {
  CHECK(Allowance::parse("1%").share == 0.01);
  CHECK(Allowance::parse("0.25").length == 0.25);
  CHECK_FALSE(Allowance::parse("flat").is_known());
  for (const char* wrong : {"", "%", "0", "-1", "101%", "1x", "nan"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(Allowance::parse(wrong), Error);
  }
}

TEST_CASE("faces are coloured by distance, and the reference is a ghost") {
  const test::TempFolder folder;
  write_mesh(folder / "cube.mesh", cube());
  TestSession s(lifted_cube());
  s.run("reference", {(folder / "cube.mesh").string(), "0.2"});
  const Scene& scene = s.document.scene();
  const ColourMap& map = find_colour_map("ember");
  CHECK(triangles_of(scene.surface, map.at(0.5)) == 6);
  CHECK(triangles_of(scene.surface, kUnchangedColour) == 6 * 2 * 16 - 6);
  CHECK(scene.ghosts.size() / 3 == 6 * 2 * 16);
  CHECK(s.document.view.colour_bar);
  const auto state = s.run("state")["reference"];
  CHECK(state["distance"].get<double>() == doctest::Approx(kLift));
  CHECK(state["share_of_tolerance"].get<double>() == doctest::Approx(0.5));
  CHECK(state["changed"] == 6);
  CHECK(state["triangles"] == 6 * 2 * 16);

  s.run("reference");  // off
  CHECK(s.run("state")["reference"].is_null());
  CHECK(s.document.scene().ghosts.empty());
  s.run("reference");  // and on
  CHECK(s.run("state")["reference"]["changed"] == 6);

  // Where no tolerance is known the colours end at the largest distance.
  s.run("reference", {(folder / "cube.mesh").string()});
  CHECK(triangles_of(s.document.scene().surface, map.at(0)) == 6);
  // Inside there is no distance.
  s.run("cut", {1});
  CHECK(triangles_of(s.document.scene().surface, kInsideColour) == 2 * 16);
}

TEST_CASE("both ways, colours and words have the larger distance") {
  const test::TempFolder folder;
  write_mesh(folder / "lifted.mesh", lifted_cube());
  TestSession s(cube());
  s.run("reference", {(folder / "lifted.mesh").string(), "0.2"});
  const ColourMap& map = find_colour_map("ember");
  CHECK(triangles_of(s.document.scene().surface, map.at(0.5)) == 0);
  CHECK(s.run("state")["reference"].count("distance_back") == 0);
  CHECK(departure_in_words(s.document).size() == 3);

  s.run("view", {{{"both_ways", true}}});
  // The top of the lifted place is nearest to one of the faces around the middle.
  CHECK(triangles_of(s.document.scene().surface, map.at(0.5)) == 1);
  const auto state = s.run("state")["reference"];
  CHECK(state["distance_back"].get<double>() == doctest::Approx(kLift));
  CHECK(state["share_back"].get<double>() == doctest::Approx(0.5));
  CHECK(state["distance"].get<double>() < 0.95 * kLift);
  const auto lines = departure_in_words(s.document);
  REQUIRE(lines.size() == 5);
  CHECK(lines[2] == "from the reference at most 0.1");
  CHECK(lines[3] == "0.5 of the tolerance");
  s.run("view", {{{"both_ways", false}}});
  CHECK(triangles_of(s.document.scene().surface, map.at(0.5)) == 0);
}

TEST_CASE("colours by distance without a reference say that there is none") {
  TestSession s(cube());
  s.document.view.scene.colour = kDistance;
  CHECK(s.document.scene().note == "there is no reference surface to have a distance from");
  s.run("reference");
  CHECK(s.document.question == FileQuestion::reference);
  CHECK_THROWS_AS(s.run("reference", {"nowhere.mesh"}), Error);
  CHECK(s.document.reference() == nullptr);
}

TEST_CASE("a trace has its first surface for a reference, and the tolerance of its run") {
  const test::TempFolder folder;
  const TetMesh mesh(cube());
  TraceHeader header;
  header.settings = {{"rounds", "3"}, {kSurfaceSetting, "1%"}};
  TraceRecorder recorder(folder / "run.trace", mesh, header);
  recorder.finish();
  TestSession s(lifted_cube());
  s.document.open(folder / "run.trace");
  REQUIRE(s.document.reference() != nullptr);
  CHECK(s.document.reference()->allowance().share == 0.01);
  CHECK(s.document.departure().others == 0);
  s.document.open(folder / "run.trace");
  CHECK(s.document.reference() != nullptr);
  write_mesh(folder / "other.mesh", lifted_cube());
  s.document.open(folder / "other.mesh");
  CHECK(s.document.reference() == nullptr);
}
