// SPDX-License-Identifier: MIT
// A mesh in a solver's loop: what a step touches, when it ends, what comes over.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

#include "tests/face/meshes.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using SessionPoints = std::vector<std::array<double, 3>>;

SessionPoints points_of(const Improver& session) {
  const auto points = session.mesh().points();
  return {points.begin(), points.end()};
}

/// Presses points towards z = 0, the less the larger x is, and none where it is above `to`.
SessionPoints pressed(SessionPoints points, unsigned n, double to) {
  for (auto& [x, y, z] : points) {
    const double weight = std::max(0.0, 1 - x / to);
    z -= weight * 0.18 * n * std::sin(std::numbers::pi * z / n);
  }
  return points;
}

bool are_same(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.points(), b.points()) && std::ranges::equal(a.tets(), b.tets());
}

std::size_t count_gone(const std::vector<std::uint32_t>& map) {
  return static_cast<std::size_t>(std::count(map.begin(), map.end(), kGone));
}

}  // namespace

TEST_CASE(
    "a session tries all bad tets in its first step, and none in a second one without a move") {
  Improver session(Mesh(shaken_cube(6, 1.1)));
  const ImproverStep first = session.improve();
  CHECK(first.bad_tets > 20);
  CHECK(first.after.n_bad < first.before.n_bad / 2);
  CHECK(first.is_complete);
  CHECK(measure(session.mesh()).statistics.inverted == 0);
  const SessionPoints points = points_of(session);
  const ImproverStep second = session.improve();
  CHECK(second.bad_tets == 0);
  CHECK(second.attempts == 0);
  CHECK(second.touched_tets == 0);
  CHECK(points_of(session) == points);
}

TEST_CASE("a step of a session works only where the mesh got bad") {
  constexpr unsigned kCells = 12;
  Improver session(Mesh(shaken_cube(kCells, 0.3)));
  session.improve();
  const Mesh before = session.mesh();
  REQUIRE(session.move(pressed(points_of(session), kCells, 4)));
  const SessionPoints moved = points_of(session);
  const ImproverStep step = session.improve();
  CHECK(step.bad_tets > 0);
  CHECK(step.after.n_bad < step.before.n_bad);
  CHECK(step.touched_tets > 0);
  CHECK(step.touched_tets < session.tet_count() / 2);
  // What is far from there is the same, bit for bit; the rest is told by the maps.
  const auto now = session.mesh().points();
  for (std::size_t v = 0; v < moved.size(); ++v) {
    if (moved[v][0] < 8) continue;
    REQUIRE(step.vertex_map[v] != kGone);
    CHECK(now[step.vertex_map[v]] == moved[v]);
  }
  std::size_t stayed = 0;
  for (std::size_t t = 0; t < before.tet_count(); ++t) {
    if (step.tet_map[t] == kGone) continue;
    ++stayed;
    std::set<std::uint32_t> then, corners;
    for (const std::uint32_t v : before.tets()[t]) then.insert(step.vertex_map[v]);
    for (const std::uint32_t v : session.mesh().tets()[step.tet_map[t]]) corners.insert(v);
    CHECK(then == corners);
  }
  CHECK(stayed + count_gone(step.tet_map) == before.tet_count());
  CHECK(count_gone(step.tet_map) > 0);
}

TEST_CASE(
    "a step ends by its number of attempts, with the same bytes for every number of threads") {
  const MeshArrays cube = shaken_cube(26, 0.9);  // large enough to be divided among threads
  const auto improved = [&](int threads, std::size_t attempts, ImproverStep& step) {
    Improver session(Mesh(cube), {.threads = threads});
    step = session.improve(attempts);
    return session.mesh();
  };
  ImproverStep whole, some, by_three;
  improved(1, Improver::kAnyNumber, whole);
  REQUIRE(whole.is_complete);
  const std::size_t few = whole.attempts / 10;
  const Mesh by_one = improved(1, few, some);
  CHECK_FALSE(some.is_complete);
  CHECK(some.ending == Ending::finished);
  CHECK(some.attempts <= few + 64);
  CHECK(some.attempts > few / 2);
  CHECK(some.accepted > 0);
  CHECK(are_same(by_one, improved(3, few, by_three)));
  CHECK(by_three.attempts == some.attempts);
  ImproverStep none;
  const Mesh untouched = improved(1, 0, none);
  CHECK(none.attempts == 0);
  CHECK_FALSE(none.is_complete);
  CHECK(are_same(untouched, Improver(Mesh(cube)).mesh()));
}

TEST_CASE("where attempts ran out, the next step goes on") {
  Improver session(Mesh(shaken_cube(8, 1.0)));
  ImproverStep step = session.improve(300);
  CHECK_FALSE(step.is_complete);
  const std::size_t left = step.after.n_bad;
  for (unsigned i = 0; i < 200 && !step.is_complete; ++i) step = session.improve(300);
  CHECK(step.is_complete);
  CHECK(step.after.n_bad < left / 4);
  Improver at_once(Mesh(shaken_cube(8, 1.0)));
  CHECK(step.after.n_bad <= 2 * at_once.improve().after.n_bad + 5);
}

TEST_CASE("five steps of a session cost fewer attempts than one whole run") {
  constexpr unsigned kCells = 8;
  Mesh mesh{shaken_cube(kCells, 1.0)};
  Mesh whole = mesh;
  std::size_t attempts_of_run = 0;
  for (const Pass& pass : improve(whole, {.purpose = "implicit"}).passes) {
    attempts_of_run += pass.attempts();
  }
  Improver session(std::move(mesh));
  std::size_t attempts = 0;
  for (int i = 0; i < 5; ++i) {
    SessionPoints points = points_of(session);
    for (auto& [x, y, z] : points) x += 0.1 * std::sin(y + 0.3 * i);
    REQUIRE(session.move(points));
    attempts += session.improve().attempts;
    CHECK(measure(session.mesh()).statistics.inverted == 0);
  }
  CHECK(attempts < attempts_of_run);
}

TEST_CASE("a move that would turn a tet over is refused, and nothing has moved") {
  Improver session(Mesh(shaken_cube(4, 0.2)));
  SessionPoints points = points_of(session);
  const SessionPoints before = points;
  points[62][0] += 3;
  CHECK_FALSE(session.move(points));
  CHECK(points_of(session) == before);
  CHECK(message_of([&] { session.move(std::span(points).first(7)); }) ==
        "move: 7 points, the mesh has 125");
  points[3][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(message_of([&] { session.move(points); }).starts_with("move: points[3]: (3, nan, 0) is"));
  CHECK(points_of(session) == before);
}

TEST_CASE("a session moves the surface with the program, and keeps it otherwise") {
  Improver session(Mesh(shaken_cube(5, 1.0)));
  SessionPoints points = points_of(session);
  for (auto& [x, y, z] : points) x *= 1 + 0.1 * z;
  REQUIRE(session.move(points));
  const ImproverStep step = session.improve();
  CHECK(step.accepted > 0);
  const auto now = session.mesh().points();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double z = points[v][2];
    const double x = points[v][0] / (1 + 0.1 * z);
    const bool is_inner =
        x > 1e-9 && x < 5 - 1e-9 && points[v][1] > 0 && points[v][1] < 5 && z > 0 && z < 5;
    if (!is_inner) CHECK(now[step.vertex_map[v]] == points[v]);
  }
}

TEST_CASE("vertices that must stay now stay, and are free again later") {
  Improver session(Mesh(shaken_cube(6, 1.0)));
  const SessionPoints points = points_of(session);
  session.hold([](std::uint32_t v) { return v % 2 == 0; });
  const ImproverStep held = session.improve();
  CHECK(held.accepted > 0);
  const auto now = session.mesh().points();
  for (std::size_t v = 0; v < points.size(); v += 2) {
    REQUIRE(held.vertex_map[v] != kGone);
    CHECK(now[held.vertex_map[v]] == points[v]);
  }
  session.hold({});
  REQUIRE(session.move(pressed(points_of(session), 6, 6)));
  const SessionPoints moved = points_of(session);
  const ImproverStep free = session.improve();
  std::size_t changed = 0;
  for (std::size_t v = 0; v < points.size(); v += 2) {
    const std::uint32_t there = free.vertex_map[held.vertex_map[v]];
    if (there == kGone || session.mesh().points()[there] != moved[held.vertex_map[v]]) ++changed;
  }
  CHECK(changed > 0);
  session.hold([](std::uint32_t) -> bool { throw Error("not now"); });
  const SessionPoints before = points_of(session);
  CHECK(message_of([&] { session.improve(); }) == "not now");
  CHECK(points_of(session) == before);
}

TEST_CASE(
    "labels and data of a session come over in each step, from where the points are by then") {
  constexpr unsigned kCells = 6;
  MeshArrays cube = shaken_cube(kCells, 1.0);
  std::vector<double> heights;
  for (const auto& p : cube.points) heights.push_back(p[2]);
  for (const auto& tet : cube.tets) {
    double x = 0;
    for (const std::uint32_t v : tet) x += std::round(cube.points[v][0]) / 4;
    cube.tet_labels.push_back(x < 3 ? 7 : 8);
  }
  cube.point_data = {{"height", 1, heights}};
  cube.point_labels.assign(cube.points.size(), 0);
  cube.point_labels[5] = 4;
  Improver session{Mesh(cube)};
  for (int i = 0; i < 3; ++i) {
    SessionPoints points = points_of(session);
    for (auto& p : points) p[2] += 1;  // the data stay behind: heights are those of the start
    REQUIRE(session.move(points));
    const ImproverStep step = session.improve();
    const Mesh& mesh = session.mesh();
    REQUIRE(mesh.point_data().size() == 1);
    const auto& height = std::get<std::vector<double>>(mesh.point_data()[0].values);
    for (std::size_t v = 0; v < mesh.point_count(); ++v) {
      CHECK(height[v] == doctest::Approx(mesh.points()[v][2] - 1 - i).epsilon(0.3).scale(1));
    }
    CHECK(mesh.point_labels()[5] == 4);
    const std::set<std::int32_t> labels(mesh.tet_labels().begin(), mesh.tet_labels().end());
    CHECK(labels == std::set<std::int32_t>{7, 8});
    if (i == 0) CHECK(step.accepted > 0);
  }
}

TEST_CASE("a size field of a session is asked anew in each step") {
  double wanted = 1.2;
  Options options;
  options.size_at = [&](double, double, double) { return wanted; };
  Improver session(Mesh(shaken_cube(4, 0.3)), options);
  session.improve();
  const std::size_t coarse = session.tet_count();
  wanted = 0.5;
  session.improve();
  CHECK(session.tet_count() > 2 * coarse);
  CHECK(measure(session.mesh()).statistics.inverted == 0);
}

TEST_CASE("options that no session has are refused by name") {
  const auto refused = [](const Options& options) {
    return message_of([&] { Improver(Mesh(shaken_cube(2, 0)), options); });
  };
  CHECK(refused({.surface = "1%"}).starts_with("surface: "));
  CHECK(refused({.size = {"0.5"}}).starts_with("size: "));
  CHECK(refused({.trace = "run.trace"}).starts_with("trace: "));
  CHECK(refused({.limit = true}).starts_with("limit: "));
  CHECK(refused({.threads = 0}).starts_with("threads: "));
  CHECK(refused({}).empty());
  MeshArrays curved = {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                       .tets = {{0, 1, 2, 3}}};
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = i + 1; j < 4; ++j) {
      const auto& p = curved.points[i];
      const auto& q = curved.points[j];
      curved.mid_nodes.push_back({i, j, static_cast<std::uint32_t>(curved.points.size())});
      curved.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    }
  }
  CHECK(message_of([&] { Improver{Mesh(curved)}; }) ==
        "a session takes tets of first order: the mesh has mid-side nodes");
}

TEST_CASE("a script of a program may be the step of a session") {
  Improver session(Mesh(shaken_cube(5, 1.0)), {.script = "smooth{} log('done')"});
  const ImproverStep step = session.improve();
  CHECK(step.accepted > 0);
  CHECK(step.notes == std::vector<std::string>{"done"});
  CHECK(session.tet_count() == 750);
  CHECK(session.improve().accepted == 0);
}
