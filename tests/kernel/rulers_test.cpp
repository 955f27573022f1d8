// SPDX-License-Identifier: MIT
// Rulers against closed forms, against what Gmsh and VTK say, and against the definitions literally.
#include "kernel/rulers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "kernel/chunks.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/quality.h"
#include "tests/support/tets.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;
using tetmend::test::on_threads;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The values of one ruler for all tets or faces, as the definitions have them.
using RulerValues = std::array<std::vector<double>, kRulerCount>;

void add_tet(const std::array<Point, 4>& p, RulerValues& values) {
  const double v6 = volume6(p[0], p[1], p[2], p[3]);
  double longest = 0;
  double shortest = kInfinity;
  double squares = 0;
  std::array<double, 6> l{};
  for (std::size_t e = 0; e < 6; ++e) {
    l[e] = (p[kEdgeVertices[e][1]] - p[kEdgeVertices[e][0]]).norm();
    longest = std::max(longest, l[e]);
    shortest = std::min(shortest, l[e]);
    squares += l[e] * l[e];
  }
  double area2 = 0;
  double largest = 0;
  for (const auto& [i, j, k] : kFaceVertices) {
    const double face = (p[j] - p[i]).cross(p[k] - p[i]).norm();
    area2 += face;
    largest = std::max(largest, face);
  }
  // The map from the regular tet of edge 1, whose edges are the columns of `regular`.
  Eigen::Matrix3d edges;
  Eigen::Matrix3d regular;
  edges << p[1] - p[0], p[2] - p[0], p[3] - p[0];
  regular << 1, 0.5, 0.5, 0, std::sqrt(3.0) / 2, std::sqrt(3.0) / 6, 0, 0, std::sqrt(2.0 / 3);
  const Eigen::Matrix3d map = edges * regular.inverse();
  const double condition = map.norm() * map.inverse().norm() / 3;
  double sige = 0;  // over pairs of opposite edges, then the other edges
  for (std::size_t e = 0; e < 3; ++e) {
    for (std::size_t k = 0; k < 6; ++k) {
      if (k != e && k != 5 - e) sige += std::numbers::sqrt2 * v6 / (12 * l[e] * l[5 - e] * l[k]);
    }
  }
  const auto add = [&](Ruler ruler, double value) {
    values[static_cast<std::size_t>(ruler)].push_back(value);
  };
  add(Ruler::mean_ratio, mean_ratio(p[0], p[1], p[2], p[3]));
  add(Ruler::radius_ratio, radius_ratio(p[0], p[1], p[2], p[3]));
  add(Ruler::sicn, (v6 > 0 ? 1 : -1) / condition);
  add(Ruler::sige, sige);
  add(Ruler::condition, v6 > 0 ? condition : kInfinity);
  add(Ruler::aspect_ratio, v6 > 0 ? longest * area2 / (2 * std::sqrt(6.0) * v6) : kInfinity);
  add(Ruler::edge_ratio, longest / shortest);
  add(Ruler::least_altitude, v6 / largest);
}

/// As the source of OpenFOAM's checkMesh has it.
double skewness(const std::array<Point, 3>& face, const Point& here, const Point* there) {
  const Point centre = (face[0] + face[1] + face[2]) / 3;
  const Point normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
  const Point to_face = centre - here;
  const Point d = there != nullptr ? Point(*there - here) : Point(normal * normal.dot(to_face));
  const Point skew = to_face - normal.dot(to_face) / normal.dot(d) * d;
  double extent = (there != nullptr ? 0.2 : 0.4) * d.norm();
  for (const Point& p : face) {
    if (skew.norm() > 0) {
      extent = std::max(extent, std::abs(skew.normalized().dot(p - centre)));
    }
  }
  return skew.norm() / extent;
}

std::array<Point, 4> corner_points(const TetMesh& mesh, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  return {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])};
}

Point tet_centroid(const TetMesh& mesh, TetHandle t) {
  const auto p = corner_points(mesh, t);
  return (p[0] + p[1] + p[2] + p[3]) / 4;
}

/// sqrt(m / k) of each vertex, from heights: |grad phi_i| is the inverse of one.
std::vector<double> direct_steps(const TetMesh& mesh) {
  std::vector<double> mass(mesh.vertex_slots()), stiffness(mesh.vertex_slots());
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    const auto p = corner_points(mesh, t);
    const double volume = volume6(p[0], p[1], p[2], p[3]) / 6;
    for (unsigned f = 0; f < 4; ++f) {
      const auto& [i, j, k] = kFaceVertices[f];
      const double height = 6 * volume / (p[j] - p[i]).cross(p[k] - p[i]).norm();
      const std::size_t v = mesh.vertices(t)[f].index();
      mass[v] += volume / 4;
      stiffness[v] += volume / (height * height);
    }
  }
  std::vector<double> steps;
  for (std::size_t v = 0; v < mass.size(); ++v) {
    if (mass[v] > 0) steps.push_back(std::sqrt(mass[v] / stiffness[v]));
  }
  return steps;
}

/// Of non_orthogonality the cosines.
RulerValues direct_values(const TetMesh& mesh) {
  RulerValues values;
  values[10] = direct_steps(mesh);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    const auto p = corner_points(mesh, t);
    add_tet(p, values);
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh.twin(HalfFace(t, f));
      if (!twin.is_outside() && twin.tet() < t) continue;
      const auto& [i, j, k] = kFaceVertices[f];
      const std::array<Point, 3> face = {p[i], p[j], p[k]};
      const Point here = tet_centroid(mesh, t);
      const Point there = twin.is_outside() ? here : tet_centroid(mesh, twin.tet());
      values[9].push_back(skewness(face, here, twin.is_outside() ? nullptr : &there));
      if (twin.is_outside()) continue;
      const Point normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
      values[8].push_back(normal.dot((there - here).normalized()));
    }
  }
  return values;
}

MeshRulers direct_rulers(const TetMesh& mesh) {
  RulerValues values = direct_values(mesh);
  MeshRulers rulers;
  rulers.inner_faces = values[8].size();
  for (const double cosine : values[8]) {
    rulers.faces_above_70 += std::acos(cosine) * 180 / std::numbers::pi > 70 ? 1 : 0;
  }
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    std::vector<double>& of = values[r];
    if (of.empty()) continue;
    std::sort(of.begin(), of.end());
    if (!kRulers[r].large_is_good && r != 8) std::reverse(of.begin(), of.end());
    double sum = 0;
    for (const double value : of) sum += value;
    const double count = static_cast<double>(of.size());
    rulers.figures[r] = {of.front(), of[static_cast<std::size_t>(std::ceil(count / 100)) - 1],
                         sum / count};
  }
  for (double* cosine :
       {&rulers.figures[8].worst, &rulers.figures[8].one_percent, &rulers.figures[8].mean}) {
    *cosine = std::acos(*cosine) * 180 / std::numbers::pi;
  }
  if (values[8].empty()) rulers.figures[8] = {};
  return rulers;
}

void check_figures(const RulerFigures& figures, const RulerFigures& expected, double epsilon) {
  CHECK(figures.worst == doctest::Approx(expected.worst).epsilon(epsilon).scale(0));
  CHECK(figures.one_percent == doctest::Approx(expected.one_percent).epsilon(epsilon).scale(0));
  CHECK(figures.mean == doctest::Approx(expected.mean).epsilon(epsilon).scale(0));
}

void check_directly(const TetMesh& mesh) {
  const MeshRulers rulers = measure_rulers(mesh);
  const MeshRulers expected = direct_rulers(mesh);
  CHECK(rulers.inner_faces == expected.inner_faces);
  CHECK(rulers.faces_above_70 == expected.faces_above_70);
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    CAPTURE(kRulers[r].name);
    check_figures(rulers.figures[r], expected.figures[r], 1e-9);
  }
}

void check_single(const MeshData& data, const std::array<double, 8>& expected) {
  const MeshRulers rulers = measure_rulers(TetMesh(data));
  for (std::size_t r = 0; r < expected.size(); ++r) {
    CAPTURE(kRulers[r].name);
    check_figures(rulers.figures[r], {expected[r], expected[r], expected[r]}, 1e-13);
  }
}

}  // namespace

TEST_CASE("a regular tet is best by all rulers, and as high as sqrt(2/3) of its edge") {
  const MeshData regular =
      single_tet(Point(1, 1, 1), Point(-1, 1, -1), Point(1, -1, -1), Point(-1, -1, 1));
  check_single(regular, {1, 1, 1, 1, 1, 1, 1, 4 / std::sqrt(3.0)});
  const MeshRulers rulers = measure_rulers(TetMesh(regular));
  CHECK(rulers.inner_faces == 0);
  CHECK(rulers[Ruler::non_orthogonality].worst == 0);
  CHECK(rulers[Ruler::skewness].worst < 1e-12);
}

TEST_CASE("the rulers of a right corner have their closed forms") {
  const double root2 = std::numbers::sqrt2;
  const double root3 = std::numbers::sqrt3;
  check_single(single_tet(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)),
               {12 * std::pow(0.5, 2.0 / 3) / 9, root3 - 1, root2 / root3, (2 + root2) / 4,
                root3 / root2, (1 + root3) / 2, root2, 1 / root3});
}

TEST_CASE("an uneven tet has the values that Gmsh 4.8 and VTK 9.1 give it") {
  // In the order of Ruler: VTK, VTK, Gmsh, Gmsh, VTK, VTK, VTK; the altitude is 3 V / largest face.
  check_single(single_tet(Point(0, 0, 0), Point(2, 0.125, 0), Point(0.25, 1.5, 0.25),
                          Point(0.5, 0.625, 0.75)),
               {0.6995269110934628, 0.5858289819564164, 1 / 1.4633821515731027, 0.7679757933891125,
                1.4633821515731027, 1.854411750057645, 2.1568898704021673, 0.640938234721795});
}

TEST_CASE("a shipped mesh has the figures that Gmsh 4.8 and VTK 9.1 give it") {
  const TetMesh mesh(read_mesh(std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes" /
                               "two_materials.mesh"));
  const MeshRulers rulers = measure_rulers(mesh);
  const auto check = [&](Ruler ruler, const RulerFigures& expected, double epsilon) {
    CAPTURE(kRulers[static_cast<std::size_t>(ruler)].name);
    check_figures(rulers[ruler], expected, epsilon);
  };
  constexpr double kAll = 1e-12;
  constexpr double kSix = 1e-5;  // digits that Gmsh writes
  check(Ruler::mean_ratio, {0.0614281925996834, 0.284329014880372, 0.777141029116439}, kAll);
  check(Ruler::radius_ratio, {0.0193925664161626, 0.167985580265881, 0.733474953864652}, kAll);
  check(Ruler::radius_ratio, {0.0193926, 0.167986, 0.733474950}, kSix);
  check(Ruler::sicn, {0.0193835, 0.179081, 0.768720410}, kSix);
  check(Ruler::sige, {0.0202522352443279, 0.178428207538914, 0.802297851079496}, kAll);
  check(Ruler::condition, {51.5903875417188, 5.58407230076575, 1.49174230668447}, kAll);
  check(Ruler::aspect_ratio, {63.11226178489, 6.99291703007627, 1.83382473067498}, kAll);
  check(Ruler::edge_ratio, {2.75641229007977, 2.52475424326612, 1.74786283674908}, kAll);
}

TEST_CASE(
    "an inner face crossed at 45 degrees, off its centroid, has the angle and skewness for it") {
  MeshData data;
  data.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(2, 0, 1), Point(0, 0, -1)};
  data.tets = {{{0, 1, 2, 3}}, {{0, 2, 1, 4}}};
  const TetMesh mesh(data);
  const MeshRulers rulers = measure_rulers(mesh);
  CHECK(rulers.inner_faces == 1);
  check_figures(rulers[Ruler::non_orthogonality], {45, 45, 45}, 1e-13);
  // The line crosses the face at (1/2, 1/4), the centroid is (1/3, 1/3): sqrt(5) / 12 apart. The
  // face reaches sqrt(5) / 3 in that direction.
  const auto values = direct_values(mesh)[9];
  CHECK(std::any_of(values.begin(), values.end(),
                    [](double value) { return std::abs(value - 0.25) < 1e-14; }));
  check_directly(mesh);
}

TEST_CASE("rulers of uneven meshes agree with the definitions") {
  for (const double amount : {0.1, 0.3}) {
    check_directly(TetMesh(test::kuhn_cube(8, amount, 7)));
  }
  check_directly(TetMesh(test::delaunay_ball(150, 7)));
  check_directly(TetMesh(test::two_regions()));
}

TEST_CASE("1 % is exact where a sample decides what is kept") {
  const MeshData data = test::kuhn_cube(22, 0.25, 7);  // 63888 tets
  const TetMesh mesh(data);
  check_directly(mesh);

  SUBCASE("of equal tets") {
    const MeshRulers even = measure_rulers(TetMesh(test::kuhn_cube(22, 0, 7)));
    CHECK(even[Ruler::edge_ratio].one_percent == doctest::Approx(std::numbers::sqrt3));
    CHECK(even[Ruler::sicn].one_percent == doctest::Approx(even[Ruler::sicn].worst));
  }
  SUBCASE("of tets in an order that misleads the sample: it sees the worst alone") {
    std::vector<std::uint32_t> order(data.tets.size());
    for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return mesh.quality(TetHandle(a)) < mesh.quality(TetHandle(b));
    });
    MeshData misleading = data;
    std::size_t worst = 0;
    std::size_t other = order.size() / 61 + 5;
    for (std::size_t t = 0; t < order.size(); ++t) {
      const bool seen = t % kChunkSize % 61 == 0 && worst < order.size() / 61 + 5;
      misleading.tets[t] = data.tets[order[seen || other == order.size() ? worst++ : other++]];
    }
    check_directly(TetMesh(misleading));
  }
}

TEST_CASE("rulers of inverted, flat and collapsed tets are as bad as can be, and no others") {
  const MeshRulers inverted = measure_rulers(TetMesh(test::tangled_ball(60, 3)));
  CHECK(inverted[Ruler::mean_ratio].worst < 0);
  CHECK(inverted[Ruler::sicn].worst < 0);
  CHECK(inverted[Ruler::sige].worst < 0);
  CHECK(inverted[Ruler::least_altitude].worst < 0);
  CHECK(inverted[Ruler::step].worst == 0);
  CHECK(inverted[Ruler::condition].worst == kInfinity);
  CHECK(inverted[Ruler::condition].mean == kInfinity);
  CHECK(inverted[Ruler::aspect_ratio].worst == kInfinity);
  CHECK(inverted[Ruler::non_orthogonality].worst > 90);
  CHECK(inverted.faces_above_70 > 0);

  const MeshRulers flat = measure_rulers(
      TetMesh(single_tet(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0))));
  for (const Ruler ruler :
       {Ruler::mean_ratio, Ruler::radius_ratio, Ruler::sicn, Ruler::sige, Ruler::least_altitude}) {
    CHECK(flat[ruler].worst == 0);
  }
  CHECK(flat[Ruler::edge_ratio].worst == doctest::Approx(std::numbers::sqrt2));

  const Point one(1, 1, 1);
  const MeshRulers collapsed = measure_rulers(TetMesh(single_tet(one, one, one, one)));
  for (std::size_t r = 0; r < kRulerCount; ++r) CHECK(!std::isnan(collapsed.figures[r].mean));
  CHECK(collapsed[Ruler::edge_ratio].worst == kInfinity);
  CHECK(collapsed[Ruler::mean_ratio].worst == 0);
}

TEST_CASE("rulers are the same, bit for bit, for every number of threads") {
  const TetMesh mesh(test::kuhn_cube(17, 0.3, 7));  // 29478 tets: two chunks, the second not full
  REQUIRE(mesh.tet_slots() > kChunkSize);
  const auto all_of = [&](int threads) {
    const MeshRulers rulers = on_threads(threads, [&] { return measure_rulers(mesh); });
    std::vector<double> values;
    for (const RulerFigures& of : rulers.figures) {
      values.insert(values.end(), {of.worst, of.one_percent, of.mean});
    }
    values.push_back(static_cast<double>(rulers.faces_above_70));
    values.push_back(rulers.cg_steps);
    return values;
  };
  const auto expected = all_of(1);
  CHECK(all_of(2) == expected);
  CHECK(all_of(5) == expected);
}

TEST_CASE("without CG steps all other rulers are as with them") {
  const TetMesh mesh(test::kuhn_cube(6, 0.3, 7));
  const MeshRulers all = measure_rulers(mesh);
  const MeshRulers some = measure_rulers(mesh, CgSteps::left_out);
  CHECK(all.work > 0);
  CHECK((std::isnan(some.cg_steps) && std::isnan(some.work)));
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    CHECK(some.figures[r].worst == all.figures[r].worst);
    CHECK(some.figures[r].one_percent == all.figures[r].one_percent);
    CHECK(some.figures[r].mean == all.figures[r].mean);
  }
  CHECK(some.faces_above_70 == all.faces_above_70);
  CHECK(some.inner_faces == all.inner_faces);
}

TEST_CASE("an empty mesh has rulers of zero") {
  const MeshRulers rulers = measure_rulers(TetMesh());
  for (const RulerFigures& of : rulers.figures) {
    CHECK(of.worst == 0);
    CHECK(of.one_percent == 0);
    CHECK(of.mean == 0);
  }
  CHECK(rulers.inner_faces == 0);
  CHECK(rulers.work == 0);
}
