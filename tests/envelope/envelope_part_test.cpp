// SPDX-License-Identifier: MIT
// Two parts of a surface are changed without knowing of each other, and the whole keeps its proof.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include "envelope/envelope.h"
#include "tests/envelope/surface_model.h"
#include "tests/support/random_solids.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Face = SurfaceModel::Face;

/// What reaches to one side of a plane. Faces with a vertex beyond it are there, and stay.
struct Part {
  std::vector<Face> all, fixed;
  SurfaceFeatures features;
};

Part part_of(const SurfaceFeatures& whole, const std::vector<Point>& points, double cut, bool low) {
  const auto is_own = [&](VertexHandle v) { return (points[v.index()].x() < cut) == low; };
  Part part;
  part.features.places = whole.places;
  for (const auto& face : whole.faces) {
    const auto own = std::count_if(face.vertices.begin(), face.vertices.end(), is_own);
    if (own == 0) continue;
    part.all.push_back(face.vertices);
    part.features.faces.push_back(face);
    if (own < 3) part.fixed.push_back(face.vertices);
  }
  for (const auto& edge : whole.edges) {
    if (is_own(edge.vertices[0]) || is_own(edge.vertices[1])) part.features.edges.push_back(edge);
  }
  for (SurfacePlace& place : part.features.places) {
    const VertexHandle v(static_cast<std::uint32_t>(&place - part.features.places.data()));
    const bool is_there = std::any_of(part.all.begin(), part.all.end(), [&](const Face& face) {
      return std::find(face.begin(), face.end(), v) != face.end();
    });
    if (!is_there) place = SurfacePlace::inside;
  }
  for (const Face& face : part.fixed) {
    for (const VertexHandle v : face) part.features.places[v.index()] = SurfacePlace::corner;
  }
  return part;
}

/// Both parts as one surface again. Vertices that the second has added follow those of the first.
struct Joined {
  SurfaceFeatures features;
  std::vector<Point> points;

  void add(const SurfaceModel& model, std::size_t before, const std::vector<Face>& fixed,
           bool with_fixed) {
    const std::size_t shift = points.empty() ? 0 : points.size() - before;
    if (points.empty())
      points.assign(model.points().begin(),
                    model.points().begin() + static_cast<std::ptrdiff_t>(before));
    const SurfaceFeatures now = model.guard().present();
    const auto number = [&](VertexHandle v) {
      return v.index() < before ? v : VertexHandle(v.index() + static_cast<std::uint32_t>(shift));
    };
    for (std::size_t v = before; v < model.points().size(); ++v)
      points.push_back(model.points()[v]);
    std::vector<Face> frozen;
    for (const Face& face : fixed) frozen.push_back(SurfaceModel::rotated(face));
    for (auto face : now.faces) {
      const bool is_fixed = std::find(frozen.begin(), frozen.end(),
                                      SurfaceModel::rotated(face.vertices)) != frozen.end();
      if (is_fixed && !with_fixed) continue;
      for (VertexHandle& v : face.vertices) {
        if (!is_fixed) points[number(v).index()] = model.points()[v.index()];
        v = number(v);
      }
      features.faces.push_back(face);
    }
    for (auto edge : now.edges) {
      for (VertexHandle& v : edge.vertices) v = number(v);
      const auto same = [&](const auto& other) {
        return std::minmax(other.vertices[0], other.vertices[1]) ==
               std::minmax(edge.vertices[0], edge.vertices[1]);
      };
      if (std::none_of(features.edges.begin(), features.edges.end(), same)) {
        features.edges.push_back(edge);
      }
    }
  }
};

std::vector<Triangle> triangles_of(const Joined& joined) {
  std::vector<Triangle> result;
  for (const auto& face : joined.features.faces) {
    Triangle& t = result.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) t[k] = joined.points[face.vertices[k].index()];
  }
  return result;
}

}  // namespace

TEST_CASE("parts that know nothing of each other keep the proof of the whole, both ways") {
  const char* wanted = std::getenv("TETMEND_SOLIDS");
  const int solids = wanted == nullptr ? 8 : std::atoi(wanted);
  RandomSolids source(31);
  contract::Random random(8);
  std::size_t made = 0;
  for (int i = 0; i < solids; ++i) {
    const Solid solid = source.next();
    EnvelopeOptions options;
    if (i % 4 == 0) {
      options.length = 0.02;
    } else {
      options.share = random.real(0.01, 0.15);
    }
    SurfaceModel whole(TetMesh(solid.data), options);
    const auto reference = std::make_shared<const Reference>(whole.guard().reference());
    for (int edit = 0; edit < 60; ++edit) whole.random_edit(random, 0.3);
    CAPTURE(i);
    CAPTURE(solid.name);
    const SurfaceFeatures now = whole.guard().present();
    std::vector<double> places;
    for (const VertexHandle v : whole.vertices()) places.push_back(whole.at(v).x());
    std::nth_element(places.begin(), places.begin() + std::ssize(places) / 2, places.end());
    const double cut = places[places.size() / 2];
    Joined joined;
    for (const bool low : {true, false}) {
      const Part part = part_of(now, whole.points(), cut, low);
      SurfaceModel model(Envelope::of_part(reference, whole.points(), part.features),
                         whole.points(), part.all, part.fixed);
      for (int edit = 0; edit < 150; ++edit) made += model.random_edit(random, 0.4);
      joined.add(model, whole.points().size(), part.fixed, low);
    }
    joined.features.places.assign(joined.points.size(), SurfacePlace::smooth);
    const auto proven = Envelope::of_part(reference, joined.points, joined.features);
    const SurfaceBound bound = proven->prove();
    CHECK(bound.unproven == 0);
    const std::vector<Triangle> is = triangles_of(joined);
    CHECK(bound.distance >= sampled_distance(is, whole.reference(), 5) - 1e-15);
    CHECK(bound.distance >= sampled_distance(whole.reference(), is, 5) - 1e-15);
  }
  CHECK(made > 30 * static_cast<std::size_t>(solids));
}
