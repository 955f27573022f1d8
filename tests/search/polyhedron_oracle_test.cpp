// SPDX-License-Identifier: MIT
// The polyhedron search against an enumeration of all tetrahedralisations of random polyhedra of 5
// to 9 vertices.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "contract/delaunay.h"
#include "contract/zoo.h"
#include "kernel/exact_orientation.h"
#include "kernel/quality.h"
#include "search/polyhedron_search.h"

using namespace tetmend;
using contract::Random;

namespace {

using TetCorners = std::array<unsigned, 4>;   // in positive order
using FaceCorners = std::array<unsigned, 3>;  // counterclockwise seen from outside its tet

constexpr std::array<FaceCorners, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

FaceCorners face(const TetCorners& tet, unsigned f) {
  return {tet[kFaces[f][0]], tet[kFaces[f][1]], tet[kFaces[f][2]]};
}

/// Starting at the lowest corner.
FaceCorners turned(FaceCorners t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

FaceCorners reversed(const FaceCorners& t) {
  return turned({t[0], t[2], t[1]});
}

/// The faces of tets that have no other tet behind them.
std::set<FaceCorners> surface_of(const std::vector<TetCorners>& tets) {
  std::set<FaceCorners> open;
  for (const TetCorners& tet : tets) {
    for (unsigned f = 0; f < 4; ++f) {
      const FaceCorners t = turned(face(tet, f));
      if (open.erase(reversed(t)) == 0) open.insert(t);
    }
  }
  return open;
}

struct Solid {
  std::vector<Point> points;
  std::vector<TetCorners> tets;  // that it was made of
  std::set<FaceCorners> surface;
  std::set<unsigned> inside;  // vertices not on the surface

  double volume(const TetCorners& t) const {
    return volume6(points[t[0]], points[t[1]], points[t[2]], points[t[3]]);
  }
  double quality(const TetCorners& t) const {
    return minimum_sine(points[t[0]], points[t[1]], points[t[2]], points[t[3]]);
  }
  double volume() const {
    double sum = 0;
    for (const TetCorners& t : tets) sum += volume(t);
    return sum;
  }
  PointMask inside_mask() const {
    PointMask mask = 0;
    for (const unsigned v : inside) mask |= PointMask{1} << v;
    return mask;
  }
};

/// Points of a ball, pressed flat or onto a sphere for some of the shapes.
std::vector<Point> random_ball_points(Random& random, unsigned count, unsigned shape) {
  std::vector<Point> points(count);
  for (Point& p : points) {
    p = random.in_ball(1);
    if (shape % 3 == 1) p.z() *= 0.3;
    if (shape % 3 == 2) p = p.normalized() * random.real(0.9, 1);
  }
  if (shape % 3 == 2) points[0] *= 0.2;
  return points;
}

/// Grows from a Delaunay tet, by tets behind its faces, to at most `vertices` vertices.
Solid random_solid(Random& random, unsigned vertices, unsigned shape) {
  Solid solid;
  const std::vector<Point> points =
      random_ball_points(random, vertices + static_cast<unsigned>(random.index(4)), shape);
  std::vector<TetCorners> left;
  for (const auto& t : contract::delaunay(points)) left.push_back({t[0], t[1], t[2], t[3]});
  std::set<unsigned> used;
  const std::size_t most = 2 + random.index(left.size());
  const auto corners_with = [&](const TetCorners& t) {
    std::set<unsigned> all = used;
    all.insert(t.begin(), t.end());
    return all;
  };
  std::vector<TetCorners> tets;
  while (!left.empty() && tets.size() < most) {
    std::vector<std::size_t> fitting;
    const std::set<FaceCorners> surface = surface_of(tets);
    for (std::size_t i = 0; i < left.size(); ++i) {
      bool touches = tets.empty();
      for (unsigned f = 0; f < 4; ++f) touches |= surface.count(reversed(face(left[i], f))) > 0;
      if (touches && corners_with(left[i]).size() <= vertices) fitting.push_back(i);
    }
    if (fitting.empty()) break;
    const std::size_t i = fitting[random.index(fitting.size())];
    used = corners_with(left[i]);
    tets.push_back(left[i]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
  }
  std::map<unsigned, unsigned> number;
  for (const unsigned v : used) {
    number[v] = static_cast<unsigned>(number.size());
    solid.points.push_back(points[v]);
  }
  for (TetCorners t : tets) {
    for (unsigned& v : t) v = number[v];
    solid.tets.push_back(t);
  }
  solid.surface = surface_of(solid.tets);
  for (unsigned v = 0; v < solid.points.size(); ++v) solid.inside.insert(v);
  for (const FaceCorners& t : solid.surface) {
    for (const unsigned v : t) solid.inside.erase(v);
  }
  return solid;
}

/// All tetrahedralisations, by filling the first open face with each vertex in turn. Positive tets
/// that leave no face open and have the volume of the solid tile it.
class Enumeration {
 public:
  explicit Enumeration(const Solid& solid) : solid_(solid), volume_(solid.volume()) {
    for (const FaceCorners& t : solid.surface) {
      open_.insert(t);
      taken_.insert(reversed(t));
    }
    descend(0);
  }

  std::size_t count() const { return count_; }
  /// The worst quality of the best, with all vertices or with those on the surface at least; 0 if
  /// there is none.
  double best_with_all() const { return best_with_all_; }
  double best() const { return best_; }

 private:
  /// A face is listed as its tet sees it; an open one wants a tet that does.
  void descend(double volume) {
    if (open_.empty()) {
      if (std::abs(volume - volume_) < 1e-9 * volume_) note();
      return;
    }
    const FaceCorners base = *open_.begin();
    for (unsigned apex = 0; apex < solid_.points.size(); ++apex) {
      const TetCorners tet = {apex, base[0], base[1], base[2]};
      if (std::count(base.begin(), base.end(), apex) > 0) continue;
      const auto& p = solid_.points;
      if (exact_orientation(p[apex], p[base[0]], p[base[1]], p[base[2]]) <= 0) continue;
      const double sum = volume + solid_.volume(tet);
      if (sum > volume_ * (1 + 1e-9)) continue;
      if (std::any_of(kFaces.begin(), kFaces.end(), [&](const FaceCorners& local) {
            return taken_.count(turned({tet[local[0]], tet[local[1]], tet[local[2]]})) > 0;
          })) {
        continue;
      }
      put(tet);
      descend(sum);
      take_back(tet);
    }
  }

  void put(const TetCorners& tet) {
    tets_.push_back(tet);
    for (unsigned f = 0; f < 4; ++f) {
      const FaceCorners t = turned(face(tet, f));
      taken_.insert(t);
      if (open_.erase(t) == 0) open_.insert(reversed(t));
    }
  }

  void take_back(const TetCorners& tet) {
    tets_.pop_back();
    for (unsigned f = 0; f < 4; ++f) {
      const FaceCorners t = turned(face(tet, f));
      taken_.erase(t);
      if (open_.erase(reversed(t)) == 0) open_.insert(t);
    }
  }

  void note() {
    ++count_;
    double worst = 1;
    std::set<unsigned> unused = solid_.inside;
    for (const TetCorners& tet : tets_) {
      worst = std::min(worst, solid_.quality(tet));
      for (const unsigned v : tet) unused.erase(v);
    }
    best_ = std::max(best_, worst);
    if (unused.empty()) best_with_all_ = std::max(best_with_all_, worst);
  }

  const Solid& solid_;
  double volume_;
  std::set<FaceCorners> open_;
  std::set<FaceCorners> taken_;
  std::vector<TetCorners> tets_;
  std::size_t count_ = 0;
  double best_ = 0;
  double best_with_all_ = 0;
};

/// Owns what a problem refers to.
struct OracleSearch {
  explicit OracleSearch(const Solid& solid) {
    for (const Point& p : solid.points) search.add(p);
    for (const FaceCorners& t : solid.surface) {
      surface.push_back({static_cast<std::uint8_t>(t[0]), static_cast<std::uint8_t>(t[1]),
                         static_cast<std::uint8_t>(t[2])});
    }
    problem.surface = surface;
    problem.max_nodes = 1000000;
  }

  PolyhedronSearch search;
  std::vector<PolyhedronProblem::Triangle> surface;
  PolyhedronProblem problem;
};

std::vector<TetCorners> found_tets(const PolyhedronSearch& search) {
  std::vector<TetCorners> tets;
  for (const auto& [a, b, c, d] : search.tets()) tets.push_back({a, b, c, d});
  return tets;
}

/// What is wrong with the tets that were found; empty if nothing is.
std::string fault_of(const Solid& solid, const PolyhedronSearch& search, bool all_vertices) {
  const std::vector<TetCorners> tets = found_tets(search);
  std::set<unsigned> unused = solid.inside;
  double volume = 0;
  double worst = 1;
  for (const TetCorners& t : tets) {
    const auto& p = solid.points;
    if (exact_orientation(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) <= 0) return "a tet is not positive";
    volume += solid.volume(t);
    worst = std::min(worst, solid.quality(t));
    for (const unsigned v : t) unused.erase(v);
  }
  if (surface_of(tets) != solid.surface) return "the surface is another";
  if (std::abs(volume - solid.volume()) > 1e-9 * volume) return "the volume has changed";
  if (all_vertices && !unused.empty()) return "a vertex is gone";
  return std::abs(worst - search.worst()) < 1e-6 ? "" : "the worst quality is another";
}

constexpr double kTolerance = 1e-6;

}  // namespace

TEST_CASE("A random polyhedron gets the best of all its tetrahedralisations") {
  Random random(1);
  std::size_t with_choice = 0;
  std::size_t with_inside = 0;
  std::size_t beats_delaunay = 0;
  std::size_t vertex_removed = 0;
  for (unsigned n = 0; n < 3000; ++n) {
    CAPTURE(n);
    const Solid solid = random_solid(random, 5 + n % 5, n / 5);
    const Enumeration all(solid);
    REQUIRE(all.count() > 0);  // that of the Delaunay tets at least
    OracleSearch s(solid);
    for (const bool keep_all : {true, false}) {
      CAPTURE(keep_all);
      const double best = keep_all ? all.best_with_all() : all.best();
      s.problem.kept = keep_all ? solid.inside_mask() : 0;
      s.problem.floor = 0;
      REQUIRE(s.search.run(s.problem));
      CHECK(std::abs(s.search.worst() - best) < kTolerance);
      CHECK(fault_of(solid, s.search, keep_all) == "");
      s.problem.floor = static_cast<Quality>(best - kTolerance);
      if (best > kTolerance) CHECK(s.search.run(s.problem));
      s.problem.floor = static_cast<Quality>(best + kTolerance);
      CHECK_FALSE(s.search.run(s.problem));
      CHECK_FALSE(s.search.was_cut_short());
    }
    double delaunay = 1;
    for (const TetCorners& t : solid.tets) delaunay = std::min(delaunay, solid.quality(t));
    with_choice += all.count() > 1;
    with_inside += !solid.inside.empty();
    beats_delaunay += all.best_with_all() > delaunay + kTolerance;
    vertex_removed += all.best() > all.best_with_all() + kTolerance;
  }
  // The cases are of all kinds, or this would prove little.
  CHECK(with_choice > 1000);
  CHECK(with_inside > 100);
  CHECK(beats_delaunay > 300);
  CHECK(vertex_removed > 30);
}
