// SPDX-License-Identifier: MIT
// What is drawn of a run, against its figures and against the mesh that comes out.
#include "face/portrait.h"

#include <map>
#include <memory>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "face/recorded.h"
#include "tests/face/meshes.h"

using namespace tetmend;
using tetmend::test::asset;

namespace {

struct Drawn {
  Mesh mesh;
  Result result;
  face::Portrait portrait;

  explicit Drawn(const Options& options, const std::string& name = "sheet.mesh")
      : mesh(load(asset(name))) {
    std::unique_ptr<TraceRecorder> trace;
    result = face::improve(mesh, options, trace, &portrait);
  }
};

}  // namespace

TEST_CASE("a portrait has the triangles and the bad tets that the figures count") {
  const Drawn drawn({.schedule = "table2", .limit = true}, "bracket.meshb");
  const face::Portrait& portrait = drawn.portrait;
  CHECK(portrait.triangles.size() == drawn.result.before.boundary_triangles);
  CHECK(portrait.bad_before.size() == drawn.result.before.n_bad);
  CHECK(portrait.bad_after.size() == drawn.result.after.n_bad);
  REQUIRE(portrait.bad_after.size() > 0);
  CHECK(portrait.are_reasons_known);
  for (const auto& triangle : portrait.triangles) {
    for (const std::uint32_t v : triangle) CHECK(v < portrait.points.size());
  }
  double volume = 0;  // by the divergence theorem: the triangles are seen from outside, and closed
  for (const auto& [a, b, c] : portrait.triangles) {
    volume += portrait.points[a].dot(portrait.points[b].cross(portrait.points[c])) / 6;
  }
  CHECK(volume == doctest::Approx(drawn.result.before.volume));
}

TEST_CASE("the bad tets left are those that measuring the mesh finds, in its order") {
  Drawn drawn({.schedule = "table2", .limit = true}, "bracket.meshb");
  const auto& left = drawn.portrait.bad_after;
  const std::vector<std::array<std::uint32_t, 4>> tets(drawn.mesh.tets().begin(),
                                                       drawn.mesh.tets().end());
  const std::vector<std::array<double, 3>> points(drawn.mesh.points().begin(),
                                                  drawn.mesh.points().end());
  const Measurement found = measure(std::move(drawn.mesh), {.bad_tets = true});
  REQUIRE(found.bad_tets.size() == left.size());
  std::map<std::size_t, const BadTet*> by_number;
  for (const BadTet& tet : found.bad_tets) by_number[tet.tet] = &tet;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const BadTet& facts = left[i].facts;
    REQUIRE(by_number.count(facts.tet) == 1);
    const BadTet& same = *by_number[facts.tet];
    CHECK(facts.theta_min == doctest::Approx(same.theta_min));
    CHECK(facts.theta_max == doctest::Approx(same.theta_max));
    CHECK(facts.hindrance == same.hindrance);
    CHECK(facts.label == same.label);
    CHECK(facts.number == same.number);
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& [x, y, z] = points[tets[facts.tet][c]];
      CHECK(left[i].corners[c] == Point(x, y, z));
    }
    if (i > 0) CHECK(left[i - 1].facts.quality <= facts.quality);
  }
}

TEST_CASE("a goal counts for the portrait as for the figures") {
  const Drawn drawn({.goal = {35, 140}, .limit = true});
  CHECK(drawn.portrait.bad_before.size() == drawn.result.before.n_bad);
  CHECK(drawn.portrait.bad_after.size() == drawn.result.after.n_bad);
}

TEST_CASE("an interrupted run is drawn, but its reasons are not known") {
  std::atomic<bool> cancel = true;
  const Drawn drawn({.limit = true, .cancel = &cancel});
  CHECK(drawn.result.ending == Ending::cancelled);
  CHECK(drawn.portrait.bad_after.size() == drawn.result.after.n_bad);
  CHECK(drawn.portrait.are_reasons_known == false);
  CHECK(drawn.portrait.rulers_after);
}

TEST_CASE("who asks for no portrait gets the same mesh") {
  Mesh plain = load(asset("sheet.mesh"));
  improve(plain);
  const Drawn drawn({});
  CHECK(plain.arrays().tets == drawn.mesh.arrays().tets);
  CHECK(plain.arrays().points == drawn.mesh.arrays().points);
}

TEST_CASE("who reads only what a run is judged by gets the same mesh and the same judgement") {
  const Drawn all({}, "two_materials.mesh");
  Mesh mesh = load(asset("two_materials.mesh"));
  std::unique_ptr<TraceRecorder> trace;
  const Result result = face::improve(mesh, {}, trace, nullptr, face::Figures::judging);
  CHECK(mesh.arrays().tets == all.mesh.arrays().tets);
  CHECK(mesh.arrays().points == all.mesh.arrays().points);
  CHECK(result.worse_than_before() == all.result.worse_than_before());
  REQUIRE((result.rulers_before && result.rulers_after));
  for (const Ruler ruler :
       {Ruler::mean_ratio, Ruler::radius_ratio, Ruler::edge_ratio, Ruler::step}) {
    CHECK((*result.rulers_after)[ruler].worst == (*all.result.rulers_after)[ruler].worst);
    CHECK((*result.rulers_after)[ruler].mean == (*all.result.rulers_after)[ruler].mean);
  }
  CHECK(result.rulers_after->faces_above_70 == all.result.rulers_after->faces_above_70);
  CHECK(all.result.size_drift);
  CHECK(!result.size_drift);
}
