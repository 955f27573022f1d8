// SPDX-License-Identifier: MIT
// Tolerances other than 0: the surface moves, and never too far.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "envelope/envelope.h"
#include "kernel/error.h"
#include "tests/envelope/surface_model.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

SurfaceModel near_cube(double length) {
  return {TetMesh(kuhn_cube(4, 0, 1)), {.length = length, .kept = {}}};
}

/// Kuhn cube pressed into a ball.
MeshData round_ball(unsigned cells) {
  MeshData data = kuhn_cube(cells, 0, 1);
  for (Point& p : data.points) {
    p = 2 * (p - Point(0.5, 0.5, 0.5));
    const double most = p.cwiseAbs().maxCoeff();
    if (p.norm() > 0) p *= most / p.norm();
  }
  return data;
}

void check_near(const SurfaceModel& model, double length) {
  const std::vector<Triangle> now = model.triangles();
  CHECK(sampled_distance(now, model.reference()) <= length);
  CHECK(sampled_distance(model.reference(), now) <= length);
}

}  // namespace

TEST_CASE("a vertex leaves its plane by less than the tolerance, not by more") {
  SurfaceModel model = near_cube(0.02);
  const VertexHandle v = vertex_at(model, {0.5, 0.5, 1});
  CHECK_FALSE(model.move(v, {0.8, 0.5, 1}));  // folds over
  for (int step = 1; step <= 8; ++step) {
    REQUIRE(model.move(v, {0.5, 0.5, 1 + 0.0024 * step}));
    CHECK_FALSE(model.move(v, {0.5, 0.5, 1.021}));
  }
  for (int step = 7; step >= -8; --step) {
    REQUIRE(model.move(v, {0.5 + 0.005 * step, 0.5, 1 + 0.0024 * step}));
  }
  CHECK_FALSE(model.move(v, {0.46, 0.5, 0.979}));
}

TEST_CASE("an edit that makes many more bends than it found is refused") {
  SurfaceModel model = near_cube(0.02);
  const VertexHandle v = vertex_at(model, {0.5, 0.5, 1});
  CHECK(model.move(v, {0.5, 0.5, 1.004}, false));
  CHECK_FALSE(model.move(v, {0.5, 0.5, 1.019}));
}

TEST_CASE("a ridge vertex keeps near its line, a corner where it is") {
  SurfaceModel model = near_cube(0.02);
  const VertexHandle v = vertex_at(model, {0.5, 0, 1});
  CHECK(model.move(v, {0.55, 0.004, 1.004}, false));
  CHECK_FALSE(model.move(v, {0.55, 0.03, 1}));
  CHECK_FALSE(model.move(v, {0.8, 0, 1}));
  CHECK_FALSE(model.move(vertex_at(model, {0, 0, 1}), {0.001, 0, 1}));
}

namespace {

/// A cube of 4 cells, 0.4 wide and deep and 1 high, its middle on top lifted by that much.
SurfaceModel pyramid(double height, double length) {
  MeshData data = kuhn_cube(4, 0, 1);
  for (Point& p : data.points) {
    const bool apex = p == Point(0.5, 0.5, 1);
    p = Point(0.4 * p.x(), 0.4 * p.y(), p.z() + (apex ? height : 0));
  }
  return {TetMesh(data), {.length = length, .kept = {}}};
}

VertexHandle near_vertex(const SurfaceModel& model, const Point& p) {
  const auto& points = model.points();
  const auto at = std::find_if(points.begin(), points.end(),
                               [&](const Point& q) { return (p - q).norm() < 1e-9; });
  return VertexHandle(static_cast<std::uint32_t>(at - points.begin()));
}

}  // namespace

// The slopes of a pyramid of 0.036 are nearer to the middle of its base, 0.032, than its apex is.
TEST_CASE("the reference must stay covered: a vertex is not drawn back from what only it covers") {
  SurfaceModel model = pyramid(0.036, 0.034);
  const VertexHandle v = near_vertex(model, {0.2, 0.2, 1.036});
  REQUIRE(model.guard().place(v) == SurfacePlace::smooth);
  CHECK(model.move(v, {0.2, 0.2, 1.006}, false));
  CHECK_FALSE(model.move(v, {0.2, 0.2, 1}));
  CHECK_FALSE(model.contract(v, near_vertex(model, {0.2, 0.1, 1})));
}

TEST_CASE("the present surface must stay near: a vertex is not pushed out where the rest holds") {
  SurfaceModel model = pyramid(0, 0.034);
  const VertexHandle v = near_vertex(model, {0.2, 0.2, 1});
  double reached = 0;
  for (int step = 1; step <= 40; ++step) {
    const double height = 0.001 * step;
    if (!model.move(v, {0.2, 0.2, 1 + height})) break;
    reached = height;
  }
  CHECK(reached == doctest::Approx(0.033));
}

TEST_CASE("a line inside a plane keeps near itself, though its faces could not stray") {
  MeshData data = kuhn_cube(4, 0, 1);
  const auto number = [&](double x) {
    return static_cast<std::uint32_t>(
        std::find(data.points.begin(), data.points.end(), Point(x, 0.5, 1)) - data.points.begin());
  };
  for (const double x : {0.0, 0.25, 0.5, 0.75}) {
    data.edges.push_back({{number(x), number(x + 0.25)}, 1});
  }
  const std::uint32_t middle = number(0.5);
  for (Point& p : data.points) p.x() *= 0.4;
  SurfaceModel model(TetMesh(data), {.length = 0.034, .kept = {}});
  const VertexHandle v(middle);
  REQUIRE(model.guard().place(v) == SurfacePlace::ridge);
  CHECK(model.move(v, {0.2, 0.533, 1}, false));
  CHECK_FALSE(model.move(v, {0.2, 0.5355, 1}));  // the old line would still be near the new one
}

TEST_CASE("nothing folds over, however large the tolerance") {
  SurfaceModel model = near_cube(5);  // more than all bends that a fold can make
  const VertexHandle v = vertex_at(model, {0.5, 0.5, 1});
  CHECK(model.move(v, {0.6, 0.5, 1}, false));
  CHECK_FALSE(model.move(v, {0.8, 0.5, 1}));
}

TEST_CASE("moves add up to no more than the tolerance") {
  SurfaceModel model(TetMesh(round_ball(4)), {.length = 0.01, .angle = 60, .kept = {}});
  contract::Random random(3);
  int made = 0;
  for (int round = 0; round < 30; ++round) {
    for (const VertexHandle v : model.vertices()) {
      if (model.guard().place(v) == SurfacePlace::corner) continue;
      made += model.move(v, model.at(v) * 1.004);  // always outward
    }
  }
  CHECK(made > 50);
  check_near(model, 0.01);
}

TEST_CASE("nearest places and directions of curved patches and lines") {
  SurfaceModel model(TetMesh(round_ball(4)), {.length = 0.01, .angle = 60, .kept = {}});
  for (const VertexHandle v : model.vertices()) {
    if (model.guard().place(v) != SurfacePlace::smooth) continue;
    const Point outward = model.at(v).normalized();
    CHECK(model.guard().direction(v, model.at(v)).dot(outward) > 0.9);
    const Point back = model.guard().nearest(v, model.at(v) + 0.1 * outward);
    double least = 1e9;
    for (const Triangle& t : model.reference()) least = std::min(least, triangle_distance(back, t));
    CHECK(least < 1e-12);
  }
}

TEST_CASE("thousands of random edits keep every shape within its tolerance, both ways") {
  struct Shape {
    MeshData data;
    double length;
    double angle;
  };
  const std::vector<Shape> shapes = {
      {kuhn_cube(3, 0, 1), 0.01, 40},   {kuhn_cube(3, 0, 1), 0.1, 40},
      {round_ball(4), 0.003, 60},       {round_ball(4), 0.03, 60},
      {two_regions(), 0.02, 40},        {delaunay_ball(200, 3), 0.02, 179},
      {delaunay_ball(200, 4), 0.02, 40}};
  for (const Shape& shape : shapes) {
    CAPTURE(&shape - shapes.data());
    SurfaceModel model(TetMesh(shape.data),
                       {.length = shape.length, .angle = shape.angle, .kept = {}});
    contract::Random random(17);
    int made = 0;
    for (int i = 0; i < 1500; ++i) made += model.random_edit(random, 0.4);
    CHECK(made > 150);
    check_near(model, shape.length);
  }
}

TEST_CASE("a share of edges: a coarse part may move farther than a fine one") {
  MeshData data = kuhn_cube(6, 0, 1);
  for (Point& p : data.points) p.x() = p.x() * p.x();  // fine at x = 0
  const TetMesh mesh(data);
  SurfaceModel model(mesh, {.share = 0.05, .kept = {}});
  std::vector<double> tolerance;
  for (const Element& element : model.guard().reference().elements) {
    if (element.corners == 3) tolerance.push_back(element.tolerance);
  }
  const auto [least, most] = std::minmax_element(tolerance.begin(), tolerance.end());
  CHECK(*most > 1.3 * *least);
  contract::Random random(23);
  for (int i = 0; i < 3000; ++i) model.random_edit(random, 0.4);
  // Of each triangle of the reference its own tolerance counts.
  const std::vector<Triangle> now = model.triangles();
  std::vector<std::size_t> order(tolerance.size());
  const auto& elements = model.guard().reference().elements;
  for (std::size_t i = 0; i < tolerance.size(); ++i) {
    CHECK(sampled_distance({elements[i].points}, now, 8) <= tolerance[i]);
  }
  for (const Triangle& t : now) {
    for (const Point& p : {t[0], t[1], t[2], Point((t[0] + t[1] + t[2]) / 3)}) {
      const bool near = std::any_of(elements.begin(), elements.end(), [&](const Element& element) {
        return element.corners == 3 && triangle_distance(p, element.points) <= element.tolerance;
      });
      CHECK(near);
    }
  }
}

TEST_CASE("undo brings back surface and proof bit for bit") {
  SurfaceModel model(TetMesh(round_ball(3)), {.length = 0.02, .angle = 60, .kept = {}});
  contract::Random random(5);
  int undone = 0;
  for (int i = 0; i < 600; ++i) {
    const std::unique_ptr<SurfaceGuard> copy = model.guard().clone();
    if (model.random_edit(random, 0.4, false)) {
      ++undone;
      model.guard().resize(model.points().size() + 1);
      copy->resize(model.points().size() + 1);
      CHECK(model.guard() == static_cast<const Envelope&>(*copy));
    }
    if (i % 3 == 0) model.random_edit(random, 0.4);
  }
  CHECK(undone > 100);
}

TEST_CASE("the proof follows new numbers of the vertices") {
  SurfaceModel model(TetMesh(round_ball(3)), {.length = 0.02, .angle = 60, .kept = {}});
  contract::Random random(5);
  for (int i = 0; i < 200; ++i) model.random_edit(random, 0.4);
  model.journal().clear();
  const auto n = static_cast<std::uint32_t>(model.points().size());
  model.guard().resize(n);
  std::vector<VertexHandle> backwards;
  for (std::uint32_t i = 0; i < n; ++i) backwards.push_back(VertexHandle(n - 1 - i));
  const std::unique_ptr<SurfaceGuard> copy = model.guard().clone();
  copy->renumber(backwards, n);
  copy->renumber(backwards, n);
  CHECK(static_cast<const Envelope&>(*copy).proven_bound().distance ==
        model.guard().proven_bound().distance);
}

TEST_CASE("the proven bound lies between what is sampled and the tolerance, and begins with 0") {
  SurfaceModel model(TetMesh(round_ball(4)), {.length = 0.02, .angle = 60, .kept = {}});
  CHECK(model.guard().proven_bound().distance == 0);
  CHECK(model.guard().proven_bound().touched == 0);
  contract::Random random(5);
  for (int i = 0; i < 1000; ++i) model.random_edit(random, 0.4);
  const SurfaceBound bound = model.guard().proven_bound();
  const std::vector<Triangle> now = model.triangles();
  CHECK(sampled_distance(now, model.reference()) <= bound.distance);
  constexpr double kRounding = 1 + 1e-12;  // sampled by another formula
  CHECK(sampled_distance(model.reference(), now) <= kRounding * bound.distance);
  CHECK(bound.distance <= 0.02);
  const double own = model.guard().sampled_distance(13);
  CHECK(own == doctest::Approx(std::max(sampled_distance(now, model.reference()),
                                        sampled_distance(model.reference(), now))));
  CHECK(bound.share <= 1);
  CHECK(bound.touched > 100);
}

TEST_CASE("parts that face each other across a gap get less than half of it") {
  // Two cubes of 2 cells, 0.01 apart, in one mesh.
  MeshData data = kuhn_cube(2, 0, 1);
  const MeshData second = kuhn_cube(2, 0, 1);
  const auto n = static_cast<std::uint32_t>(data.points.size());
  for (const Point& p : second.points) data.points.push_back(p + Point(1.01, 0, 0));
  for (MeshData::Tet tet : second.tets) {
    for (auto& v : tet.vertices) v += n;
    data.tets.push_back(tet);
  }
  SurfaceModel model(TetMesh(data), {.length = 0.02, .kept = {}});
  for (const Element& element : model.guard().reference().elements) {
    if (element.corners != 3) continue;
    const bool at_gap = std::all_of(element.points.begin(), element.points.end(),
                                    [](const auto& p) { return std::abs(p.x() - 1.005) < 0.006; });
    if (at_gap) CHECK(element.tolerance < 0.005);
    if (element.points[0].x() < 0.1) CHECK(element.tolerance > 0.0199);
  }
  CHECK_FALSE(model.move(vertex_at(model, {1, 0.5, 0.5}), {1.006, 0.5, 0.5}));
  CHECK(model.move(vertex_at(model, {1, 0.5, 0.5}), {1.001, 0.5, 0.5}));
  // The thickness of a plate is no gap: positive tets keep its sides apart.
  MeshData plate = kuhn_cube(2, 0, 1);
  for (Point& p : plate.points) p.z() *= 0.01;
  const auto sides = Envelope::of(TetMesh(plate), {.length = 0.004, .kept = {}});
  for (const Element& element : sides->reference().elements) CHECK(element.tolerance > 0.0039);
}

TEST_CASE("tolerances that are none are refused") {
  const TetMesh mesh(kuhn_cube(2, 0, 1));
  CHECK_THROWS_AS(Envelope::of(mesh, {.share = -1, .kept = {}}), Error);
  CHECK_THROWS_AS(Envelope::of(mesh, {.length = NAN, .kept = {}}), Error);
  CHECK_THROWS_AS(Envelope::of(mesh, {.share = 0.1, .length = 1, .kept = {}}), Error);
  CHECK_THROWS_AS(Envelope::of(mesh, {.length = 1e-15, .kept = {}}), Error);
}
