// SPDX-License-Identifier: MIT
// Measures and operators of a program in all that works on a mesh: qualities, attempts, passes, schedules, improve(),
// sessions, traces.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/trace.h>

#include "contract/zoo.h"
#include "face/kernel/run.h"
#include "face/kernel/transaction.h"
#include "face/mesh_access.h"
#include "kernel/quality.h"
#include "tests/face/meshes.h"
#include "tests/face/own_flip.h"
#include "tests/kernel/formats/fixtures.h"

namespace tetmend::kernel {

using tetmend::test::message_of;

namespace {

/// Height over the longest edge, 1 for a regular tet: no measure of tetmend.
double flatness(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<Point, 4> p = {a, b, c, d};
  double longest = 0, largest = 0;
  for (const auto& [i, j] : kEdgeVertices) longest = std::max(longest, (p[i] - p[j]).norm());
  for (const auto& [i, j, k] : kFaceVertices) {
    largest = std::max(largest, (p[j] - p[i]).cross(p[k] - p[i]).norm());
  }
  return std::sqrt(1.5) * volume6(a, b, c, d) / (largest * longest);
}

constexpr double kGood = 0.35;

OwnMeasure own_measure() {
  return {"flatness", kGood, flatness};
}

Mesh ball_mesh() {
  return tetmend::MeshAccess::make(contract::delaunay_ball(300, 1));
}

std::size_t count_bad(const TetMesh& mesh, double good) {
  std::size_t count = 0;
  for (const TetHandle t : mesh.tets()) {
    const auto p = mesh.points(t);
    count += flatness(p[0], p[1], p[2], p[3]) < good ? 1 : 0;
  }
  return count;
}

std::size_t count_bad(const Mesh& mesh, double good) {
  return count_bad(TetMesh(mesh), good);
}

Operators own_flip() {
  Operators own;
  own.add("my_flip", "three tets of an edge become two", test::flip_to_two);
  return own;
}

}  // namespace

TEST_CASE("a mesh is judged by a measure of the program, with the sign of the volume") {
  TetMesh mesh(ball_mesh());
  mesh.set_standard(Standard::of(own_measure()));
  CHECK(mesh.standard().measure_name() == "flatness");
  std::size_t bad = 0;
  for (const TetHandle t : mesh.tets()) {
    const auto p = mesh.points(t);
    const double value = flatness(p[0], p[1], p[2], p[3]);
    CHECK(mesh.quality(t) == doctest::Approx(value / kGood).epsilon(1e-6));
    bad += mesh.quality(t) < 1 ? 1 : 0;
  }
  CHECK(bad == count_bad(mesh, kGood));
  const Standard standard = mesh.standard();
  const Point o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(standard.quality(o, x, y, z) > 0);
  CHECK(standard.quality(o, y, x, z) == -standard.quality(o, x, y, z));
  CHECK(standard.quality(o, x, y, x + y) == 0);
  const Standard odd = Standard::of({"odd", 1, [](auto&&...) { return std::nan(""); }});
  CHECK(odd.quality(o, x, y, z) == 0);
  CHECK(odd.quality(o, y, x, z) < 0);
}

TEST_CASE("measures without sense are refused by name") {
  const auto message = [](OwnMeasure measure) {
    return message_of([&] { Standard::of(std::move(measure)); });
  };
  CHECK(message({"My Measure", 1, flatness}).find("a-z") != std::string::npos);
  CHECK(message({"sine", 1, flatness}).find("taken") != std::string::npos);
  CHECK(message({"flatness", 0, flatness}).find("above 0") != std::string::npos);
  CHECK(message({"flatness", std::nan(""), flatness}).find("above 0") != std::string::npos);
  Operators own;
  own.add_measure(own_measure());
  CHECK(message_of([&] { own.add_measure(own_measure()); }).find("twice") != std::string::npos);
}

TEST_CASE("attempts and passes make better what a measure of the program says") {
  TetMesh mesh(ball_mesh());
  mesh.set_standard(Standard::of(own_measure()));
  const std::size_t before = count_bad(mesh, kGood);
  REQUIRE(before > 20);
  std::size_t accepted = 0;
  for (const VertexHandle v : mesh.vertices()) {
    const Call call = attempt(mesh, "smoothing", v);
    if (!call.accepted()) continue;
    ++accepted;
    CHECK(call.worst_after > call.worst_before);
  }
  CHECK(accepted > 0);
  Run run(mesh, {.threads = 2});
  CHECK(run.indicators().n_bad == count_bad(mesh, kGood));
  run.local_reconnection();
  run.smooth();
  run.insert_points();
  run.polish();
  const std::size_t after = count_bad(mesh, kGood);
  CHECK(run.indicators().n_bad == after);
  CHECK(4 * after < 3 * before);
  CHECK(mesh.check().empty());
}

TEST_CASE("a measure of the program is known by its name to options, scripts, reports and traces") {
  const tetmend::test::TempFolder folder;
  Operators own;
  const Standard standard = own.add_measure(own_measure());
  Mesh mesh = ball_mesh();
  const std::size_t before = count_bad(mesh, kGood);
  const std::filesystem::path trace = folder / "run.trace";
  const tetmend::Result result = tetmend::improve(
      mesh, {.schedule = "shell", .operators = &own, .measure = "flatness", .trace = trace});
  CHECK(count_bad(mesh, kGood) < before);
  CHECK(result.passes.back().after.n_bad == count_bad(mesh, kGood));
  const tetmend::Trace recorded(trace);
  CHECK(recorded.summary().find("by flatness") != std::string::npos);

  Mesh other = ball_mesh();
  tetmend::improve(other,
                   {.script = "judge_by{measure = \"flatness\"} smooth{} local_reconnection{}",
                    .operators = &own});
  CHECK(count_bad(other, kGood) < before);
  const std::string unknown =
      message_of([&] { tetmend::improve(other, {.operators = &own, .measure = "flatnes"}); });
  CHECK(unknown.find("sine, sine_and_length, flatness; did you mean 'flatness'?") !=
        std::string::npos);
}

namespace {

/// Each tet of the mesh after n events has the quality that the run had for it, bit for bit.
void check_qualities_at(const tetmend::Trace& trace, std::uint64_t n) {
  CAPTURE(n);
  const Mesh then = trace.mesh_at(n);
  const std::vector<float> qualities = trace.quality_at(n);
  REQUIRE(qualities.size() == then.tet_count());
  const Standard standard = Standard::of(own_measure());
  std::size_t others = 0;
  for (std::size_t t = 0; t < qualities.size(); ++t) {
    std::array<Point, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = Point(then.points()[then.tets()[t][i]].data());
    others += qualities[t] == static_cast<float>(standard.quality(p[0], p[1], p[2], p[3])) ? 0 : 1;
  }
  CHECK(others == 0);
}

}  // namespace

TEST_CASE("a trace has the quality of each tet by a measure of the program, at every moment") {
  const tetmend::test::TempFolder folder;
  TetMesh mesh(ball_mesh());
  mesh.set_standard(Standard::of(own_measure()));
  const std::filesystem::path file = folder / "passes.trace";
  {
    Run run(mesh, {.trace = file});
    run.local_reconnection();
    run.smooth();
    CHECK_FALSE(std::filesystem::exists(file));
    run.finish_trace();
    run.polish();  // is not in it
  }
  const tetmend::Trace trace(file);
  CHECK(trace.measure() == "flatness");
  CHECK(trace.pass_count() == 2);
  REQUIRE(trace.event_count() > 1000);
  for (std::uint64_t n = 0; n <= trace.event_count(); n += trace.event_count() / 29) {
    check_qualities_at(trace, n);
  }
  check_qualities_at(trace, trace.event_count());
}

TEST_CASE("a measure that a schedule changes to is in the trace from then on") {
  const tetmend::test::TempFolder folder;
  Operators own;
  own.add_measure(own_measure());
  Mesh mesh = ball_mesh();
  const std::filesystem::path file = folder / "run.trace";
  tetmend::improve(mesh, {.script = "smooth{} judge_by{measure = \"flatness\"} smooth{}",
                          .operators = &own,
                          .trace = file});
  const tetmend::Trace trace(file);
  CHECK(trace.measure() == "sine_and_length");
  REQUIRE(trace.pass_count() == 2);
  const std::uint64_t changed = trace.pass(1).events.begin;
  check_qualities_at(trace, changed);
  check_qualities_at(trace, (changed + trace.event_count()) / 2);
  check_qualities_at(trace, trace.event_count());
  const TetMesh before(trace.mesh_at(changed - 1));  // by the angles
  std::vector<float> angles;
  for (const TetHandle t : before.tets()) angles.push_back(before.quality(t));
  CHECK(trace.quality_at(changed - 1) == angles);
}

TEST_CASE("a trace of passes ends where the program itself changes the mesh") {
  const tetmend::test::TempFolder folder;
  TetMesh mesh(ball_mesh());
  Run run(mesh, {.trace = folder / "passes.trace"});
  run.smooth();
  attempt(mesh, "smoothing", VertexHandle(0));
  CHECK(message_of([&] { run.smooth(); }).find("something else than passes") != std::string::npos);
  run.finish_trace();
  run.smooth();
  CHECK(tetmend::Trace(folder / "passes.trace").pass_count() == 1);
}

TEST_CASE("the result by a measure of the program is the same for every number of threads") {
  std::vector<std::vector<std::array<double, 3>>> points;
  for (const int threads : {1, 3}) {
    TetMesh mesh(tetmend::MeshAccess::make(contract::delaunay_ball(1500, 1)));
    mesh.set_standard(Standard::of(own_measure()));
    Run run(mesh, {.threads = threads});
    run.local_reconnection();
    run.smooth();
    const Mesh out = mesh.to_mesh();
    points.emplace_back(out.points().begin(), out.points().end());
  }
  CHECK(points[0] == points[1]);
}

TEST_CASE("operators of a program are tried by improve() and by a session") {
  const Operators own = own_flip();
  const char* const script = "apply({\"my_flip\"}, {on = {}})";
  Mesh mesh = ball_mesh();
  const tetmend::Result result =
      tetmend::improve(mesh, {.script = script, .operators = &own, .threads = 3});
  CHECK(result.passes.front().accepted() > 0);
  Mesh again = ball_mesh();
  tetmend::improve(again, {.script = script, .operators = &own});
  CHECK(std::ranges::equal(mesh.tets(), again.tets()));

  tetmend::Improver session(ball_mesh(), {.script = script, .operators = &own});
  CHECK(session.improve().accepted == result.passes.front().accepted());
  CHECK(session.tet_count() == mesh.tet_count());
}

}  // namespace tetmend::kernel
