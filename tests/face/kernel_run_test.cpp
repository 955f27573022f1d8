// SPDX-License-Identifier: MIT
// Passes and schedules of a program over its own mesh.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>
#include <tetmend/improve.h>

#include "face/kernel/run.h"
#include "face/kernel/transaction.h"
#include "tests/face/meshes.h"
#include "tests/face/own_flip.h"

namespace tetmend::kernel {

using tetmend::test::message_of;
using tetmend::test::shaken_cube;

namespace {

Operators counting_flip(std::size_t* calls = nullptr) {
  Operators own;
  own.add(
      "own_flip", "three tets of an edge become two",
      [calls](const TetMesh& look, TetEdge e, Proposal& out) {
        if (calls != nullptr) ++*calls;
        return test::flip_to_two(look, e, out);
      },
      Judge::by([](Judge::Tets before, Judge::Tets now) { return now.size() < before.size(); }));
  return own;
}

std::vector<std::array<double, 3>> kernel_points(const TetMesh& mesh) {
  std::vector<std::array<double, 3>> points;
  for (VertexHandle v : mesh.vertices()) {
    const Point p = mesh.point(v);
    points.push_back({p.x(), p.y(), p.z()});
  }
  return points;
}

std::vector<std::array<std::uint32_t, 4>> tets_of(const TetMesh& mesh) {
  std::vector<std::array<std::uint32_t, 4>> tets;
  for (TetHandle t : mesh.tets()) {
    const auto& v = mesh.vertices(t);
    tets.push_back({v[0].index(), v[1].index(), v[2].index(), v[3].index()});
  }
  return tets;
}

std::size_t count_below_goal(const TetMesh& mesh) {
  const auto tets = mesh.tets();
  return static_cast<std::size_t>(
      std::count_if(tets.begin(), tets.end(), [&](TetHandle t) { return mesh.quality(t) < 1; }));
}

/// Algorithm 6, as shell.lua has it in its rounds.
QualityIndicators improve_by_rounds(Run& run) {
  QualityIndicators before = run.indicators(), now = before;
  do {
    before = now;
    run.local_reconnection();
    run.smooth();
    run.suppress_points();
    run.smooth();
    now = run.indicators();
  } while (now.n_bad > 0 && is_progress_over(now, before));
  return now;
}

}  // namespace

TEST_CASE("a schedule in C++ improves a mesh, with the same bytes for every number of threads") {
  TetMesh mesh{Mesh(shaken_cube(26, 0.8))};  // large enough to be divided
  TetMesh other(mesh);
  const std::size_t bad = count_below_goal(mesh);
  Run run(mesh);
  const QualityIndicators now = improve_by_rounds(run);
  CHECK(now.n_bad < bad / 4);
  CHECK(mesh.check().empty());
  Run by_three(other, {.threads = 3});
  improve_by_rounds(by_three);
  CHECK(kernel_points(mesh) == kernel_points(other));
  CHECK(tets_of(mesh) == tets_of(other));
}

TEST_CASE("the mesh of a program may be edited between passes, which begin anew then") {
  TetMesh mesh{Mesh(shaken_cube(6, 1.0))};
  Run run(mesh);
  CHECK(run.local_reconnection().attempts > 0);
  run.local_reconnection();
  const PassDone again = run.local_reconnection();
  std::size_t kept = 0;
  for (TetEdge e : mesh.edges()) {
    const auto [a, b] = mesh.vertices(e);
    Transaction edit(mesh);
    if (!edit.split(e, (mesh.point(a) + mesh.point(b)) / 2).is_valid()) continue;
    edit.keep();
    if (++kept == 50) break;
  }
  REQUIRE(kept == 50);
  CHECK(mesh.check().empty());
  CHECK(run.local_reconnection().attempts > again.attempts);
  CHECK(run.smooth().accepted > 0);
  for (TetHandle t : mesh.tets()) attempt(mesh, "edge_removal", TetEdge(t, 0));
  mesh.collect_garbage();
  run.local_reconnection();
  CHECK(mesh.check().empty());
  Transaction edit(mesh);
  CHECK(message_of([&] { run.smooth(); }) ==
        "a pass while a transaction is open: it ends with its scope, kept or not");
}

TEST_CASE("operators of a program are tried by passes, compositions and scripts") {
  TetMesh mesh{Mesh(shaken_cube(6, 0.6))};
  for (HalfFace f : mesh.faces()) {  // makes edges of three tets
    Transaction edit(mesh);
    if (edit.flip_2_3(f) == EditResult::made) edit.keep();
  }
  TetMesh other(mesh);
  std::size_t calls = 0;
  const Operators own = counting_flip(&calls);
  Run run(mesh, {.threads = 2, .operators = &own});
  const std::size_t tets = mesh.tet_count();
  const PassDone flips = run.apply("own_flip", {.below = Selection::kAll});
  CHECK(flips.name == "own_flip");
  CHECK(flips.attempts == calls);
  CHECK(flips.accepted > 5);
  CHECK(mesh.tet_count() == tets - flips.accepted);
  CHECK(mesh.check().empty());
  const PassDone both = run.apply({.what = first_of({one("own_flip"), one("edge_removal")})});
  CHECK(both.name == "first_of(own_flip, edge_removal)");
  Run by_script(other, {.operators = &own});
  const auto passes = by_script.schedule("apply('own_flip', {on = {below = 100}})");
  REQUIRE(passes.size() == 1);
  CHECK(passes[0].accepted == flips.accepted);
  CHECK(message_of([&] { run.apply("no_such"); }).find("own_flip") != std::string::npos);
  CHECK(message_of([&] { Run(mesh, {.threads = 0}); }).starts_with("threads: "));
}

TEST_CASE(
    "what an operator of a program throws names it, and the mesh is as its attempt found it") {
  Operators own;
  own.add("fails", "throws", [](const TetMesh&, TetHandle, Proposal&) -> Verdict {
    throw std::runtime_error("own fault");
  });
  own.add("lies", "proposes what is no mesh", [](const TetMesh& look, TetHandle t, Proposal& out) {
    const auto v = look.vertices(t);
    return out.replace(std::array{t}, {{v[0], v[1], v[3], v[2]}});
  });
  own.add("names_nothing", "a vertex that is not there",
          [](const TetMesh& look, TetHandle t, Proposal& out) {
            const auto v = look.vertices(t);
            return out.replace(std::array{t}, {{v[0], v[1], v[2], VertexHandle()}});
          });
  TetMesh mesh{Mesh(shaken_cube(4, 1.0))};
  const auto points = kernel_points(mesh);
  Run run(mesh, {.operators = &own});
  const std::string message = message_of([&] { run.apply("fails"); });
  CHECK(message.find("fails") != std::string::npos);
  CHECK(message.find("own fault") != std::string::npos);
  for (const char* name : {"lies", "names_nothing"}) {
    const PassDone done = run.apply(name);
    CHECK(done.attempts > 0);
    CHECK(done.accepted == 0);
  }
  CHECK(kernel_points(mesh) == points);
  CHECK(mesh.check().empty());
}

TEST_CASE("in passes locked vertices stay and properties follow") {
  TetMesh mesh{Mesh(shaken_cube(6, 1.0))};
  auto age = mesh.tet_property<int>("age", 0);
  for (TetHandle t : mesh.tets()) age[t] = 7;
  std::vector<std::pair<VertexHandle, Point>> locked;
  for (VertexHandle v : mesh.vertices()) {
    if (mesh.is_fixed(v) || v.index() % 3 != 0) continue;
    mesh.lock(v);
    locked.emplace_back(v, mesh.point(v));
  }
  REQUIRE(locked.size() > 10);
  const auto before = tets_of(mesh);
  Run run(mesh);
  run.schedule("shell", {{"max_rounds", "2"}});
  for (const auto& [v, point] : locked) {
    REQUIRE_FALSE(mesh.is_deleted(v));
    CHECK(mesh.point(v) == point);
    CHECK(mesh.is_locked(v));
  }
  std::size_t made = 0;
  for (TetHandle t : mesh.tets()) {
    if (age[t] == 0) ++made;
    const auto& v = mesh.vertices(t);
    const bool is_old =
        t.index() < before.size() &&
        std::array{v[0].index(), v[1].index(), v[2].index(), v[3].index()} == before[t.index()];
    if (!is_old) CHECK(age[t] == 0);
  }
  CHECK(made > 0);
  CHECK(mesh.check().empty());
  Transaction edit(mesh);
  CHECK(edit.move(locked[0].first, locked[0].second) == EditResult::constrained);
}

TEST_CASE("passes and scripts select tets by a property, with the values of today") {
  TetMesh mesh{Mesh(shaken_cube(6, 1.0))};
  auto mark = mesh.tet_property<int>("mark", 0);
  mesh.tet_property<std::string>("name");
  Run run(mesh);
  const ApplyOptions marked = {.what = one("edge_removal"),
                               .on = {.value = ValueRange{.name = "mark", .low = 1}}};
  CHECK(run.apply(marked).attempts == 0);
  std::size_t count = 0;
  for (TetHandle t : mesh.tets()) {
    if (mesh.quality(t) < 1 && t.index() % 2 == 0) mark[t] = 1, ++count;
  }
  REQUIRE(count > 10);
  const PassDone pass = run.apply(marked);
  CHECK(pass.attempts > 0);
  CHECK(pass.attempts < Run(mesh).apply("edge_removal").attempts);
  const auto passes = run.schedule("apply('edge_removal', {on = {property = {'mark', low = 1}}})");
  CHECK(passes.front().attempts > 0);
  CHECK(message_of([&] {
          run.apply({.what = one("edge_removal"), .on = {.value = ValueRange{.name = "name"}}});
        }).ends_with("arrays of the tets: mark"));
}

TEST_CASE("passes and scripts select tets by a measure of the program") {
  TetMesh mesh{Mesh(shaken_cube(6, 1.0))};
  Operators own;
  const Standard standard = own.add_measure(
      {"twice", 0.5, [](const Point& a, const Point& b, const Point& c, const Point& d) {
         return 2 * minimum_sine(a, b, c, d);
       }});
  std::size_t count = 0;
  for (TetHandle t : mesh.tets()) {
    const auto [a, b, c, d] = mesh.points(t);
    const double twice = 2 * minimum_sine(a, b, c, d);
    if (twice >= 0.2 && twice <= 0.6) ++count;
  }
  Run run(mesh, {.operators = &own});
  const auto visits = [&](const std::string& name, double low, double high) {
    struct Counter final : TraceSink {
      void attempt_begins(const AttemptEvent&) override {}
      void attempt_ends(Verdict, std::span<const Quality>, std::span<const Quality>) override {}
      void visit_begins(const TetVertices&, Quality) override { ++visits; }
      std::size_t visits = 0;
    } counter;
    TetMesh copy(mesh);
    Run(copy, {.operators = &own, .observer = &counter})
        .apply({.what = one("flip_2_3"),
                .on = {.below = Selection::kAll, .value = ValueRange{name, low, high}}});
    return counter.visits;
  };
  REQUIRE(count > 10);
  CHECK(visits("twice", 0.2, 0.6) > 10);
  CHECK(visits("twice", 0.2, 0.6) == visits("min_sine", 0.1, 0.3));
  CHECK(visits("twice", 0.2, 0.6) < visits("twice", 0, 2));
  CHECK(run.schedule("apply('flip_2_3', {on = {property = {'twice', high = 0.6}}})")
            .front()
            .attempts > 0);
  CHECK(message_of([&] {
          run.apply({.what = one("flip_2_3"), .on = {.value = ValueRange{.name = "thrice"}}});
        }).ends_with("measures of the program: twice"));
}

TEST_CASE("an observer sees the mesh of each pass, and must not change it") {
  TetMesh mesh{Mesh(shaken_cube(4, 1.0))};
  struct Meddler final : TraceSink {
    explicit Meddler(TetMesh& of_program) : mesh(of_program) {}
    void attempt_begins(const AttemptEvent&) override {
      if (messages.empty()) {
        messages.push_back(message_of([&] { Transaction edit(mesh); }));
        messages.push_back(
            message_of([&] { attempt(mesh, "edge_removal", TetEdge(*mesh.tets().begin(), 0)); }));
        messages.push_back(message_of([&] { mesh.collect_garbage(); }));
      }
    }
    void attempt_ends(Verdict verdict, std::span<const Quality>,
                      std::span<const Quality>) override {
      ++verdicts[static_cast<std::size_t>(verdict)];
    }
    void pass_ends(const QualityIndicators&) override {
      tets.push_back(mesh.to_mesh().tet_count());
    }
    TetMesh& mesh;
    std::vector<std::string> messages;
    std::vector<std::size_t> tets;
    std::array<std::size_t, kVerdictCount> verdicts{};
  } meddler(mesh);
  Run run(mesh, {.observer = &meddler});
  const PassDone done = run.apply("edge_removal");
  const std::string end =
      " while a pass works on the mesh: observers and operators look, and change nothing";
  CHECK(meddler.messages ==
        std::vector<std::string>{"an edit" + end, "an edit" + end, "collect_garbage()" + end});
  CHECK(meddler.tets == std::vector<std::size_t>{mesh.tet_count()});
  CHECK(done.verdicts == meddler.verdicts);
  CHECK(done.ended(Verdict::accepted) == done.accepted);
  CHECK(done.ended(Verdict::no_improvement) > 0);
  Transaction edit(mesh);  // after the pass
}

TEST_CASE("a run ends with its attempts, and another goal is worked towards when it is set") {
  TetMesh mesh{Mesh(shaken_cube(8, 1.0))};
  Run few(mesh, {.most_attempts = 100});
  few.local_reconnection();
  CHECK(few.is_over());
  CHECK(few.smooth().attempts == 0);
  Run run(mesh);
  const std::size_t bad = run.indicators().n_bad;
  run.set_goal({.min_angle = 40, .max_angle = 140});
  CHECK(run.indicators().n_bad > bad);
  CHECK(message_of([&] { run.set_goal({.min_angle = -3}); }).starts_with("goal: "));
}

}  // namespace tetmend::kernel
