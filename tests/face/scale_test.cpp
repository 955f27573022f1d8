// SPDX-License-Identifier: MIT
// Meshes from 1e-150 to 1e150: improved, measured and traced like those of ordinary size.
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/second_order.h"
#include "trace/replay.h"
#include "trace/trace_file.h"

using namespace tetmend;
using namespace tetmend::contract;
using namespace tetmend::test;

namespace {

Mesh multiplied(MeshData data, double factor) {
  for (Point& p : data.points) p *= factor;
  return MeshAccess::make(std::move(data));
}

using Points = std::vector<std::array<double, 3>>;

Points multiplied(Points points, double factor) {
  for (auto& p : points) {
    for (double& x : p) x *= factor;
  }
  return points;
}

}  // namespace

TEST_CASE("a mesh multiplied by a power of two is improved to the same mesh, bit for bit") {
  const MeshData data = kuhn_cube(4, 0.35, 7);
  Mesh plain = multiplied(data, 1);
  const Result expected = improve(plain, {.limit = true});
  REQUIRE(expected.after.n_bad < expected.before.n_bad);
  for (const int exponent : {-498, -60, 60, 498}) {
    CAPTURE(exponent);
    const double factor = std::ldexp(1.0, exponent);
    Mesh mesh = multiplied(data, factor);
    const Result result = improve(mesh, {.limit = true});
    CHECK(mesh.arrays().points == multiplied(plain.arrays().points, factor));
    CHECK(mesh.arrays().tets == plain.arrays().tets);
    CHECK(result.after.theta_min == expected.after.theta_min);
    CHECK(result.after.n_bad == expected.after.n_bad);
    CHECK(result.volume_change() == expected.volume_change());
    CHECK(result.size_drift->median == expected.size_drift->median);
    CHECK(result.rulers_after->shortest_edge == factor * expected.rulers_after->shortest_edge);
    CHECK(result.worse().empty());
    CHECK(result.limit->n_bad == expected.limit->n_bad);
  }
}

TEST_CASE("a mesh multiplied by a power of ten is as good before and after") {
  const MeshData data = kuhn_cube(4, 0.35, 7);
  Mesh plain = multiplied(data, 1);
  const Result expected = improve(plain, {});
  for (const double factor : {1e-150, 1e-30, 1e30, 1e150}) {
    CAPTURE(factor);
    Mesh mesh = multiplied(data, factor);
    const Result result = improve(mesh, {});
    CHECK(result.before.n_bad == expected.before.n_bad);
    CHECK(result.before.theta_min == doctest::Approx(expected.before.theta_min));
    CHECK(result.after.n_bad == expected.after.n_bad);
    CHECK(result.volume_change() < 1e-12);
    CHECK(std::isfinite(result.rulers_after->shortest_edge));
  }
}

TEST_CASE("places are told, and asked for, in the lengths of the user") {
  const double factor = 0x1p400;
  const MeshData data = kuhn_cube(3, 0.4, 5);
  const Measurement plain = measure(multiplied(data, 1), {.bad_tets = true});
  const Measurement large = measure(multiplied(data, factor), {.bad_tets = true});
  REQUIRE(!plain.bad_tets.empty());
  REQUIRE(large.bad_tets.size() == plain.bad_tets.size());
  CHECK(large.bad_tets[0].centre[0] == factor * plain.bad_tets[0].centre[0]);

  const auto touched = [&](double by) {
    Mesh mesh = multiplied(data, by);
    const std::string box = fmt::format("box:{0},{0},{0},{1},{1},{1}", -0.1 * by, 0.85 * by);
    return improve(mesh, {.only = {box}}).touched_tets;
  };
  CHECK(touched(1) > 0);
  CHECK(touched(factor) == touched(1));
}

TEST_CASE("data that a mesh carries come over at any scale") {
  MeshData data = kuhn_cube(3, 0.4, 5);
  DataArray heat{"heat", 1, std::vector<double>(data.points.size())};
  auto& values = std::get<std::vector<double>>(heat.values);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = data.points[i].x();
  DataArray share{"share", 1, std::vector<double>(data.tets.size(), 2.5)};
  data.point_data = {heat};
  data.tet_data = {share};
  Mesh plain = multiplied(data, 1);
  const Result expected = improve(plain, {.conserve = {"share"}});
  Mesh mesh = multiplied(data, 0x1p-480);
  const Result result = improve(mesh, {.conserve = {"share"}});
  CHECK(MeshAccess::data(mesh).point_data == MeshAccess::data(plain).point_data);
  CHECK(MeshAccess::data(mesh).tet_data == MeshAccess::data(plain).tet_data);
  REQUIRE(result.carried.size() == expected.carried.size());
  CHECK(result.carried[0].integral_error == expected.carried[0].integral_error);
}

TEST_CASE("curved tets bend at any scale, and their mid-side nodes keep their bits") {
  const MeshData data = second_order(kuhn_cube(2, 0.2, 5), 0.05);
  Mesh plain = multiplied(data, 1);
  const Result expected = improve(plain, {});
  REQUIRE(expected.curved_before->curved > 0);
  Mesh mesh = multiplied(data, 0x1p450);
  const Result result = improve(mesh, {});
  CHECK(result.curved_before->worst.at_nodes == expected.curved_before->worst.at_nodes);
  CHECK(result.curved_after->worst.at_nodes == expected.curved_after->worst.at_nodes);
  CHECK(mesh.arrays().points == multiplied(plain.arrays().points, 0x1p450));
  const Measurement measured = measure(mesh);
  CHECK(measured.curved->worst.at_nodes == result.curved_after->worst.at_nodes);
}

TEST_CASE("the mesh of a trace has the lengths of the user, at every event") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "scale.trace";
  Mesh mesh = multiplied(kuhn_cube(3, 0.4, 5), 0x1p-450);
  const Points before = mesh.arrays().points;
  improve(mesh, {.trace = file, .trace_around = "0"});
  const TraceFile trace(file);
  REQUIRE(trace.event_count() > 0);
  Replay replay(trace, 0);
  double largest = 0;
  for (const Point& p : replay.mesh().to_data().points) {
    largest = std::max(largest, p.maxCoeff());
  }
  CHECK(largest == 0x1p-450);
}

TEST_CASE("a mesh out of range is refused and stays what it was") {
  const MeshData data = kuhn_cube(2, 0.2, 5);
  for (const double factor : {1e300, 1e-300, 1e-310}) {
    CAPTURE(factor);
    Mesh mesh = multiplied(data, factor);
    const Points before = mesh.arrays().points;
    const std::string message = message_of([&] { improve(mesh, {}); });
    CHECK(message.find(factor > 1 ? "too large" : "too small") != std::string::npos);
    CHECK(mesh.arrays().points == before);
  }
}
