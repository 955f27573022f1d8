// SPDX-License-Identifier: MIT
// Mesh statistics against small meshes done by hand and against a slow direct computation.
#include "kernel/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/chunks.h"
#include "kernel/integrity.h"
#include "kernel/quality.h"
#include "kernel/surface_fingerprint.h"
#include "kernel/tet_mesh.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/tets.h"
#include "tests/support/threads.h"

using namespace tetmend;
using namespace tetmend::test;
using tetmend::test::on_threads;

namespace {

std::uint32_t grid_index(int i, int j, int k, int n) {
  return static_cast<std::uint32_t>((k * (n + 1) + j) * (n + 1) + i);
}

/// The unit cube as n^3 cells of six Kuhn tets each. There is one for every order in which a path
/// from the low to the high corner of a cell can walk along x, y and z.
MeshData split_cubes(int n) {
  MeshData data;
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) data.points.push_back(Point(i, j, k) / n);
    }
  }
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        std::array<int, 3> axes = {0, 1, 2};
        do {
          std::array<int, 3> at = {i, j, k};
          MeshData::Tet tet;
          tet.vertices[0] = grid_index(i, j, k, n);
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[static_cast<std::size_t>(axes[step])];
            tet.vertices[step + 1] = grid_index(at[0], at[1], at[2], n);
          }
          const bool odd = (axes[0] > axes[1]) != ((axes[0] > axes[2]) != (axes[1] > axes[2]));
          if (odd) std::swap(tet.vertices[2], tet.vertices[3]);
          data.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return data;
}

/// Moves every point by up to `amount` in each direction; may turn tets over.
MeshData jittered(MeshData data, double amount) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-amount, amount);
  for (Point& p : data.points) p += Point(offset(random), offset(random), offset(random));
  return data;
}

/// A tet whose dihedral angle at edge 01, its first, is `degrees`.
MeshData wedge(double degrees) {
  const double turn = degrees * std::numbers::pi / 180;
  return single_tet(Point(0, 0, -0.7), Point(0, 0, 0.7), Point(1, 0, 0),
                    Point(std::cos(turn), std::sin(turn), 0));
}

std::size_t total(const std::array<std::size_t, 36>& histogram) {
  return std::accumulate(histogram.begin(), histogram.end(), std::size_t{0});
}

/// The definitions, literally.
MeshStatistics direct_statistics(const TetMesh& mesh) {
  MeshStatistics s;
  s.vertices = mesh.vertex_count();
  s.theta_min = 180;
  s.q_worst = 1;
  long double volume = 0;
  long double sum = 0;
  long double sum_bad = 0;
  std::array<std::size_t, 5> bands{};
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    ++s.tets;
    const auto& v = mesh.vertices(t);
    const Point& a = mesh.point(v[0]);
    const Point& b = mesh.point(v[1]);
    const Point& c = mesh.point(v[2]);
    const Point& d = mesh.point(v[3]);
    volume += static_cast<long double>(volume6(a, b, c, d)) / 6;
    if (volume6(a, b, c, d) < 0) ++s.inverted;
    for (unsigned f = 0; f < 4; ++f) s.boundary_triangles += mesh.is_boundary(HalfFace(t, f));
    for (const double angle : dihedral_angles(a, b, c, d)) {
      s.theta_min = std::min(s.theta_min, angle);
      s.theta_max = std::max(s.theta_max, angle);
      ++s.histogram[std::min<std::size_t>(35, static_cast<std::size_t>(angle / 5))];
      for (std::size_t i = 0; i < 5; ++i) {
        const double low = 6.0 * static_cast<double>(i);
        const double high = low + 6;
        if ((angle >= low && angle < high) || (angle > 180 - high && angle <= 180 - low))
          ++bands[i];
      }
    }
    const double q = minimum_sine(a, b, c, d);
    s.q_worst = std::min(s.q_worst, q);
    sum += q;
    if (q < 0.5) {
      ++s.n_bad;
      sum_bad += q;
    }
  }
  s.volume = static_cast<double>(volume);
  s.q_mean = static_cast<double>(sum) / static_cast<double>(s.tets);
  if (s.n_bad > 0) s.q_aver = static_cast<double>(sum_bad) / static_cast<double>(s.n_bad);
  for (std::size_t i = 0; i < 5; ++i) {
    s.lambda_bands[i] = 100.0 * static_cast<double>(bands[i]) / (6.0 * static_cast<double>(s.tets));
    s.lambda += s.lambda_bands[i];
  }
  return s;
}

void check_equal(const MeshStatistics& a, const MeshStatistics& b) {
  CHECK(a.tets == b.tets);
  CHECK(a.vertices == b.vertices);
  CHECK(a.boundary_triangles == b.boundary_triangles);
  CHECK(a.inverted == b.inverted);
  CHECK(a.flat == b.flat);
  CHECK(a.volume == doctest::Approx(b.volume).epsilon(1e-14));
  CHECK(a.theta_min == doctest::Approx(b.theta_min).epsilon(1e-13).scale(0));
  CHECK(a.theta_max == doctest::Approx(b.theta_max).epsilon(1e-13));
  CHECK(a.lambda == doctest::Approx(b.lambda).epsilon(1e-14));
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(a.lambda_bands[i] == doctest::Approx(b.lambda_bands[i]).epsilon(1e-14));
  }
  CHECK(a.q_worst == b.q_worst);
  CHECK(a.q_mean == doctest::Approx(b.q_mean).epsilon(1e-14));
  CHECK(a.n_bad == b.n_bad);
  CHECK(a.q_aver == doctest::Approx(b.q_aver).epsilon(1e-14));
  CHECK(a.histogram == b.histogram);
}

}  // namespace

TEST_CASE("a regular tet has six angles of 70.53 degrees and no bad one") {
  const MeshStatistics s = compute_statistics(
      TetMesh(single_tet(Point(1, 1, 1), Point(-1, 1, -1), Point(1, -1, -1), Point(-1, -1, 1))));
  CHECK(s.tets == 1);
  CHECK(s.vertices == 4);
  CHECK(s.boundary_triangles == 4);
  CHECK(s.volume == doctest::Approx(8.0 / 3));
  CHECK(s.theta_min == doctest::Approx(70.528779365509308630));
  CHECK(s.theta_max == doctest::Approx(70.528779365509308630));
  CHECK(s.lambda == 0);
  CHECK(s.q_worst == doctest::Approx(2 * std::numbers::sqrt2 / 3));
  CHECK(s.q_mean == s.q_worst);
  CHECK(s.n_bad == 0);
  CHECK(s.q_aver == 0);
  CHECK(s.histogram[14] == 6);
  CHECK(total(s.histogram) == 6);
}

TEST_CASE("a right corner has three angles of 90 degrees and three of 54.74") {
  const MeshStatistics s = compute_statistics(
      TetMesh(single_tet(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1))));
  CHECK(s.volume == doctest::Approx(1.0 / 6));
  CHECK(s.theta_min == doctest::Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi));
  CHECK(s.theta_max == 90);
  CHECK(s.q_worst == doctest::Approx(std::sqrt(2.0 / 3)));
  CHECK(s.histogram[10] == 3);
  CHECK(s.histogram[18] == 3);
  CHECK(total(s.histogram) == 6);
}

TEST_CASE("a cube of six Kuhn tets has angles of 45, 60 and 90 degrees, each in one bin") {
  for (const int n : {1, 3, 7}) {  // cells of 1/3 and 1/7: the angles are right up to rounding only
    const MeshStatistics s = compute_statistics(TetMesh(split_cubes(n)));
    const auto tets = static_cast<std::size_t>(6 * n * n * n);
    CAPTURE(n);
    CHECK(s.tets == tets);
    CHECK(s.vertices == static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)));
    CHECK(s.boundary_triangles == static_cast<std::size_t>(12 * n * n));
    CHECK(s.volume == doctest::Approx(1).epsilon(1e-14));
    CHECK(s.theta_min == doctest::Approx(45));
    CHECK(s.theta_max == doctest::Approx(90));
    CHECK(s.histogram[9] == 2 * tets);
    CHECK(s.histogram[12] == tets);
    CHECK(s.histogram[18] == 3 * tets);
    CHECK(total(s.histogram) == 6 * tets);
    CHECK(s.q_worst == doctest::Approx(std::numbers::sqrt2 / 2));
    CHECK(s.q_mean == doctest::Approx(std::numbers::sqrt2 / 2));
    CHECK(s.n_bad == 0);
    CHECK(s.q_aver == 0);
    CHECK(s.lambda == 0);
    CHECK(s.inverted == 0);
    CHECK(s.flat == 0);
  }
}

TEST_CASE("angles on the edge of a band count for the side that the definition closes") {
  struct Example {
    double degrees;
    int band;  // -1: none
  };
  const std::vector<Example> examples = {
      {3, 0},    {6, 1},       {11.99, 1}, {12, 2},  {18, 3},  {24, 4},  {30, 4},  {30.01, -1},
      {149, -1}, {149.99, -1}, {150, 4},   {156, 4}, {162, 3}, {168, 2}, {174, 1}, {174.01, 0},
  };
  for (const Example& example : examples) {
    CAPTURE(example.degrees);
    const TetMesh mesh(wedge(example.degrees));
    // The other five angles are counted directly; they are nowhere near an edge of a band.
    std::array<double, 5> count{};
    const auto angles = dihedral_angles(mesh.point(VertexHandle(0)), mesh.point(VertexHandle(1)),
                                        mesh.point(VertexHandle(2)), mesh.point(VertexHandle(3)));
    for (std::size_t e = 1; e < 6; ++e) {
      const double distance = std::min(angles[e], 180 - angles[e]);
      if (distance < 30) ++count[static_cast<std::size_t>(distance / 6)];
    }
    if (example.band >= 0) ++count[static_cast<std::size_t>(example.band)];
    const MeshStatistics s = compute_statistics(mesh);
    for (std::size_t i = 0; i < 5; ++i) {
      CHECK(s.lambda_bands[i] == doctest::Approx(100 * count[i] / 6));
    }
  }
}

TEST_CASE("every multiple of five degrees falls into the bin that it opens") {
  for (int degrees = 5; degrees < 180; degrees += 5) {
    CAPTURE(degrees);
    const auto bin = static_cast<std::size_t>(degrees / 5);
    const auto count = [&](double angle) {
      return compute_statistics(TetMesh(wedge(angle))).histogram[bin];
    };
    CHECK(count(degrees) == count(degrees + 1e-6));
    CHECK(count(degrees) == count(degrees - 1e-6) + 1);
    CHECK(count(degrees) == count(degrees - 1e-11));
  }
}

TEST_CASE("a flat tet is counted as flat and has angles of 0 and 180 degrees") {
  const MeshStatistics s = compute_statistics(
      TetMesh(single_tet(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0))));
  CHECK(s.flat == 1);
  CHECK(s.inverted == 0);
  CHECK(s.volume == 0);
  CHECK(s.theta_min == 0);
  CHECK(s.theta_max == 180);
  CHECK(s.lambda == 100);
  CHECK(s.lambda_bands[0] == 100);
  CHECK(s.q_worst == 0);
  CHECK(s.n_bad == 1);
  CHECK(s.histogram[0] == 4);
  CHECK(s.histogram[35] == 2);
}

TEST_CASE("a tet with a collapsed face has finite statistics") {
  MeshData data = split_cubes(1);
  data.points[data.tets[0].vertices[1]] = data.points[data.tets[0].vertices[0]];
  const MeshStatistics s = compute_statistics(TetMesh(data));
  CHECK(s.flat > 0);
  CHECK(s.theta_min == 0);
  CHECK(s.q_worst == 0);
  CHECK(std::isfinite(s.theta_max));
  CHECK(std::isfinite(s.lambda));
  CHECK(total(s.histogram) == 36);
}

TEST_CASE(
    "an inverted tet counts with negative quality and volume, and its mirror image's angles") {
  MeshData data = split_cubes(2);
  const std::uint32_t centre = grid_index(1, 1, 1, 2);
  data.points[centre] = Point(0.5, 0.5, 1.1);  // through the lid: the tets between turn over
  const TetMesh mesh(data);
  const MeshStatistics s = compute_statistics(mesh);
  CHECK(s.inverted > 0);
  CHECK(s.q_worst < 0);
  CHECK(s.volume == doctest::Approx(1));

  data = jittered(data, 0.02);  // no angle on the edge of a bin, where rounding would decide
  const TetMesh uneven(data);
  CHECK(compute_statistics(uneven).inverted > 0);
  check_equal(compute_statistics(uneven), direct_statistics(uneven));
}

TEST_CASE("statistics of a jittered grid agree with the definitions") {
  for (const double amount : {0.01, 0.03, 0.06, 0.2}) {
    const TetMesh mesh(jittered(split_cubes(8), amount));
    CAPTURE(amount);
    check_equal(compute_statistics(mesh), direct_statistics(mesh));
  }
}

TEST_CASE("the five bands add up to lambda") {
  const MeshStatistics s = compute_statistics(TetMesh(jittered(split_cubes(6), 0.05)));
  CHECK(s.lambda > 1);
  const double sum = std::accumulate(s.lambda_bands.begin(), s.lambda_bands.end(), 0.0);
  CHECK(sum == doctest::Approx(s.lambda).epsilon(1e-14));
}

TEST_CASE("the volume is right to 13 digits far away from the origin and with many tets") {
  MeshData data = split_cubes(16);
  for (Point& p : data.points) p = 16 * p + Point(1024, -2048, 4096);  // whole numbers: no rounding
  const MeshStatistics s = compute_statistics(TetMesh(data));
  CHECK(s.volume == doctest::Approx(4096).epsilon(1e-14).scale(0));

  data = split_cubes(20);
  for (Point& p : data.points) p *= 20 * 0.1;
  CHECK(compute_statistics(TetMesh(data)).volume == doctest::Approx(8).epsilon(1e-14).scale(0));
}

TEST_CASE("statistics do not depend on the order of the tets beyond rounding") {
  TetMesh mesh(jittered(split_cubes(6), 0.04));
  const MeshStatistics before = compute_statistics(mesh);
  mesh.sort_spatially();
  check_equal(compute_statistics(mesh), before);
}

TEST_CASE("deleted slots do not count") {
  // Two tets on a common triangle become three around the edge that joins their tips.
  MeshData data;
  data.points = {Point(1, 0, 0), Point(-0.5, 0.9, 0), Point(-0.5, -0.9, 0), Point(0, 0, 1),
                 Point(0, 0, -1)};
  data.tets = {{{0, 1, 2, 3}}, {{0, 2, 1, 4}}};
  TetMesh mesh(data);
  const MeshStatistics before = compute_statistics(mesh);
  Workspace workspace(mesh);
  const auto v = [](std::uint32_t i) { return VertexHandle(i); };
  Transaction there(mesh, workspace);
  const std::vector<TetHandle> two = {TetHandle(0), TetHandle(1)};
  const std::vector<TetVertices> three = {
      {v(4), v(3), v(0), v(1)}, {v(4), v(3), v(1), v(2)}, {v(4), v(3), v(2), v(0)}};
  REQUIRE(there.replace_cavity(two, three) == EditResult::made);
  CHECK(compute_statistics(mesh).tets == 3);
  const std::vector<TetHandle> created(there.created().begin(), there.created().end());
  const std::vector<TetVertices> back = {{v(0), v(1), v(2), v(3)}, {v(0), v(2), v(1), v(4)}};
  REQUIRE(there.replace_cavity(created, back) == EditResult::made);
  there.keep();
  REQUIRE(mesh.tet_slots() > mesh.tet_count());
  check_equal(compute_statistics(mesh), before);
  CHECK(quality_indicators(mesh).q_worst == doctest::Approx(2 * before.q_worst));
  CHECK(summarize(mesh, quality_measures().front()).mean == doctest::Approx(before.q_mean));
}

TEST_CASE("an empty mesh has statistics of zero") {
  const TetMesh empty;
  const MeshStatistics s = compute_statistics(empty);
  CHECK(s.tets == 0);
  CHECK(s.theta_min == 0);
  CHECK(s.theta_max == 0);
  CHECK(s.lambda == 0);
  CHECK(s.q_worst == 0);
  CHECK(s.q_mean == 0);
  CHECK(s.q_aver == 0);
  CHECK(total(s.histogram) == 0);
  CHECK(quality_indicators(empty).q_worst == 0);
  CHECK(summarize(empty, quality_measures().front()).worst == 0);
}

TEST_CASE("coordinates whose products overflow still give one entry for each angle") {
  MeshData data = split_cubes(1);
  for (Point& p : data.points) p *= 1e150;
  CHECK(total(compute_statistics(TetMesh(data)).histogram) == 36);
}

TEST_CASE("bad tets and lambda are those of the goal asked for") {
  const TetMesh mesh(jittered(split_cubes(8), 0.04));
  for (const Goal goal : {Goal{35, 140}, Goal{15, 168}, Goal{25.1, 150}}) {
    CAPTURE(goal.min_angle);
    std::size_t n_bad = 0;
    std::size_t outside = 0;
    std::array<std::size_t, 5> bands{};
    for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
      const TetVertices& v = mesh.vertices(TetHandle(slot));
      std::size_t of_tet = 0;
      for (const double angle : dihedral_angles(mesh.point(v[0]), mesh.point(v[1]),
                                                mesh.point(v[2]), mesh.point(v[3]))) {
        if (angle > goal.min_angle && angle < goal.max_angle) continue;
        const double share = angle <= goal.min_angle ? angle / goal.min_angle
                                                     : (180 - angle) / (180 - goal.max_angle);
        ++bands[static_cast<std::size_t>(5 * share)];
        ++of_tet;
      }
      outside += of_tet;
      n_bad += of_tet > 0 ? 1 : 0;
    }
    REQUIRE(n_bad > 0);
    const MeshStatistics s = compute_statistics(mesh, goal);
    const double angles = 6 * static_cast<double>(mesh.tet_count());
    CHECK(s.n_bad == n_bad);
    CHECK(s.lambda == doctest::Approx(100 * static_cast<double>(outside) / angles));
    for (std::size_t i = 0; i < 5; ++i) {
      CHECK(s.lambda_bands[i] == doctest::Approx(100 * static_cast<double>(bands[i]) / angles));
    }
    CHECK(s.histogram == direct_statistics(mesh).histogram);
  }
}

TEST_CASE("quality indicators from the cache agree with the statistics") {
  TetMesh mesh(jittered(split_cubes(6), 0.05));
  mesh.set_standard(Standard(Goal{}, Standard::Terms::sine));
  const MeshStatistics s = compute_statistics(mesh);
  const QualityIndicators indicators = quality_indicators(mesh);
  REQUIRE(s.n_bad > 0);
  CHECK(indicators.n_bad == s.n_bad);
  CHECK(indicators.q_worst == doctest::Approx(2 * s.q_worst).epsilon(1e-6));
  CHECK(indicators.q_aver == doctest::Approx(2 * s.q_aver).epsilon(1e-6));

  const QualityIndicators good = quality_indicators(TetMesh(split_cubes(2)));
  CHECK(good.n_bad == 0);
  CHECK(good.q_aver == 0);
  CHECK(good.q_worst == doctest::Approx(std::numbers::sqrt2));
}

TEST_CASE("quality indicators leave frozen tets out, the statistics do not") {
  TetMesh mesh(jittered(split_cubes(6), 0.05));
  const MeshStatistics s = compute_statistics(mesh);
  const auto worst = [&](TetHandle t) { return mesh.quality(t) < s.q_worst + 0.1; };
  const std::size_t frozen = mesh.freeze(worst);
  REQUIRE(frozen > 0);
  REQUIRE(frozen < s.n_bad);
  const QualityIndicators indicators = quality_indicators(mesh);
  CHECK(indicators.n_bad == s.n_bad - frozen);
  CHECK(indicators.q_worst >= s.q_worst + 0.1);
  CHECK(indicators.q_aver > s.q_aver);
  check_equal(compute_statistics(mesh), s);
  mesh.freeze([](TetHandle) { return true; });
  CHECK(quality_indicators(mesh).n_bad == 0);
  CHECK(quality_indicators(mesh).q_worst == 0);
}

TEST_CASE("any quality measure can be summarized over a mesh") {
  const TetMesh mesh(jittered(split_cubes(4), 0.02));
  for (const QualityMeasure& measure : quality_measures()) {
    const MeasureSummary summary = summarize(mesh, measure);
    CAPTURE(measure.name);
    CHECK(summary.name == measure.name);
    CHECK(summary.worst < summary.mean);
    CHECK(summary.mean < measure.best);
  }
  const MeshStatistics s = compute_statistics(mesh);
  CHECK(summarize(mesh, find_quality_measure("min_sine")).worst == s.q_worst);
  CHECK(summarize(mesh, find_quality_measure("min_sine")).mean == doctest::Approx(s.q_mean));
  CHECK(summarize(mesh, find_quality_measure("min_angle")).worst == doctest::Approx(s.theta_min));
}

TEST_CASE("statistics are the same, bit for bit, for every number of threads") {
  const TetMesh mesh(
      jittered(split_cubes(17), 0.03));  // 29478 tets: two chunks, the second not full
  REQUIRE(mesh.tet_slots() > kChunkSize);
  const auto all_of = [&](int threads) {
    return on_threads(threads, [&] {
      const MeshStatistics s = compute_statistics(mesh);
      const QualityIndicators i = quality_indicators(mesh);
      std::vector<double> values = {s.volume, s.theta_min, s.theta_max, s.lambda, s.q_worst,
                                    s.q_mean, s.q_aver,    i.q_worst,   i.q_aver};
      for (const std::size_t count :
           {s.boundary_triangles, s.inverted, s.flat, s.n_bad, i.n_bad, count_not_positive(mesh)}) {
        values.push_back(static_cast<double>(count));
      }
      values.insert(values.end(), s.lambda_bands.begin(), s.lambda_bands.end());
      values.insert(values.end(), s.histogram.begin(), s.histogram.end());
      for (const QualityMeasure& measure : quality_measures()) {
        values.push_back(summarize(mesh, measure).mean);
        values.push_back(summarize(mesh, measure).worst);
      }
      return std::pair(values, surface_fingerprint(mesh));
    });
  };
  const auto expected = all_of(1);
  CHECK(all_of(2) == expected);
  CHECK(all_of(5) == expected);
  check_equal(compute_statistics(mesh), direct_statistics(mesh));
}
