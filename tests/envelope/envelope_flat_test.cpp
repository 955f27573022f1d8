// SPDX-License-Identifier: MIT
// Tolerance 0: the surface stays where it is, whatever its triangles do.
#include <algorithm>
#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "envelope/envelope.h"
#include "kernel/error.h"
#include "tests/envelope/surface_model.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The unit cube of 4 cells each way; points are quarters.
SurfaceModel flat_cube() {
  return {TetMesh(kuhn_cube(4, 0, 1)), {}};
}

}  // namespace

TEST_CASE("a vertex moves in its plane, not out of it and not over its neighbours") {
  SurfaceModel model = flat_cube();
  const VertexHandle v = vertex_at(model, {0.5, 0.5, 1});
  REQUIRE(model.guard().place(v) == SurfacePlace::smooth);
  CHECK(model.guard().direction(v, model.at(v)) == Point(0, 0, 1));
  CHECK(model.guard().nearest(v, {0.6, 0.55, 1.2}) == Point(0.6, 0.55, 1));
  CHECK_FALSE(model.move(v, {0.5, 0.5, 1 + 1e-9}));
  CHECK_FALSE(model.move(v, {0.8, 0.5, 1}));
  CHECK(model.move(v, {0.6, 0.55, 1}));
  CHECK_FALSE(model.move(vertex_at(model, {0.25, 0.25, 1}), {0.6, 0.55, 1}));
}

TEST_CASE("a ridge vertex moves along its line up to its neighbour, a corner never") {
  SurfaceModel model = flat_cube();
  const VertexHandle v = vertex_at(model, {0.5, 0, 1});
  REQUIRE(model.guard().place(v) == SurfacePlace::ridge);
  CHECK(model.guard().nearest(v, {0.6, 0.3, 1.2}) == Point(0.6, 0, 1));
  CHECK_FALSE(model.move(v, {0.5, 0.01, 1}));
  CHECK_FALSE(model.move(v, {0.8, 0, 1}));
  CHECK(model.move(v, {0.6, 0, 1}));
  const VertexHandle corner = vertex_at(model, {0, 0, 1});
  CHECK(model.guard().nearest(corner, {2, 2, 2}) == Point(0, 0, 1));
  CHECK_FALSE(model.move(corner, {0.01, 0, 1}));
}

TEST_CASE("edges are contracted inside a patch and along a line, not across it") {
  SurfaceModel model = flat_cube();
  const VertexHandle corner = vertex_at(model, {0, 0, 1});
  const VertexHandle ridge = vertex_at(model, {0.25, 0, 1});
  const VertexHandle next = vertex_at(model, {0.5, 0, 1});
  const VertexHandle inner = vertex_at(model, {0.25, 0.25, 1});
  CHECK_FALSE(model.contract(corner, ridge, false));
  CHECK_FALSE(model.contract(ridge, inner, false));
  CHECK(model.contract(inner, ridge, false));
  CHECK(model.contract(ridge, next, false));
  CHECK(model.contract(ridge, corner, false));
  REQUIRE(model.contract(ridge, next));
  CHECK(model.guard().place(ridge) == SurfacePlace::inside);
  CHECK(model.guard().is_feature(corner, next));
  CHECK(model.guard().line(corner, next) ==
        model.guard().line(next, vertex_at(model, {0.75, 0, 1})));
}

TEST_CASE("a split of a feature edge makes a ridge vertex, one inside a patch a smooth one") {
  SurfaceModel model = flat_cube();
  const VertexHandle a = vertex_at(model, {0.25, 0, 1});
  const VertexHandle b = vertex_at(model, {0.5, 0, 1});
  const VertexHandle c = vertex_at(model, {0.25, 0.25, 1});
  const VertexHandle d = vertex_at(model, {0.25, 0.5, 1});
  const VertexHandle first(static_cast<std::uint32_t>(model.points().size()));
  CHECK_FALSE(model.split(a, b, {0.3, 0, 1.1}));
  CHECK_FALSE(model.split(a, b, {0.2, 0, 1}));
  CHECK(model.split(a, b, {0.3, 0, 1}));
  CHECK(model.guard().place(first) == SurfacePlace::ridge);
  CHECK_FALSE(model.guard().is_feature(a, b));
  CHECK(model.guard().is_feature(a, first));
  CHECK(model.split(c, d, {0.25, 0.3, 1}));
  CHECK(model.guard().place(VertexHandle(first.index() + 1)) == SurfacePlace::smooth);
}

TEST_CASE("a feature edge is not flipped, and no edge into the outside of its quadrilateral") {
  SurfaceModel model = flat_cube();
  CHECK_FALSE(model.flip(vertex_at(model, {0.25, 0, 1}), vertex_at(model, {0.5, 0, 1})));
  const VertexHandle a = vertex_at(model, {0.25, 0.25, 1});
  const VertexHandle b = vertex_at(model, {0.5, 0.5, 1});
  const VertexHandle c = vertex_at(model, {0.5, 0.25, 1});
  CHECK(model.flip(a, b, false));
  CHECK(model.flip(b, c, false));
  REQUIRE(model.move(b, {0.4, 0.3, 1}));  // the four points are not convex any more
  CHECK_FALSE(model.flip(b, c, false));
}

TEST_CASE("a line inside a plane stays where it is") {
  MeshData data = kuhn_cube(2, 0, 1);
  const auto number = [&](double x) {
    return static_cast<std::uint32_t>(
        std::find(data.points.begin(), data.points.end(), Point(x, 0.5, 1)) - data.points.begin());
  };
  data.edges = {{{number(0), number(0.5)}, 1}, {{number(0.5), number(1)}, 1}};
  SurfaceModel model(TetMesh(data), {});
  const VertexHandle v(number(0.5));
  REQUIRE(model.guard().place(v) == SurfacePlace::ridge);
  CHECK(model.move(v, {0.6, 0.5, 1}));
  CHECK_FALSE(model.move(v, {0.6, 0.501, 1}));
}

TEST_CASE("a vertex moves with all of its faces or not at all") {
  SurfaceModel model = flat_cube();
  const VertexHandle v = vertex_at(model, {0.5, 0.5, 1});
  std::vector<SurfaceFace> before;
  std::vector<SurfaceFace> after;
  for (const auto& f : model.star(v)) {
    before.push_back({f, {model.at(f[0]), model.at(f[1]), model.at(f[2])}});
    after.push_back(before.back());
    for (unsigned k = 0; k < 3; ++k) {
      if (f[k] == v) after.back().points[k] = Point(0.51, 0.51, 1);
    }
  }
  CHECK(model.guard().replace(before, after, model.journal()));
  model.guard().undo(model.journal());
  before.pop_back();
  after.pop_back();
  CHECK_FALSE(model.guard().replace(before, after, model.journal()));
}

TEST_CASE("what is no edit of the present surface is refused") {
  SurfaceModel model = flat_cube();
  const VertexHandle v = vertex_at(model, {0.5, 0.5, 1});
  const auto star = model.star(v);
  std::vector<SurfaceModel::Face> others(model.faces().begin(), model.faces().end());
  CHECK_FALSE(model.exchange(star, {}));                                    // a hole
  CHECK_FALSE(model.exchange({star[0]}, {star[0], star[1]}));               // a face twice
  CHECK_FALSE(model.exchange({{star[0][0], star[0][2], star[0][1]}}, {}));  // another sense
  CHECK_FALSE(model.exchange({}, {others[0]}));
}

TEST_CASE("undo brings back the present surface bit for bit, in any order of kinds") {
  SurfaceModel model = flat_cube();
  contract::Random random(5);
  for (int i = 0; i < 500; ++i) {
    const std::unique_ptr<SurfaceGuard> copy = model.guard().clone();
    if (model.random_edit(random, 0.4, false)) {
      model.guard().resize(model.points().size() + 1);
      copy->resize(model.points().size() + 1);
      CHECK(model.guard() == static_cast<const Envelope&>(*copy));
    }
    if (i % 3 == 0) model.random_edit(random, 0.4);
  }
}

TEST_CASE(
    "thousands of random edits leave shape, area, volume, features and corners what they were") {
  for (const bool oblique : {false, true}) {
    MeshData data = kuhn_cube(3, 0, 1);
    const Eigen::AngleAxisd turn(0.7, Point(1, 2, 3).normalized());
    for (Point& p : data.points) {
      if (oblique) p = turn * p;
    }
    SurfaceModel model(TetMesh(data), {});
    const std::vector<Triangle> reference = model.triangles();
    contract::Random random(7);
    int made = 0;
    for (int i = 0; i < 4000; ++i) made += model.random_edit(random, 0.5);
    CHECK(made > 1000);
    const std::vector<Triangle> now = model.triangles();
    CHECK(total_area(now) == doctest::Approx(6).epsilon(1e-12));
    CHECK(enclosed_volume(now) == doctest::Approx(1).epsilon(1e-12));
    CHECK(sampled_distance(now, reference, 6) < 1e-12);
    CHECK(sampled_distance(reference, now, 6) < 1e-12);
    double length = 0;
    for (const VertexHandle v : model.vertices()) {
      for (const VertexHandle w : model.vertices()) {
        if (v < w && model.guard().is_feature(v, w)) length += (model.at(v) - model.at(w)).norm();
      }
    }
    CHECK(length == doctest::Approx(12).epsilon(1e-12));
  }
}

TEST_CASE("the interface of two regions is kept like the outside, with its line around") {
  SurfaceModel model(TetMesh(two_regions()), {});
  const std::vector<Triangle> reference = model.triangles();
  contract::Random random(11);
  int made = 0;
  for (int i = 0; i < 2000; ++i) made += model.random_edit(random, 0.5);
  CHECK(made > 300);
  CHECK(sampled_distance(model.triangles(), reference, 6) < 1e-12);
  CHECK(sampled_distance(reference, model.triangles(), 6) < 1e-12);
}

TEST_CASE("a guard follows new numbers of its vertices") {
  SurfaceModel model = flat_cube();
  contract::Random random(5);
  for (int i = 0; i < 200; ++i) model.random_edit(random, 0.4);
  model.journal().clear();
  const auto n = static_cast<std::uint32_t>(model.points().size());
  std::vector<VertexHandle> backwards;
  for (std::uint32_t i = 0; i < n; ++i) backwards.push_back(VertexHandle(n - 1 - i));
  const std::unique_ptr<SurfaceGuard> copy = model.guard().clone();
  copy->resize(n);
  copy->renumber(backwards, n);
  for (const auto& f : model.faces()) {
    const auto number = [&](VertexHandle v) { return backwards[v.index()]; };
    CHECK(copy->patch({number(f[0]), number(f[1]), number(f[2])}) == model.guard().patch(f));
    CHECK(copy->line(number(f[0]), number(f[1])) == model.guard().line(f[0], f[1]));
    CHECK(copy->place(number(f[0])) == model.guard().place(f[0]));
  }
}

TEST_CASE("an angle that is none is refused") {
  const TetMesh mesh(kuhn_cube(2, 0, 1));
  CHECK_THROWS_AS(Envelope::of(mesh, {.angle = 0, .kept = {}}), Error);
  CHECK_THROWS_AS(Envelope::of(mesh, {.angle = 181, .kept = {}}), Error);
}
