// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/check.h>
#include <tetmend/improve.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "tests/support/mixed_mesh.h"

using namespace tetmend;

namespace {

const std::array<std::array<double, 3>, 5> kPoints = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};

Mesh two_tet_mesh(std::int32_t second_label = 0) {
  return Mesh({.points = {kPoints.begin(), kPoints.end()},
               .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
               .tet_labels = {0, second_label}});
}

const Fact& find(const std::vector<Fact>& facts, const std::string& name) {
  const auto found =
      std::find_if(facts.begin(), facts.end(), [&](const Fact& fact) { return fact.name == name; });
  REQUIRE(found != facts.end());
  return *found;
}

}  // namespace

TEST_CASE("thresholds hold or do not, with the value that was found") {
  const std::vector<Fact> facts =
      check(two_tet_mesh(), {.min_dihedral = 60, .measure = {{"mean_ratio", 0.1}}});
  REQUIRE(facts.size() == 2);
  CHECK_FALSE(find(facts, "theta_min").holds);
  CHECK(std::get<double>(find(facts, "theta_min").value) == doctest::Approx(54.7356));
  CHECK(std::get<double>(find(facts, "theta_min").wanted) == 60);
  CHECK(find(facts, "mean_ratio").holds);
}

TEST_CASE(
    "a tet that lists its vertices the other way round is inverted, whatever a run makes of it") {
  const Mesh mesh({.points = {kPoints.begin(), kPoints.begin() + 4}, .tets = {{1, 0, 2, 3}}});
  const Fact fact = find(check(mesh, {.no_inverted = true}), "inverted");
  CHECK_FALSE(fact.holds);
  CHECK(std::get<std::uint64_t>(fact.value) == 1);
}

TEST_CASE("unknown rulers, presets and thresholds out of range are errors about options") {
  CHECK_THROWS_WITH_AS(check(two_tet_mesh(), {.measure = {{"beauty", 1}}}),
                       doctest::Contains("measure: 'beauty' is no ruler"), OptionError);
  CHECK_THROWS_WITH_AS(check(two_tet_mesh(), {.preset = "solver"}),
                       doctest::Contains("for: 'solver' is no preset"), OptionError);
  CHECK_THROWS_AS(check(two_tet_mesh(), {.min_dihedral = 80}), OptionError);
}

TEST_CASE("two meshes are compared by surface, walls and volumes") {
  const Mesh mesh = two_tet_mesh(1);
  const auto all_hold = [](const std::vector<Fact>& facts) {
    return std::all_of(facts.begin(), facts.end(), [](const Fact& fact) { return fact.holds; });
  };
  CHECK(all_hold(compare(mesh, mesh)));
  const std::vector<Fact> facts = compare(mesh, two_tet_mesh(2));
  CHECK_FALSE(find(facts, "walls").holds);
  CHECK_FALSE(find(facts, "surface").holds);  // its triangles have labels of tets behind them
  CHECK(std::count_if(facts.begin(), facts.end(), [](const Fact& fact) {
          return fact.name == "volume" && !fact.holds;
        }) == 2);  // one label is gone, one is new
}

TEST_CASE("an inner point near a face makes explicit steps smaller and dearer than before") {
  const auto around = [](double inner) {
    std::vector<std::array<double, 3>> points(kPoints.begin(), kPoints.begin() + 4);
    points.push_back({inner, inner, inner});
    return Mesh(
        {.points = points, .tets = {{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}}});
  };
  const Mesh even = around(0.25), uneven = around(0.02);
  const std::vector<Fact> worse = compare(even, uneven, 1, "explicit");
  CHECK_FALSE(find(worse, "step").holds);
  CHECK_FALSE(find(worse, "explicit_cost").holds);
  CHECK(find(compare(uneven, even, 1, "explicit"), "step").holds);
  CHECK(find(compare(uneven, even, 1, "explicit"), "explicit_cost").holds);
  CHECK(find(compare(even, even, 1, "explicit"), "step").holds);
  const auto is_step = [](const Fact& fact) { return fact.name == "step"; };
  const std::vector<Fact> plain = compare(even, uneven, 1, "calculix");
  CHECK(std::none_of(plain.begin(), plain.end(), is_step));
  CHECK_THROWS_WITH_AS(compare(even, uneven, 1, "solver"),
                       doctest::Contains("for: 'solver' is no preset"), OptionError);
}

TEST_CASE("more tets for the same body are more work") {
  std::vector<std::array<double, 3>> points(kPoints.begin(), kPoints.begin() + 4);
  points.insert(points.end(), {{0.3, 0.2, 0.2}, {0.35, 0.3, 0.25}});
  const Mesh coarse({.points = {points.begin(), points.begin() + 5},
                     .tets = {{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}}});
  const Mesh fine({.points = points,
                   .tets = {{5, 1, 2, 3},
                            {4, 5, 2, 3},
                            {4, 1, 5, 3},
                            {4, 1, 2, 5},
                            {0, 4, 2, 3},
                            {0, 1, 4, 3},
                            {0, 1, 2, 4}}});
  CHECK_FALSE(find(compare(coarse, fine, 1, "implicit"), "work").holds);
  CHECK(find(compare(fine, coarse, 1, "implicit"), "work").holds);
}

TEST_CASE("a mesh alone fits a use unless few tets spoil it") {
  const Mesh good({.points = {kPoints.begin(), kPoints.begin() + 4}, .tets = {{0, 1, 2, 3}}});
  CHECK(find(check(good, {.preset = "explicit"}), "step_share").holds);
  CHECK(find(check(good, {.preset = "implicit"}), "condition_share").holds);
  const Mesh flat(
      {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}}, .tets = {{0, 1, 2, 3}}});
  CHECK_FALSE(find(check(flat, {.preset = "implicit"}), "condition_share").holds);
}

TEST_CASE("a tet that is folded over its neighbour is inverted however it is listed") {
  const auto folded = [](const std::array<std::uint32_t, 4>& second) {
    return Mesh({.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.2, 0.3}},
                 .tets = {{0, 1, 2, 3}, second}});
  };
  const Mesh positive = folded({0, 1, 2, 4});
  const Mesh negative = folded({0, 2, 1, 4});
  for (const Mesh* before : {&positive, &negative}) {
    for (const Mesh* after : {&positive, &negative}) {
      const std::vector<Fact> facts = compare(*before, *after);
      CHECK(find(facts, "inverted").holds);
      CHECK(find(facts, "volume").holds);
    }
  }
}

TEST_CASE("tets that were torn from other elements are told, and those that stayed joined") {
  const MeshData before = test::tets_on(test::Bed::wedges, 3, 1);
  const Mesh mesh = MeshAccess::make(before);
  const Fact joined = find(compare(mesh, mesh), "other_elements");
  CHECK(joined.holds);
  CHECK(joined.text ==
        "18 other elements, and 67 faces, edges and points that tets have in common with them: the "
        "same, bit for bit");
  MeshData torn = before;  // without a tet on the bed
  const auto at_bed = [&](const MeshData::Tet& tet) {
    return std::count_if(tet.vertices.begin(), tet.vertices.end(),
                         [&](std::uint32_t v) { return before.points[v].z() == 0.1; });
  };
  torn.tets.erase(std::find_if(torn.tets.begin(), torn.tets.end(),
                               [&](const MeshData::Tet& tet) { return at_bed(tet) == 3; }));
  const Fact fact = find(compare(mesh, MeshAccess::make(torn)), "other_elements");
  CHECK_FALSE(fact.holds);
  CHECK(std::get<std::uint64_t>(fact.value) > 0);
  MeshData moved = before;
  moved.points[0].z() -= 1e-6;  // of wedges alone
  CHECK_FALSE(find(compare(mesh, MeshAccess::make(moved)), "other_elements").holds);
}

TEST_CASE("groups that only one of two meshes has are gone, and not told as the same") {
  const auto with = [](std::vector<Group> groups) {
    return Mesh({.points = {kPoints.begin(), kPoints.end()},
                 .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
                 .tet_labels = {1, 2},
                 .groups = std::move(groups)});
  };
  const Mesh first = with({{3, 1, "left"}, {3, 2, "right"}});
  const std::vector<Fact> none = compare(first, with({}));
  CHECK_FALSE(find(none, "groups").holds);
  CHECK(find(none, "group_contents").text ==
        "triangles, edges and volumes of 0 named groups that both have, of 2: the same");
  CHECK(find(compare(first, first), "group_contents").text ==
        "triangles, edges and volumes of 2 named groups: the same");
}

namespace {

constexpr std::array<const char*, 5> kOfSurface = {"surface", "walls", "triangles",
                                                   "group_contents", "volume"};

/// Names of the facts about the surface that do not hold.
std::vector<std::string> moved_facts(const Mesh& before, const Mesh& after,
                                     std::string_view surface) {
  std::vector<std::string> failed;
  for (const Fact& fact : compare(before, after, 1, {}, {}, surface)) {
    const bool is_of_surface =
        std::find(kOfSurface.begin(), kOfSurface.end(), fact.name) != kOfSurface.end();
    if (is_of_surface && !fact.holds) failed.push_back(fact.name);
  }
  return failed;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a surface that moved is within the tolerance both ways, or it is told") {
  const Mesh mesh = two_tet_mesh(2);
  const auto with_corner = [&](double shift) {
    MeshData moved = MeshAccess::data(mesh);
    moved.points[4].x() += shift;
    return MeshAccess::make(moved);
  };
  CHECK(moved_facts(mesh, mesh, "flat").empty());
  const Mesh near = with_corner(0.005);
  CHECK(moved_facts(mesh, near, "") == Names{"surface", "volume"});
  CHECK(moved_facts(mesh, near, "flat") == Names{"surface", "volume"});
  CHECK(moved_facts(mesh, near, "0.004") == Names{"surface"});
  CHECK(moved_facts(mesh, near, "0.006").empty());
  CHECK(moved_facts(mesh, near, "1%").empty());
  // What was there has to be there still: here one of the tets is gone.
  const Mesh less(
      {.points = {kPoints.begin(), kPoints.end()}, .tets = {{0, 1, 2, 3}}, .tet_labels = {0}});
  const Mesh more({.points = {kPoints.begin(), kPoints.end()},
                   .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
                   .tet_labels = {0, 0}});
  CHECK(moved_facts(more, less, "1%") == Names{"surface", "volume"});
  CHECK_THROWS_WITH_AS(compare(mesh, near, 1, {}, {}, "far"),
                       doctest::Contains("surface: 'far' is none of fixed, flat"), OptionError);
}

TEST_CASE("what a run with a moving surface makes is within its tolerance, and of no smaller one") {
  MeshData data = contract::kuhn_cube(4, 0.35, 7);
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.tets[t].label = t % 6 < 3 ? 1 : 2;
  const Mesh before = MeshAccess::make(data);
  std::size_t moved = 0;
  for (const char* surface : {"flat", "1%", "10%", "50%", "0.02!"}) {
    CAPTURE(surface);
    Mesh after = before;
    const Result result = improve(after, {.schedule = "surface", .surface = surface});
    CHECK(moved_facts(before, after, surface).empty());
    REQUIRE(result.surface_change);
    if (result.surface_change->sampled < 1e-6) continue;
    ++moved;
    CHECK_FALSE(
        moved_facts(before, after, fmt::format("{}!", result.surface_change->sampled / 2)).empty());
    CHECK_FALSE(moved_facts(before, after, "").empty());
  }
  CHECK(moved > 1);
}
