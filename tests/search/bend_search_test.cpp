// SPDX-License-Identifier: MIT
// The best bend of an edge, against the coefficients themselves and against brute force.
#include "search/bend_search.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/curved.h"

using namespace tetmend;

namespace {

struct Bent {
  std::array<Point, 4> vertices;
  std::array<Point, 6> bends;
};

/// Tets around the edge from the first to the second vertex, with bends of all other edges.
std::vector<Bent> fan(std::mt19937& random, double strength) {
  std::uniform_real_distribution<double> noise(-1, 1);
  const auto any = [&](double size) {
    return Point(size * noise(random), size * noise(random), size * noise(random));
  };
  const std::array<Point, 4> ring = {Point(1, 0, 0.5), Point(0, 1, 0.5), Point(-1, 0, 0.5),
                                     Point(0, -1, 0.5)};
  std::vector<Bent> tets;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Bent tet{{Point(0, 0, 0), Point(0, 0, 1), ring[i], ring[(i + 1) % 4]}, {}};
    tet.bends.fill(Point::Zero());
    for (std::size_t e = 1; e < 6; ++e) tet.bends[e] = any(strength);
    std::array<Point, 6> none;
    none.fill(Point::Zero());
    if (jacobian_coefficients(tet.vertices, none)[0] < 0) {
      std::swap(tet.vertices[2], tet.vertices[3]);
    }
    tets.push_back(tet);
  }
  return tets;
}

double least(const std::vector<Bent>& tets, const Point& bend) {
  double worst = 1e300;
  for (Bent tet : tets) {
    std::array<Point, 6> none;
    none.fill(Point::Zero());
    const double straight = jacobian_coefficients(tet.vertices, none)[0];
    tet.bends[0] = bend;
    for (const double c : jacobian_coefficients(tet.vertices, tet.bends)) {
      worst = std::min(worst, c / straight);
    }
  }
  return worst;
}

BendSearch search_of(const std::vector<Bent>& tets) {
  BendSearch search;
  for (const Bent& tet : tets) search.add(tet.vertices, tet.bends, 0);
  return search;
}

}  // namespace

TEST_CASE("the least coefficient around an edge is affine in its bend, piece by piece") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  for (int n = 0; n < 50; ++n) {
    const std::vector<Bent> tets = fan(random, 0.1);
    const BendSearch search = search_of(tets);
    for (int k = 0; k < 20; ++k) {
      const Point bend(noise(random), noise(random), noise(random));
      CHECK(search.value(bend) == doctest::Approx(least(tets, bend)).epsilon(1e-9));
    }
  }
}

TEST_CASE("no bend that random search finds is better by more than a little") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  for (int n = 0; n < 30; ++n) {
    const std::vector<Bent> tets = fan(random, 0.15);
    const BendSearch search = search_of(tets);
    const Point best = search.best(Point::Zero());
    CHECK(search.value(best) >= search.value(Point::Zero()));
    double most = -1e300;
    for (int k = 0; k < 5000; ++k) {
      most = std::max(most, search.value(Point(noise(random), noise(random), noise(random))));
    }
    CHECK(search.value(best) > most - 0.02);
  }
}

TEST_CASE("an eased edge misses what is wanted by less, and stays where nothing is missing") {
  std::mt19937 random(5);
  for (int n = 0; n < 30; ++n) {
    const std::vector<Bent> tets = fan(random, 0.2);
    const BendSearch search = search_of(tets);
    const Point eased = search.eased(Point::Zero(), 0.3);
    const auto shortfall = [&](const Point& bend) {
      double sum = 0;
      for (Bent tet : tets) {
        std::array<Point, 6> none;
        none.fill(Point::Zero());
        const double straight = jacobian_coefficients(tet.vertices, none)[0];
        tet.bends[0] = bend;
        for (const double c : jacobian_coefficients(tet.vertices, tet.bends)) {
          const double missing = std::max(0.0, 0.3 - c / straight);
          sum += missing * missing;
        }
      }
      return sum;
    };
    CHECK(shortfall(eased) <= shortfall(Point::Zero()));
  }
  const BendSearch straight = search_of(fan(random, 0));
  CHECK(straight.eased(Point::Zero(), 0.3) == Point::Zero());
  CHECK(straight.value(Point::Zero()) == doctest::Approx(1));
}
