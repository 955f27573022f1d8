// SPDX-License-Identifier: MIT
// Histograms of rulers against the measures themselves, tet by tet.
#include "kernel/ruler_histogram.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include "kernel/quality.h"
#include "kernel/rulers.h"
#include "tests/support/tets.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Counts = std::array<std::size_t, RulerBins::kCount>;

std::size_t sum_of(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

/// As the definition of a histogram has it.
template <class Measure>
Counts count_literally(const TetMesh& mesh, const RulerBins& bins, const Measure& measure) {
  const std::vector<double> edges = bins.edges();
  Counts counts{};
  for (const TetHandle t : contract::live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    const double value =
        measure(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    const auto next = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
    ++counts[static_cast<std::size_t>(next - edges.begin()) - 1];
  }
  return counts;
}

}  // namespace

TEST_CASE("each bin has the tets whose value lies in it") {
  const TetMesh mesh = test::make_mesh(contract::kuhn_cube(9, 0.45, 3));
  const RulerHistograms all = count_rulers(mesh, measure_rulers(mesh));
  const auto counts = [&](Ruler ruler) { return all[static_cast<std::size_t>(ruler)]; };
  const RulerHistogram& mean_ratios = counts(Ruler::mean_ratio);
  CHECK(mean_ratios.counts == count_literally(mesh, mean_ratios.bins, mean_ratio));
  const RulerHistogram& radius_ratios = counts(Ruler::radius_ratio);
  CHECK(radius_ratios.counts == count_literally(mesh, radius_ratios.bins, radius_ratio));
  const RulerHistogram& edge_ratios = counts(Ruler::edge_ratio);
  CHECK(edge_ratios.counts == count_literally(mesh, edge_ratios.bins, edge_ratio));
}

TEST_CASE("every tet, face and vertex is in one bin, inverted ones in the first or the last") {
  const TetMesh mesh = test::make_mesh(contract::tangled_ball(300, 2));
  const MeshRulers rulers = measure_rulers(mesh);
  const RulerHistograms all = count_rulers(mesh, rulers);
  for (std::size_t r = 0; r < kRulerCount; ++r) {
    CAPTURE(kRulers[r].name);
    if (kRulers[r].of_faces) continue;
    CHECK(sum_of(all[r].counts) ==
          (kRulers[r].of_vertices ? mesh.vertex_count() : mesh.tet_count()));
  }
  const auto of = [&](Ruler ruler) { return all[static_cast<std::size_t>(ruler)].counts; };
  CHECK(sum_of(of(Ruler::non_orthogonality)) == rulers.inner_faces);
  CHECK(sum_of(of(Ruler::skewness)) > rulers.inner_faces);
  CHECK(of(Ruler::sicn).front() > 0);
  std::size_t inverted = 0;
  for (const TetHandle t : contract::live_tets(mesh)) inverted += mesh.quality(t) < 0 ? 1 : 0;
  REQUIRE(inverted > 0);
  CHECK(of(Ruler::condition).back() >= inverted);
  CHECK(of(Ruler::aspect_ratio).back() >= inverted);
}

TEST_CASE("the number of threads does not show in a histogram") {
  const TetMesh mesh = test::make_mesh(contract::kuhn_cube(24, 0.4, 5));
  const MeshRulers means = measure_rulers(mesh);
  const auto counts = [&](int threads) {
    return test::on_threads(threads, [&] {
      std::vector<Counts> list;
      for (const RulerHistogram& of : count_rulers(mesh, means)) list.push_back(of.counts);
      return list;
    });
  };
  CHECK(counts(1) == counts(4));
}

TEST_CASE("an edge belongs to the bin above it, and what is beyond to the bin at that end") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Ruler ruler :
       {Ruler::mean_ratio, Ruler::edge_ratio, Ruler::least_altitude, Ruler::step}) {
    const RulerBins bins(ruler, 3.7);
    const std::vector<double> edges = bins.edges();
    REQUIRE(edges.size() == RulerBins::kCount + 1);
    CHECK(std::is_sorted(edges.begin(), edges.end()));
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      CHECK(bins.find((edges[i] + edges[i + 1]) / 2) == i);
      if (ruler != Ruler::mean_ratio) CHECK(bins.find(edges[i]) == i);
    }
    CHECK(bins.find(-1) == 0);
    CHECK(bins.find(-kInfinity) == 0);
    CHECK(bins.find(kInfinity) == RulerBins::kCount - 1);
    CHECK(bins.find(1e300) == RulerBins::kCount - 1);
  }
  const std::vector<double> altitudes = RulerBins(Ruler::least_altitude, 3.7).edges();
  CHECK(altitudes.front() < 3.7);
  CHECK(altitudes.back() > 3.7);
}
