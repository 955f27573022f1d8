// SPDX-License-Identifier: MIT
// Data, groups and parts come over to the improved mesh.
#include "face/carry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tetmend/improve.h>

#include "face/bodies.h"
#include "face/mesh_access.h"
#include "face/tet_locator.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/assets.h"
#include "tests/support/overlapping_mesh.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

double linear(const Point& p) {
  return 3 + 2 * p.x() - 5 * p.y() + 0.25 * p.z();
}

/// Two parts of the first label, by the side of a plane.
std::vector<Label> halves(const MeshData& data, double& middle) {
  Eigen::AlignedBox3d box;
  for (const Point& p : data.points) box.extend(p);
  middle = box.center().x();
  std::vector<Label> parts;
  for (const MeshData::Tet& tet : data.tets) {
    Point sum = Point::Zero();
    for (const std::uint32_t v : tet.vertices) sum += data.points[v];
    parts.push_back(sum.x() / 4 < middle ? 11 : 12);
  }
  return parts;
}

double volume_of(const MeshData& data, const MeshData::Tet& tet) {
  const Point& a = data.points[tet.vertices[0]];
  const Point b = data.points[tet.vertices[1]] - a;
  const Point c = data.points[tet.vertices[2]] - a;
  return std::abs(b.dot(c.cross(data.points[tet.vertices[3]] - a))) / 6;
}

std::map<Label, double> volume_of_parts(const MeshData& data) {
  std::map<Label, double> sums;
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    sums[data.tet_parts[t]] += volume_of(data, data.tets[t]);
  }
  return sums;
}

}  // namespace

TEST_CASE("a linear field is exact on the improved mesh, other data come from their old place") {
  MeshData before = read_mesh(asset("bracket.meshb"));
  std::vector<double> field;
  std::vector<std::int32_t> numbers;
  for (const Point& p : before.points) {
    field.push_back(linear(p));
    field.push_back(-2 * linear(p));
    numbers.push_back(static_cast<std::int32_t>(numbers.size()));
  }
  std::vector<double> height;
  for (const MeshData::Tet& tet : before.tets) height.push_back(before.points[tet.vertices[0]].z());
  before.point_data = {{"field", 2, field}, {"number", 1, numbers}};
  before.tet_data = {{"height", 1, height}};
  before.label_array = "mat_id";
  before.taken_point_numbers = {{1, 3}, {7, 9000}};
  before.taken_element_numbers = {{2, 70000}};
  Mesh mesh = MeshAccess::make(before);
  const Result result = improve(mesh);
  const MeshData& now = MeshAccess::data(mesh);
  REQUIRE(now.point_data.size() == 2);
  const auto& values = std::get<std::vector<double>>(now.point_data[0].values);
  REQUIRE(values.size() == 2 * now.points.size());
  double error = 0;
  for (std::size_t i = 0; i < now.points.size(); ++i) {
    const double truth = linear(now.points[i]);
    error = std::max(error, std::abs(values[2 * i] - truth) / std::max(1.0, std::abs(truth)));
    error =
        std::max(error, std::abs(values[2 * i + 1] + 2 * truth) / std::max(1.0, std::abs(truth)));
  }
  CHECK(error < 1e-12);
  REQUIRE(result.carried.size() == 3);
  CHECK(result.carried[0].name == "field");
  CHECK(result.carried[0].integral_error < 1e-12);
  CHECK(result.carried[2].on == "tets");
  CHECK(result.carried[2].integral_error < 0.01);
  CHECK(now.label_array == "mat_id");
  CHECK(now.taken_point_numbers == before.taken_point_numbers);
  CHECK(now.taken_element_numbers == before.taken_element_numbers);
  for (std::size_t t = 0; t < before.tets.size(); ++t) {
    const std::uint32_t to = result.tet_map[t];
    if (to == kGone) continue;
    const auto& v = before.tets[t].vertices;
    const bool stayed = std::all_of(v.begin(), v.end(), [&](std::uint32_t old) {
      return result.vertex_map[old] != kGone &&
             before.points[old] == now.points[result.vertex_map[old]];
    });
    if (!stayed) continue;
    const bool same = std::get<std::vector<double>>(now.tet_data[0].values)[to] == height[t];
    if (!same) CHECK(same);
  }
}

TEST_CASE("parts that labels do not tell apart keep their volumes, groups their members") {
  MeshData before = read_mesh(asset("bracket.meshb"));
  double middle = 0;
  before.tet_parts = halves(before, middle);
  before.groups = {
      {3, 1, "left", {11}, {}}, {3, 2, "all", {11, 12}, {}}, {0, 0, "corner", {}, {0}}};
  before.triangle_data = {{"order", 1, std::vector<std::int32_t>()}};
  auto& order = std::get<std::vector<std::int32_t>>(before.triangle_data[0].values);
  for (std::size_t i = 0; i < before.triangles.size(); ++i) order.push_back(static_cast<int>(i));
  Mesh mesh = MeshAccess::make(before);
  const Result result = improve(mesh);
  CHECK(result.after.n_bad < result.before.n_bad);
  const MeshData& now = MeshAccess::data(mesh);
  REQUIRE(now.tet_parts.size() == now.tets.size());
  const std::map<Label, double> then = volume_of_parts(before);
  const std::map<Label, double> after = volume_of_parts(now);
  for (const auto& [part, size] : then)
    CHECK(after.at(part) == doctest::Approx(size).epsilon(1e-12));
  REQUIRE(now.groups.size() == 3);
  CHECK(now.groups[2].members == std::vector<std::uint32_t>{result.vertex_map[0]});
  REQUIRE(now.triangles.size() == before.triangles.size());
  const auto& orders = std::get<std::vector<std::int32_t>>(now.triangle_data[0].values);
  for (std::size_t i = 0; i < now.triangles.size(); ++i) {
    auto old = before.triangles[static_cast<std::size_t>(orders[i])].vertices;
    for (std::uint32_t& v : old) v = result.vertex_map[v];
    auto made = now.triangles[i].vertices;
    std::sort(old.begin(), old.end());
    std::sort(made.begin(), made.end());
    if (old != made) CHECK(old == made);
  }
}

TEST_CASE("data and groups of a mesh of arrays come over, are saved, and come back") {
  const test::TempFolder folder;
  MeshArrays arrays =
      load(std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes/sheet.mesh").arrays();
  std::vector<float> field;
  for (const auto& p : arrays.points) field.push_back(static_cast<float>(1 + p[0]));
  std::vector<std::int64_t> order;
  for (std::size_t t = 0; t < arrays.tets.size(); ++t) order.push_back(std::int64_t{1} << 40 | t);
  arrays.point_data = {{"field", 1, field}};
  arrays.tet_data = {{"order", 1, order}};
  arrays.tet_parts.assign(arrays.tets.size(), 4);
  arrays.groups = {{.dimension = 3, .number = 9, .name = "all of it", .parts = {4}},
                   {.dimension = 0, .number = 2, .name = "corner", .members = {3}}};
  const std::array<double, 3> corner = arrays.points[3];
  Mesh mesh(std::move(arrays));
  const Result result = improve(mesh);
  CHECK(result.touched_tets > 0);
  REQUIRE(result.carried.size() == 2);
  for (const std::string file : {"a.vtu", "a.msh"}) {
    CAPTURE(file);
    save(folder / file, mesh);
    const Mesh again = load(folder / file);
    CHECK(again.tets().size() == mesh.tets().size());
    REQUIRE(again.point_data().size() == 1);
    CHECK(again.point_data()[0].name == "field");
    for (std::size_t i = 0; i < again.point_count(); ++i) {
      const double value = formats::real_value(again.point_data()[0], i);
      const bool is_linear = std::abs(value - 1 - again.points()[i][0]) < 1e-6;
      if (!is_linear) CHECK(value == 1 + again.points()[i][0]);
    }
    REQUIRE(again.tet_data().size() == 1);
    CHECK(again.tet_data()[0].name == "order");
  }
  const Mesh again = load(folder / "a.msh");
  std::size_t named = 0;  // labels become groups without a name
  for (const Group& group : again.groups()) {
    if (group.name.empty()) continue;
    ++named;
    CHECK(group.name == (group.dimension == 3 ? "all of it" : "corner"));
    if (group.dimension == 3) continue;
    REQUIRE(group.members.size() == 1);
    CHECK(again.points()[group.members[0]] == corner);
  }
  CHECK(named == 2);
}

TEST_CASE("data belong to the mesh that a run leaves which failed half-way") {
  MeshData before = read_mesh(asset("bracket.meshb"));
  std::vector<double> field;
  for (const Point& p : before.points) field.push_back(linear(p));
  before.point_data = {{"field", 1, field}};
  Mesh mesh = MeshAccess::make(before);
  CHECK_THROWS_AS(improve(mesh, {.script = "smooth{}\ninsert_points{}\nerror('enough')"}), Error);
  const MeshData& now = MeshAccess::data(mesh);
  CHECK(now.points.size() > before.points.size());
  REQUIRE(now.point_data.size() == 1);
  const auto& values = std::get<std::vector<double>>(now.point_data[0].values);
  REQUIRE(values.size() == now.points.size());
  for (std::size_t i = 0; i < values.size(); i += 97) {
    CHECK(values[i] == doctest::Approx(linear(now.points[i])).epsilon(1e-12));
  }
}

TEST_CASE("a flat tet gives a linear field to the last digits") {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-9}, {2, 2, 2}};
  data.tets = {{{0, 1, 2, 3}, 0}, {{0, 1, 2, 4}, 0}};
  const Point place(0.31, 0.29, 0.9e-9);
  const auto weights = face::weights_in(data, 0, place);
  Point sum = Point::Zero();
  for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * data.points[data.tets[0].vertices[k]];
  CHECK((sum - place).norm() < 1e-15);
  const face::Bodies bodies(data);
  const face::TetLocator locator(data, bodies, {0, 1});
  CHECK(locator.find({0.3, 0.3, 0.5e-9}).tet == 0);
  CHECK(locator.find({0.4, 0.4, 0.2}).tet == 1);
  CHECK(locator.find({5, 5, 5}).tet <= 1);
}

TEST_CASE("a place is found in the tet that holds it, among many") {
  const MeshData data = read_mesh(asset("bracket.meshb"));
  std::vector<std::uint32_t> all(data.tets.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  const face::Bodies bodies(data);
  const face::TetLocator locator(data, bodies, all);
  std::size_t wrong = 0;
  for (std::uint32_t t = 0; t < all.size(); t += 7) {
    Point place = Point::Zero();
    const std::array<double, 4> weights = {0.4, 0.3, 0.2, 0.1};
    for (std::size_t k = 0; k < 4; ++k) place += weights[k] * data.points[data.tets[t].vertices[k]];
    wrong += locator.find(place).tet == t ? 0 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("where solids overlap, each tet and point keeps to the values of its own") {
  for (const test::ToldBy told_by :
       {test::ToldBy::nothing, test::ToldBy::labels, test::ToldBy::parts}) {
    for (const bool conserves : {false, true}) {
      for (const char* surface : {"fixed", "10%"}) {
        CAPTURE(static_cast<int>(told_by));
        CAPTURE(conserves);
        CAPTURE(surface);
        Options options;
        options.surface = surface;
        if (conserves) options.conserve = {"young"};
        Mesh mesh = MeshAccess::make(test::two_overlapping(told_by));
        const Result result = improve(mesh, options);
        CHECK(result.touched_tets > 200);
        CHECK(test::count_strange_values(MeshAccess::data(mesh)) == 0);
      }
    }
  }
}

TEST_CASE("what hangs together at a vertex, of one label and part, is one body") {
  MeshData data = test::two_overlapping(test::ToldBy::nothing, 2);
  CHECK(face::Bodies(data).count() == 2);
  const std::size_t half = data.points.size() / 2;
  std::vector<std::uint32_t> found;
  const face::Bodies two(data);
  two.common(std::vector<std::uint32_t>{0}, 0, found);
  CHECK(found == std::vector<std::uint32_t>{0});
  two.common(std::vector<std::uint32_t>{0, static_cast<std::uint32_t>(half)}, 0, found);
  CHECK(found == std::vector<std::uint32_t>{0, 1});  // none has both
  for (MeshData::Tet& tet : data.tets) {
    for (std::uint32_t& v : tet.vertices) {
      if (v == half) v = 0;
    }
  }
  CHECK(face::Bodies(data).count() == 1);
  for (std::size_t t = 0; t < data.tets.size(); ++t) data.tet_parts.push_back(t % 2 == 0 ? 1 : 2);
  const face::Bodies parts(data);
  CHECK(parts.count() > 1);
  for (std::uint32_t t = 0; t + 1 < data.tets.size(); ++t) {
    const bool is_same = parts.of_tet(t) == parts.of_tet(t + 1);
    if (is_same) CHECK_FALSE(is_same);
  }
}

TEST_CASE("a new point finds an old one of its label through tets, however far") {
  const std::vector<MeshData::Tet> tets = {
      {{0, 1, 2, 3}, 5}, {{3, 4, 5, 6}, 5}, {{6, 7, 8, 9}, 5}, {{2, 10, 11, 12}, 6}};
  const std::vector<std::uint32_t> all = {0, 1, 2, 3};
  std::vector<std::uint32_t> anchors(13, face::Bodies::kNone);
  anchors[0] = 40;
  anchors[1] = 30;
  face::spread_anchors(
      tets, all, [](std::uint32_t point, Label) { return point != 30; }, anchors);
  CHECK(anchors == std::vector<std::uint32_t>{40, 30, face::Bodies::kNone, 40, 40, 40, 40, 40, 40,
                                              40, face::Bodies::kNone, face::Bodies::kNone,
                                              face::Bodies::kNone});
}
