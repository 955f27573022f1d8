// SPDX-License-Identifier: MIT
// adapt(): sizes in all their forms, what is refused, and what comes over.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/io.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;

namespace {

/// A cube of 6^3 cells, the half beyond x = 1/2 with label 2, with arrays of the points.
Mesh cube() {
  MeshData data = contract::kuhn_cube(6, 0.1, 1);
  DataArray h{"h", 1, std::vector<double>()};
  DataArray wrong{"wrong", 1, std::vector<double>(data.points.size(), -1.0)};
  for (const Point& p : data.points) {
    std::get<std::vector<double>>(h.values).push_back(0.06 + 0.1 * p.x());
  }
  for (MeshData::Tet& tet : data.tets) {
    double x = 0;
    for (const std::uint32_t v : tet.vertices) x += data.points[v].x() / 4;
    tet.label = x < 0.5 ? 1 : 2;
  }
  data.point_data = {h, wrong};
  return MeshAccess::make(std::move(data));
}

std::string option_of(const Options& options) {
  Mesh mesh = cube();
  try {
    adapt(mesh, options);
  } catch (const OptionError& error) {
    return error.option();
  }
  return {};
}

}  // namespace

TEST_CASE("sizes of each form bring most edges into their range, and the surface stays") {
  const std::vector<Options> all = {
      {.size = {"0.08"}},
      {.size = {"0.5x"}},
      {.size = {"array:h"}},
      {.size = {"1x", "label:2=0.08"}},
      {.size_at = [](double x, double, double) { return 0.06 + 0.1 * x; }}};
  for (const Options& options : all) {
    Mesh mesh = cube();
    const Result result = adapt(mesh, options);
    REQUIRE(result.sizes_after);
    CHECK(result.sizes_after->in_range > 0.8);
    CHECK(result.after.tets > result.before.tets);
    CHECK(result.surface_fingerprint == result.surface_fingerprint_before);
    CHECK(result.not_positive_after == 0);
    // Whoever wanted lengths is told what they cost.
    const bool is_told =
        std::any_of(result.notes.begin(), result.notes.end(),
                    [](const auto& note) { return note.starts_with("lengths come first"); });
    CHECK(is_told == (result.after.n_bad > 0));
  }
}

TEST_CASE("an array of lengths comes over to new points, linearly") {
  Mesh mesh = cube();
  adapt(mesh, {.size = {"array:h"}});
  const auto& data = MeshAccess::data(mesh);
  const auto& h = std::get<std::vector<double>>(data.point_data[0].values);
  REQUIRE(h.size() == data.points.size());
  double error = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    error = std::max(error, std::abs(h[i] - (0.06 + 0.1 * data.points[i].x())));
  }
  CHECK(error < 1e-9);
}

TEST_CASE(
    "sizes without sense are refused by the name of their option, and the mesh is as before") {
  CHECK(option_of({}) == "size");
  for (const std::string size : {"", "x", "0", "-1", "nan", "inf", "0.5y", "label:=1", "label:2",
                                 "label:a=1", "label:7=0.1", "array:", "array:none"}) {
    CAPTURE(size);
    CHECK(option_of({.size = {size}}) == "size");
  }
  CHECK(option_of({.size = {"0.1"}, .gradation = 0.5}) == "gradation");
  CHECK(option_of({.size = {"0.1"}, .smallest = -1}) == "smallest");
  CHECK(option_of({.size = {"0.1"}, .smallest = 2, .largest = 1}) == "largest");
  CHECK(option_of({.keep_size = true, .size = {"0.1"}}) == "keep_size");
  CHECK(option_of({.size = {"0.1"}, .size_at = [](double, double, double) { return 1.0; }}) ==
        "size_at");
  CHECK(option_of({.size_at = [](double, double, double) { return 1.0; }, .gradation = 1.2}) ==
        "gradation");
  Mesh mesh = cube();
  const std::size_t points = MeshAccess::data(mesh).points.size();
  CHECK_THROWS_AS(adapt(mesh, {.size = {"array:wrong"}}), Error);
  CHECK_THROWS_AS(adapt(mesh, {.size = {"not_there.sol"}}), Error);
  CHECK_THROWS_WITH_AS(adapt(mesh, {.size = {"0.00001x"}}),
                       doctest::Contains("a mesh has at most 1e+09"), OptionError);
  CHECK(MeshAccess::data(mesh).points.size() == points);
}

TEST_CASE("an array of another mesh is linear in the tets of that one, however coarse ours is") {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "ground.vtu";
  MeshData data = contract::kuhn_cube(8, 0, 1);
  DataArray h{"h", 1, std::vector<double>()};
  for (const Point& p : data.points) {
    std::get<std::vector<double>>(h.values).push_back(std::abs(p.x() - 0.5) < 0.2 ? 0.06 : 0.3);
  }
  data.point_data = {h};
  save(file, MeshAccess::make(data));
  Mesh coarse = MeshAccess::make(contract::kuhn_cube(1, 0, 1));
  const Result result =
      adapt(coarse, {.surface = "flat", .size = {file.string() + ":h"}, .gradation = 0});
  CHECK(result.sizes_after->in_range > 0.9);
  std::size_t in_the_middle = 0;
  const std::vector<Point>& points = MeshAccess::data(coarse).points;
  for (const Point& p : points) in_the_middle += std::abs(p.x() - 0.5) < 0.25 ? 1 : 0;
  CHECK(in_the_middle > 9 * points.size() / 10);
  Mesh within_a_region = cube();
  CHECK(adapt(within_a_region, {.size = {"0.1", "label:2=" + file.string() + ":h"}})
            .sizes_after->in_range > 0.8);
  for (const std::string& wrong :
       {std::string(":h"), std::string("ground:h"), file.string() + ":", file.string() + ":none"}) {
    CAPTURE(wrong);
    CHECK(option_of({.size = {wrong}}) == "size");
  }
  Mesh mesh = cube();
  CHECK_THROWS_AS(adapt(mesh, {.size = {"not_there.vtu:h"}}), Error);
}

TEST_CASE("sizes by a function of a script: as by one of the program, on any number of threads") {
  const test::TempFolder folder;
  const auto file_of = [&](const std::string& name, const std::string& text) {
    const std::filesystem::path file = folder / name;
    std::ofstream(file) << text;
    return file.string();
  };
  const std::string slope =
      file_of("slope.lua", "function size(x, y, z) return 0.06 + 0.1 * x end");
  Mesh by_program = cube();
  adapt(by_program, {.size_at = [](double x, double, double) { return 0.06 + 0.1 * x; }});
  for (const int threads : {1, 2}) {
    Mesh mesh = cube();
    adapt(mesh, {.threads = threads, .size = {slope}});
    CHECK(MeshAccess::data(mesh).tets == MeshAccess::data(by_program).tets);
    CHECK(MeshAccess::data(mesh).points == MeshAccess::data(by_program).points);
  }
  Mesh in_a_region = cube();
  CHECK(adapt(in_a_region, {.size = {"0.1", "label:2=" + slope}}).sizes_after->in_range > 0.8);

  const auto message_of = [](const std::string& size) -> std::string {
    Mesh mesh = cube();
    try {
      adapt(mesh, {.size = {size}});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  const std::string negative = file_of("negative.lua", "function size(x, y, z) return 0.5 - y end");
  CHECK(message_of(negative).starts_with(negative + ": "));
  CHECK(message_of(negative).ends_with("is no length"));
  CHECK(message_of("label:2=" + negative).find("expected a number above 0") != std::string::npos);
  const std::string loop = file_of("loop.lua", "function size(x, y, z)\n  while true do end\nend");
  CHECK(message_of(loop).starts_with(loop + ":2: a call does not come to an end, at ("));
  const std::string nearest =
      file_of("nearest.lua",
              "local knots = {}\n"
              "for i = 1, 100000 do knots[i] = i / 100000 end\n"
              "function size(x, y, z)\n"
              "  local least = 1\n"
              "  for i = 1, #knots do least = math.min(least, math.abs(x - knots[i])) end\n"
              "  return 2 + least\n"
              "end");
  Mesh one_cell = MeshAccess::make(contract::kuhn_cube(1, 0, 1));
  CHECK_NOTHROW(adapt(one_cell, {.size = {nearest}}));  // a large table makes each look dear
  const std::string wrong = file_of("wrong.lua", "\nfunction size(x, y, z) retrun 1 end");
  CHECK(message_of(wrong).find("wrong.lua:2: ") != std::string::npos);
  const std::string other = file_of("other.lua", "function length(x, y, z) return 1 end");
  CHECK(message_of(other).find("the script has no function size") != std::string::npos);
  CHECK(message_of((folder / "none.lua").string()).find("cannot read it") != std::string::npos);
}

TEST_CASE(
    "a regular lattice, none of whose vertices can go where another is, gets coarser and finer "
    "again") {
  Mesh mesh = MeshAccess::make(contract::kuhn_cube(12, 0, 1));
  const Result coarser = adapt(mesh, {.surface = "flat", .size = {"0.25"}});
  CHECK(coarser.after.tets < coarser.before.tets / 10);
  CHECK(coarser.sizes_after->in_range > 0.85);
  CHECK(coarser.after.theta_min > 15);
  const Result finer = adapt(mesh, {.surface = "flat", .size = {"0.1"}});
  CHECK(finer.after.tets > 10 * finer.before.tets);
  CHECK(finer.sizes_after->in_range > 0.95);
  CHECK(std::abs(finer.volume_change()) < 1e-9);
}

TEST_CASE("lengths stay within smallest and largest") {
  Mesh coarse = cube();
  Mesh fine = cube();
  const Result bounded = adapt(coarse, {.size = {"0.04"}, .smallest = 0.1});
  const Result free = adapt(fine, {.size = {"0.08"}});
  CHECK(bounded.after.tets < free.after.tets);
}
