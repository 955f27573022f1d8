// SPDX-License-Identifier: MIT
// Runs in which the surface may move: how far it does, what follows it, and what refuses.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/improve.h>

#include "face/carry.h"
#include "face/mesh_access.h"
#include "face/surface_points.h"
#include "kernel/geometry.h"
#include "kernel/shared_parts.h"
#include "kernel/tet_faces.h"
#include "tests/face/meshes.h"
#include "tests/support/mixed_mesh.h"
#include "tests/support/surface_distance.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Labels of both sides, the smaller first; outside is the smallest number.
using Sides = std::pair<Label, Label>;

std::map<Sides, std::vector<Triangle>> surfaces(const MeshData& data) {
  constexpr Label kOutside = std::numeric_limits<Label>::min();
  std::map<Sides, std::vector<Triangle>> all;
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    const Label here = data.tets[face.tet].label;
    const Label there = other == nullptr ? kOutside : data.tets[other->tet].label;
    if (here == there) return;
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = data.points[face.vertices[k]];
    all[std::minmax(here, there)].push_back(t);
  });
  return all;
}

/// Both ways, the largest of all pairs of labels.
double distance(const MeshData& a, const MeshData& b) {
  const auto from = surfaces(a);
  const auto to = surfaces(b);
  REQUIRE(from.size() == to.size());
  double most = 0;
  for (const auto& [sides, triangles] : from) {
    REQUIRE(to.contains(sides));
    most = std::max({most, sampled_distance(triangles, to.at(sides)),
                     sampled_distance(to.at(sides), triangles)});
  }
  return most;
}

double diagonal(const MeshData& data) {
  Eigen::AlignedBox3d box;
  for (const Point& p : data.points) box.extend(p);
  return box.diagonal().norm();
}

}  // namespace

TEST_CASE("a surface that may move leaves hardly more bad tets, and keeps to its tolerance") {
  for (const std::string name : {"folded_sheet.mesh", "two_materials.mesh"}) {
    CAPTURE(name);
    const Mesh input = load(asset(name));
    Mesh fixed = input;
    const Result without = improve(fixed);
    CHECK_FALSE(without.surface_change);
    for (const std::string surface : {"flat", "3%"}) {
      CAPTURE(surface);
      Mesh mesh = input;
      const Result result = improve(mesh, {.surface = surface});
      // One run is one sample: the last few tets go by luck.
      CHECK(result.after.n_bad <= without.after.n_bad + without.after.n_bad / 10);
      REQUIRE(result.surface_change);
      const SurfaceChange& change = *result.surface_change;
      const double off = distance(MeshAccess::data(input), MeshAccess::data(mesh));
      CHECK(off <= change.tolerance + 1e-12 * diagonal(MeshAccess::data(input)));
      CHECK(change.proven <= change.tolerance);
      CHECK((change.tolerance == 0) == (surface == "flat"));
      CHECK(change.triangles_before ==
            without.before.boundary_triangles + without.build.constrained_faces);
      if (surface != "flat") continue;
      CHECK(result.volume_change() < 1e-12);
      for (const SurfaceChange::Region& region : change.regions) {
        CHECK(region.area_after == doctest::Approx(region.area_before).epsilon(1e-12));
        CHECK(region.volume_after == doctest::Approx(region.volume_before).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a surface that moves leaves no angle worse than the fixed one does") {
  const Mesh input = load(asset("folded_sheet.mesh"));
  Options options;
  options.goal = Goal::symmetric(40);
  Mesh fixed = input;
  const Result without = improve(fixed, options);
  REQUIRE(without.after.theta_max > options.goal.max_angle);
  options.surface = "1%";
  Mesh mesh = input;
  const Result result = improve(mesh, options);
  CHECK(result.after.n_bad < without.after.n_bad);
  CHECK(result.after.theta_min >= without.after.theta_min - 1e-6);
  CHECK(result.after.theta_max <= without.after.theta_max + 1e-6);
}

TEST_CASE("with a surface that may move the number of threads does not show") {
  const Mesh input = load(asset("two_materials.mesh"));
  std::vector<Mesh> results;
  for (const int threads : {1, 3}) {
    results.push_back(input);
    improve(results.back(), {.threads = threads, .surface = "3%"});
  }
  CHECK(MeshAccess::data(results[0]).points == MeshAccess::data(results[1]).points);
  CHECK(MeshAccess::data(results[0]).tets == MeshAccess::data(results[1]).tets);
  CHECK(MeshAccess::data(results[0]).triangles == MeshAccess::data(results[1]).triangles);
}

TEST_CASE("'fixed' is the same as nothing, and a tolerance without sense is a mistake") {
  const Mesh input = load(asset("folded_sheet.mesh"));
  Mesh plain = input;
  Mesh fixed = input;
  improve(plain);
  improve(fixed, {.surface = "fixed"});
  CHECK(MeshAccess::data(plain).points == MeshAccess::data(fixed).points);
  CHECK(MeshAccess::data(plain).tets == MeshAccess::data(fixed).tets);
  for (const std::string wrong : {"round", "-1%", "0", "0%", "101%", "1 %", "%", "nan", "inf"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(check({.surface = wrong}), OptionError);
  }
  CHECK_THROWS_AS(check({.surface = "flat", .feature_angle = 0}), OptionError);
  CHECK_THROWS_AS(check({.surface = "flat", .feature_angle = 181}), OptionError);
}

TEST_CASE(
    "a length that is a large part of the mesh is a forgotten percent sign, unless it is meant") {
  const Mesh input = load(asset("folded_sheet.mesh"));
  Point low = MeshAccess::data(input).points.front();
  Point high = low;
  for (const Point& p : MeshAccess::data(input).points) {
    low = low.cwiseMin(p).eval();
    high = high.cwiseMax(p).eval();
  }
  const double diagonal = (high - low).norm();
  const auto complaint = [&](double length, const char* mark) -> std::string {
    Mesh mesh = input;
    try {
      improve(mesh, {.schedule = "conservative", .surface = fmt::format("{}{}", length, mark)});
    } catch (const OptionError& error) {
      CHECK(error.option() == "surface");
      CHECK(MeshAccess::data(mesh).points == MeshAccess::data(input).points);
      return error.what();
    }
    return "";
  };
  CHECK(complaint(0.049 * diagonal, "").empty());
  const std::string above = complaint(0.051 * diagonal, "");
  CHECK(above.find("is 5.1 % of the diagonal") != std::string::npos);
  CHECK(complaint(0.051 * diagonal, "!").empty());
  for (const std::string wrong : {"!", "1%!", "1!!", "flat!", "!1"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(check({.surface = wrong}), OptionError);
  }
  Mesh mesh = input;
  CHECK_THROWS_WITH_AS(improve(mesh, {.surface = "90"}), doctest::Contains("did you mean 90%?"),
                       OptionError);
}

TEST_CASE("tets that are protected keep their faces") {
  const Mesh input = load(asset("two_materials.mesh"));
  const MeshData before = MeshAccess::data(input);
  const Label label = before.tets[0].label;
  Mesh mesh = input;
  const Result result =
      improve(mesh, {.protect = {"label:" + std::to_string(label)}, .surface = "3%"});
  CHECK(result.protected_tets > 0);
  const MeshData after = MeshAccess::data(mesh);
  for (std::size_t t = 0; t < before.tets.size(); ++t) {
    if (before.tets[t].label != label) continue;
    REQUIRE(result.tet_map[t] != kGone);
    const auto& now = after.tets[result.tet_map[t]].vertices;
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(after.points[now[k]] == before.points[before.tets[t].vertices[k]]);
    }
  }
}

TEST_CASE("what a file says of triangles goes to the new ones near them") {
  MeshData before;
  before.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  before.tets = {{{0, 1, 2, 4}, 0}, {{0, 2, 3, 4}, 0}};
  before.triangles = {{{0, 1, 2}, 5}, {{0, 2, 3}, 5}, {{0, 1, 4}, 5}};
  before.triangle_parts = {21, 21, 22};
  before.triangle_numbers = {101, 102, 103};
  before.triangle_data = {{"load", 1, std::vector<double>{1, 2, 3}}};
  Group group;
  group.dimension = 2;
  group.members = {0, 1};
  before.groups = {group};
  const face::SurfaceMarks marks = face::mark_surface(before);
  CHECK(marks.triangles == std::vector<Label>{1, 1, 2});
  CHECK(marks.edges.empty());

  MeshData now;  // the diagonal of the square is the other one
  now.points = before.points;
  now.tets = {{{0, 1, 3, 4}, 0}, {{1, 2, 3, 4}, 0}};
  now.triangles = {{{0, 1, 3}, 1}, {{1, 2, 3}, 1}, {{0, 1, 4}, 2}};
  const std::vector<std::uint32_t> vertex_map = {0, 1, 2, 3, 4};
  const std::vector<std::uint32_t> tet_map = {kGone, kGone};
  face::carry(before, vertex_map, tet_map, {}, now, &marks);
  REQUIRE(now.triangles.size() == 3);
  for (const MeshData::Triangle& triangle : now.triangles) CHECK(triangle.label == 5);
  CHECK(now.triangle_parts == std::vector<Label>{21, 21, 22});
  CHECK(now.triangle_numbers == std::vector<std::int64_t>{0, 0, 103});
  CHECK(now.groups[0].members == std::vector<std::uint32_t>{0, 1});
  const auto& load = std::get<std::vector<double>>(now.triangle_data[0].values);
  CHECK(load[2] == 3);
  CHECK(load[0] != 3);
}

TEST_CASE("a new point of the surface has the label that the ends of its edge share") {
  MeshData before;
  before.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  before.point_labels = {5, 5, 7, 5, 9};
  before.tets = {{{0, 1, 2, 4}, 0}, {{0, 2, 3, 4}, 0}};
  MeshData now;  // a point on the edge 0 1, one on 1 2, one inside the face 0 1 2, one inside all
  now.points = before.points;
  now.points.insert(now.points.end(),
                    {{0.4, 0, 0}, {1, 0.4, 0}, {0.6, 0.3, 0}, {0.6, 0.3, 0.2}, {0.2, 0.6, 0}});
  now.point_labels = {5, 5, 7, 5, 9, 0, 0, 0, 0, 0};
  const std::vector<std::uint32_t> vertex_map = {0, 1, 2, 3, 4};
  // Each of the new ones but the fourth has a face of the boundary.
  now.tets = {{{0, 5, 8, 4}, 0}, {{1, 6, 8, 4}, 0}, {{0, 7, 8, 4}, 0}, {{0, 9, 3, 4}, 0}};
  face::label_surface_points(before, vertex_map, now);
  CHECK(now.point_labels[5] == 5);
  CHECK(now.point_labels[6] == 0);  // 5 and 7
  CHECK(now.point_labels[7] == 0);  // 5, 5 and 7
  CHECK(now.point_labels[9] == 0);  // 5, 7 and 5
  before.point_labels[2] = 5;
  face::label_surface_points(before, vertex_map, now);
  for (const std::size_t v : {5, 6, 7, 9}) CHECK(now.point_labels[v] == 5);
  now.point_labels.clear();
  before.point_labels.clear();
  face::label_surface_points(before, vertex_map, now);
  CHECK(now.point_labels.empty());
}

TEST_CASE("tets stay joined to other elements, by face, edge and point, whatever may move") {
  std::size_t touched = 0;
  for (const Bed bed : {Bed::wedges, Bed::pyramids, Bed::hexahedra, Bed::quads}) {
    for (const char* schedule : {"shell", "surface"}) {
      for (const char* surface : {"flat", "10%"}) {
        CAPTURE(static_cast<int>(bed));
        CAPTURE(schedule);
        CAPTURE(surface);
        const MeshData before = tets_on(bed, 4, 7);
        Mesh mesh = MeshAccess::make(before);
        const Result result = improve(mesh, {.schedule = schedule,
                                             .goal = {.min_angle = 40, .max_angle = 130},
                                             .surface = surface});
        const MeshData& now = MeshAccess::data(mesh);
        touched += result.surface_change->touched;
        CHECK(now.other_elements.size() == 1);
        auto faces = faces_on_bed(before);
        for (auto& face : faces) {
          for (std::uint32_t& v : face) v = result.vertex_map[v];
          std::sort(face.begin(), face.end());
        }
        std::sort(faces.begin(), faces.end());
        CHECK(faces_on_bed(now) == faces);
        CHECK(count_lost_parts(before, result.vertex_map, now) == 0);
      }
    }
  }
  CHECK(touched > 100);
}

TEST_CASE("triangles and edges that a file requires stay where the surface may move") {
  for (const int dimension : {1, 2}) {
    CAPTURE(dimension);
    MeshData before = tets_on(Bed::wedges, 4, 7);
    before.other_elements.clear();
    Group group;
    group.dimension = dimension;
    group.name = dimension == 1 ? "RequiredEdges" : "RequiredTriangles";
    for (const auto& face : faces_on_bed(before)) {
      group.members.push_back(static_cast<std::uint32_t>(group.members.size()));
      before.triangles.push_back({face, 0});
      before.edges.push_back({{face[0], face[1]}, 0});
    }
    before.groups = {group};
    Mesh mesh = MeshAccess::make(before);
    const Result result = improve(
        mesh,
        {.schedule = "surface", .goal = {.min_angle = 40, .max_angle = 130}, .surface = "10%"});
    const MeshData& now = MeshAccess::data(mesh);
    const auto is_there = [&](auto vertices, const auto& elements) {
      for (std::uint32_t& v : vertices) v = result.vertex_map[v];
      std::sort(vertices.begin(), vertices.end());
      return std::any_of(elements.begin(), elements.end(), [&](const auto& element) {
        auto others = element.vertices;
        std::sort(others.begin(), others.end());
        return others == vertices;
      });
    };
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      if (dimension == 2) CHECK(is_there(before.triangles[i].vertices, now.triangles));
      if (dimension == 1) CHECK(is_there(before.edges[i].vertices, now.edges));
    }
  }
}

TEST_CASE(
    "shells, chains and points of other elements within the tets stay, also without constraints") {
  for (const bool ignores : {false, true}) {
    CAPTURE(ignores);
    MeshData before = tets_on(Bed::wedges, 4, 7);
    const auto inner = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
      return (k * 5 + j) * 5 + i;
    };
    OtherElements shell;
    shell.vtk_type = 9;
    shell.vertex_count = 4;
    shell.vertices = {inner(1, 1, 3), inner(2, 1, 3), inner(2, 2, 3), inner(1, 2, 3)};
    shell.labels = {0};
    OtherElements point;
    point.vtk_type = 1;
    point.vertex_count = 1;
    point.vertices = {inner(3, 3, 3)};
    point.labels = {0};
    before.other_elements.push_back(shell);
    before.other_elements.push_back(point);
    Mesh mesh = MeshAccess::make(before);
    const Result result = improve(mesh, {.ignore_interior = ignores});
    CHECK(result.touched_tets > 0);
    const MeshData& now = MeshAccess::data(mesh);
    CHECK(count_lost_parts(before, result.vertex_map, now) == 0);
    CHECK(now.required_vertices.empty());
    CHECK(now.edges.empty());
    CHECK(now.triangles.empty());
  }
}
