// SPDX-License-Identifier: MIT
// What is tried at one tet, in which order, and until when.
#include "schedule/composition.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "kernel/integrity.h"
#include "schedule/passes.h"
#include "tests/support/registry.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Composition op(const std::string& name, ParameterSettings settings = {}) {
  return {.operator_name = name, .settings = std::move(settings)};
}
Composition first_of(std::vector<Composition> parts) {
  return {.kind = Composition::Kind::first_of, .parts = std::move(parts)};
}
Composition all_of(std::vector<Composition> parts) {
  return {.kind = Composition::Kind::all_of, .parts = std::move(parts)};
}

Composition sequence(std::vector<Composition> parts, double desperate = kDesperate) {
  return {.kind = Composition::Kind::sequence, .desperate = desperate, .parts = std::move(parts)};
}

/// Names and verdicts of all attempts of operators.
struct Attempts final : TraceSink {
  void attempt_begins(const AttemptEvent& event) override {
    open_sequences.push_back(event.operator_name == kSequenceName);
    if (open_sequences.back()) return;
    if (event.level == 0) names.emplace_back(event.operator_name);
    targets.emplace_back(event.target.begin(), event.target.end());
  }
  void attempt_ends(Verdict verdict, std::span<const Quality>, std::span<const Quality>) override {
    if (!open_sequences.back()) verdicts.push_back(verdict);
    open_sequences.pop_back();
  }
  std::vector<std::string> names;
  std::vector<std::vector<VertexHandle>> targets;
  std::vector<Verdict> verdicts;
  std::vector<bool> open_sequences;  // of the attempts under way: whether it is one
};

/// Works off the worst tet inside a ball.
Attempts attempts_at_worst(TetMesh& mesh, const Composition& what) {
  Attempts attempts;
  Run run(mesh, kRegistry);
  run.set_trace(&attempts);
  const Eigen::AlignedBox3d inside(Point(-0.7, -0.7, -0.7), Point(0.7, 0.7, 0.7));
  apply(run, {.what = what, .on = {.worst = 1, .box = inside}});
  return attempts;
}

}  // namespace

TEST_CASE("names and descriptions tell compositions apart") {
  CHECK(op("edge_removal").name() == "edge_removal");
  CHECK(first_of({op("edge_removal"), all_of({op("flip_2_3"), op("smoothing")})}).name() ==
        "first_of(edge_removal, all_of(flip_2_3, smoothing))");
  CHECK(first_of({op("flip_2_3")}).describe() != all_of({op("flip_2_3")}).describe());
  CHECK(op("smoothing", {{"steps", 3}}).describe() != op("smoothing").describe());
  Composition few = op("edge_removal");
  few.most_edges = 2;
  CHECK(few.describe() != op("edge_removal").describe());
  CHECK(op("smoothing", {{"steps", 3}, {"laplacian", 0}}).describe() ==
        op("smoothing", {{"laplacian", 0}, {"steps", 3}}).describe());
}

TEST_CASE("parts are tried in turn on all edges, faces and vertices of the tet") {
  TetMesh mesh(delaunay_ball(200, 4));
  const Attempts attempts = attempts_at_worst(mesh, all_of({op("flip_2_3"), op("edge_removal")}));
  // Nothing of a first part comes after the second has begun.
  const auto& names = attempts.names;
  const auto second = std::find(names.begin(), names.end(), "edge_removal");
  CHECK(std::find(second, names.end(), "flip_2_3") == names.end());
  CHECK(std::count(names.begin(), names.end(), "flip_2_3") <= 4);
  CHECK(std::count(names.begin(), names.end(), "edge_removal") <= 6);
}

TEST_CASE("first_of ends with the first accepted attempt, all_of when the tet is gone") {
  // A part that keeps the tet: smoothing.
  TetMesh one(delaunay_ball(200, 4));
  TetMesh two = one;
  const Composition smoothing_twice_first =
      first_of({op("smoothing"), op("smoothing", {{"laplacian", 0}})});
  const Composition smoothing_twice_all =
      all_of({op("smoothing"), op("smoothing", {{"laplacian", 0}})});
  const Attempts first = attempts_at_worst(one, smoothing_twice_first);
  const Attempts all = attempts_at_worst(two, smoothing_twice_all);
  REQUIRE(std::count(all.verdicts.begin(), all.verdicts.end(), Verdict::accepted) > 0);
  CHECK(std::count(first.verdicts.begin(), first.verdicts.end(), Verdict::accepted) == 1);
  CHECK(first.verdicts.back() == Verdict::accepted);
  CHECK(all.names.size() > first.names.size());
}

TEST_CASE("a sequence succeeds where its parts alone bring nothing more") {
  TetMesh mesh(delaunay_ball(60, 4));
  Run run(mesh, kRegistry);
  const std::vector<Composition> parts = {op("edge_split"), op("shell_transformation"),
                                          op("smoothing")};
  for (std::size_t accepted = 1; accepted > 0;) {
    accepted = 0;
    for (const Composition& part : parts) {
      apply(run, {.what = part});
      accepted += run.records.back().accepted();
    }
  }
  const double q_worst = run.records.back().after.q_worst;
  apply(run, {.what = sequence(parts)});
  CHECK(run.records.back().accepted() > 0);
  CHECK(run.records.back().after.q_worst >= q_worst);
  CHECK(check_integrity(mesh).empty());
}

TEST_CASE("a sequence that is refused leaves no trace, though its parts were accepted") {
  TetMesh mesh(delaunay_ball(200, 4));
  const ApplyOptions pass = {.what = sequence({op("flip_2_3"), op("smoothing")}), .again = true};
  Run run(mesh, kRegistry);
  do {
    apply(run, pass);
  } while (run.records.back().accepted() > 0);
  const TetMesh before = mesh;
  Attempts attempts;
  run.set_trace(&attempts);
  apply(run, pass);
  CHECK(mesh == before);
  CHECK(std::count(attempts.verdicts.begin(), attempts.verdicts.end(), Verdict::accepted) > 0);
  // The report counts sequences, not their parts.
  const auto openings = std::count(attempts.names.begin(), attempts.names.end(), "flip_2_3");
  CHECK(run.records.back().attempts() == static_cast<std::size_t>(openings));
  CHECK(run.records.back().accepted() == 0);
}

TEST_CASE("a sequence works off the bad tets that its opening leaves, the worst first") {
  TetMesh mesh(delaunay_ball(200, 4));
  const Attempts attempts = attempts_at_worst(
      mesh, sequence({op("edge_split", {{"steps", 1}}), op("joint_smoothing", {{"steps", 1}})}));
  const auto& names = attempts.names;
  REQUIRE(std::count(names.begin(), names.end(), "joint_smoothing") > 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != "joint_smoothing") continue;
    // Before it, an accepted opening or another tet of the same sequence.
    REQUIRE(i > 0);
    CHECK((names[i - 1] == "joint_smoothing" || attempts.verdicts[i - 1] == Verdict::accepted));
  }
}

TEST_CASE("below its desperate quality a sequence may leave new bad tets behind") {
  const auto deficit_after = [](double desperate) {
    TetMesh mesh(delaunay_ball(200, 4));
    Run run(mesh, kRegistry);
    apply(run, {.what = sequence({op("edge_split"), op("smoothing")}, desperate), .sweeps = 3});
    REQUIRE(run.records.back().accepted() > 0);
    double sum = 0;
    for (const TetHandle t : live_tets(mesh)) sum += deficit(mesh.quality(t));
    return sum;
  };
  CHECK(deficit_after(-1) != deficit_after(1));
}

TEST_CASE("a sequence with a theta_max lowers larger angles and leaves the worst tet as good") {
  const auto largest_angle = [](const TetMesh& mesh, TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    const auto angles =
        dihedral_angles(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    return *std::max_element(angles.begin(), angles.end());
  };
  const auto count_larger = [&](const TetMesh& mesh, double angle) {
    const auto tets = live_tets(mesh);
    return std::count_if(tets.begin(), tets.end(),
                         [&](TetHandle t) { return largest_angle(mesh, t) > angle; });
  };
  constexpr double kThetaMax = 135;
  Composition what = sequence({op("edge_split"), op("recursive_shell_transformation"),
                               op("smoothing"), op("joint_smoothing")});
  const Selection on = {.below = 1.6f};
  TetMesh mesh(delaunay_ball(200, 4));
  Run run(mesh, kRegistry);
  do {
    apply(run, {.what = what});
  } while (run.records.back().accepted() > 0);

  what.theta_max = kThetaMax;
  for (int pass = 0; pass < 3; ++pass) {
    const TetMesh before = mesh;
    const double q_worst = run.records.back().after.q_worst;
    apply(run, {.what = what, .on = on});
    const PassRecord& record = run.records.back();
    if (pass == 0) REQUIRE(record.accepted() > 0);
    CHECK(record.after.q_worst >= q_worst);
    if (record.accepted() > 0) {
      CHECK(count_larger(mesh, kThetaMax) < count_larger(before, kThetaMax));
    }
  }
  CHECK(check_integrity(mesh).empty());

  // Not for tets without such an angle.
  const Attempts none = attempts_at_worst(mesh, [&] {
    what.theta_max = 179.9;
    return what;
  }());
  CHECK(none.names.empty());
}

TEST_CASE("a sequence must open with one operator and go on") {
  CHECK_THROWS_AS(TetAttempts(kRegistry, sequence({op("smoothing")})), Error);
  CHECK_THROWS_AS(TetAttempts(kRegistry, sequence({first_of({op("smoothing")}), op("flip_2_3")})),
                  Error);
  CHECK_NOTHROW(TetAttempts(kRegistry, sequence({op("smoothing"), first_of({op("flip_2_3")})})));
  // What follows counts by itself.
  const std::vector<Composition> eleven(11, op("edge_removal"));
  CHECK_NOTHROW(TetAttempts(kRegistry, sequence(eleven)));
  CHECK(sequence({op("smoothing"), op("flip_2_3")}).name() == "sequence(smoothing, flip_2_3)");
  CHECK(sequence({op("smoothing"), op("flip_2_3")}).describe() !=
        sequence({op("smoothing"), op("flip_2_3")}, 0.3).describe());
}

TEST_CASE("edges are tried by length when that is asked for") {
  TetMesh mesh(delaunay_ball(200, 4));
  Composition split = op("edge_split", {{"least_gain", 1}});  // never accepted
  for (const bool longest : {true, false}) {
    split.order = longest ? EdgeOrder::longest : EdgeOrder::shortest;
    TetMesh copy = mesh;
    const Attempts attempts = attempts_at_worst(copy, split);
    std::vector<double> lengths;
    for (const auto& ends : attempts.targets) {
      lengths.push_back((mesh.point(ends[0]) - mesh.point(ends[1])).norm());
    }
    REQUIRE(lengths.size() >= 3);
    CHECK(longest == std::is_sorted(lengths.rbegin(), lengths.rend()));
    CHECK(longest != std::is_sorted(lengths.begin(), lengths.end()));
  }
}

TEST_CASE("edges are tried from the largest dihedral angle down when that is asked for") {
  TetMesh mesh(delaunay_ball(200, 4));
  Composition split = op("edge_split", {{"least_gain", 1}});  // never accepted
  split.order = EdgeOrder::angle;
  const Attempts attempts = attempts_at_worst(mesh, split);
  REQUIRE(attempts.targets.size() == 6);
  std::vector<VertexHandle> corners;
  for (const auto& ends : attempts.targets) corners.insert(corners.end(), ends.begin(), ends.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  REQUIRE(corners.size() == 4);
  const auto angles = dihedral_angles(mesh.point(corners[0]), mesh.point(corners[1]),
                                      mesh.point(corners[2]), mesh.point(corners[3]));
  std::vector<double> tried;
  for (auto ends : attempts.targets) {
    std::sort(ends.begin(), ends.end());
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j] = kEdgeVertices[e];
      if (corners[i] == ends[0] && corners[j] == ends[1]) tried.push_back(angles[e]);
    }
  }
  CHECK(tried.size() == 6);
  CHECK(std::is_sorted(tried.rbegin(), tried.rend()));
}

TEST_CASE("of the edges of a tet only the first few are tried when that is asked for") {
  TetMesh mesh(delaunay_ball(200, 4));
  Composition split = op("edge_split", {{"least_gain", 1}});  // never accepted
  for (const EdgeOrder order : {EdgeOrder::sine, EdgeOrder::longest}) {
    split.order = order;
    split.most_edges = 6;
    TetMesh one = mesh;
    const auto all = attempts_at_worst(one, split).targets;
    split.most_edges = 2;
    TetMesh two = mesh;
    const auto few = attempts_at_worst(two, split).targets;
    REQUIRE(all.size() == 6);
    CHECK(few == std::vector(all.begin(), all.begin() + 2));
  }
}

TEST_CASE("unknown operators and compositions of too many attempts are errors") {
  CHECK_THROWS_AS(TetAttempts(kRegistry, op("edge_magic")), Error);
  CHECK_THROWS_AS(TetAttempts(kRegistry, op("smoothing", {{"magic", 1}})), Error);
  CHECK_THROWS_AS(TetAttempts(kRegistry, all_of({op("smoothing"), op("edge_magic")})), Error);
  const std::vector<Composition> ten(10, op("edge_removal"));
  CHECK_NOTHROW(TetAttempts(kRegistry, all_of(ten)));
  const std::vector<Composition> eleven(11, op("edge_removal"));
  CHECK_THROWS_AS(TetAttempts(kRegistry, all_of(eleven)), Error);
}

TEST_CASE("applying reconnection by hand gives the mesh of local reconnection") {
  TetMesh by_pass(delaunay_ball(200, 4));
  TetMesh by_hand = by_pass;
  Run one(by_pass, kRegistry);
  local_reconnection(one, {.sweeps = 1});
  Run two(by_hand, kRegistry);
  apply(two, {.what = all_of({op("recursive_shell_transformation"), op("multi_face_removal")})});
  CHECK(one.records[0].accepted() > 0);
  CHECK(one.records[0].verdicts == two.records[0].verdicts);
  CHECK(by_pass.to_data().tets == by_hand.to_data().tets);
}

TEST_CASE("a pass made again does nothing unless it is told to try everything again") {
  TetMesh mesh(delaunay_ball(200, 4));
  Run run(mesh, kRegistry);
  ApplyOptions pass{.what = op("edge_removal"), .on = {.below = Selection::kAll}, .sweeps = 100};
  apply(run, pass);
  const std::size_t attempts = run.records.back().attempts();
  REQUIRE(attempts > 10);
  apply(run, pass);
  CHECK(run.records.back().attempts() == 0);
  pass.again = true;
  apply(run, pass);
  CHECK(run.records.back().attempts() > 10);
  CHECK(run.records.back().accepted() == 0);
}
