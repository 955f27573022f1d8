// SPDX-License-Identifier: MIT
// The fixed order of an attempt, what the trace hears of it, and that it takes no memory from the
// heap.
#include "ops/operator.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "tests/support/lone_worker.h"
#include "tests/support/zoo.h"

// ---- Counts what the heap is asked for ----------------------------------------------------------

namespace {
bool counting = false;
std::size_t allocations = 0;

void* take(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// Not inlined: gcc would see free() of what operator new has given, and warn.
[[gnu::noinline]] void give_back(void* memory) noexcept {
  std::free(memory);
}
}  // namespace

void* operator new(std::size_t size) {
  return take(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new[](std::size_t size) {
  return take(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
// Left to the library, these would not go with the operators below: sanitizers notice.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return take(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return operator new(size, std::nothrow);
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete[](void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  give_back(memory);
}

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// An operator whose stages the test writes; notes which of them ran.
struct Empty {};

class Scripted final : public OperatorOf<Empty> {
 public:
  using Apply = std::function<Verdict(OperatorContext&, Transaction&)>;
  Scripted(Verdict precondition, Verdict evaluate, Apply apply)
      : OperatorOf(kInfo),
        precondition_(precondition),
        evaluate_(evaluate),
        apply_(std::move(apply)) {}
  mutable std::string stages;

 protected:
  Verdict precondition(const OperatorContext&, Target, Empty&) const override {
    stages += "p";
    return precondition_;
  }
  Verdict evaluate(OperatorContext&, Target, Empty&) const override {
    stages += "e";
    return evaluate_;
  }
  Verdict apply(OperatorContext& context, Target, Transaction& transaction, Empty&) const override {
    stages += "a";
    return apply_(context, transaction);
  }

 private:
  inline static const OperatorInfo kInfo = {"scripted", TargetKind::tet, "", {}, nullptr};
  Verdict precondition_;
  Verdict evaluate_;
  Apply apply_;
};

const Target kFirstTet = Target::of(TetHandle(0));

/// A shell of three: tall, so that its two-tet form is better; low, so that it is worse.
MeshData shell_of_three(double height) {
  return shell_mesh({.degree = 3, .height = height});
}

Verdict remove_edge_of_three(OperatorContext& context, Transaction& transaction) {
  const TetHandle t(0);
  Shell shell;
  const auto edge = find_edge(context.mesh, VertexHandle(0), VertexHandle(1), context.workspace, t);
  REQUIRE(edge.has_value());
  REQUIRE(find_shell(context.mesh, *edge, shell, Territory()) == ShellKind::closed);
  const std::vector<TetHandle> old(shell.tets.begin(), shell.tets.begin() + 3);
  const std::vector<TetVertices> created = {{shell.a, shell.ring[0], shell.ring[1], shell.ring[2]},
                                            {shell.ring[0], shell.ring[1], shell.ring[2], shell.b}};
  return to_verdict(transaction.replace_cavity(old, created));
}

/// Keeps a transaction of its own in evaluate().
class Hasty final : public OperatorOf<Empty> {
 public:
  explicit Hasty(Verdict verdict) : OperatorOf(kInfo), verdict_(verdict) {}

 protected:
  Verdict precondition(const OperatorContext&, Target, Empty&) const override {
    return Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target, Empty&) const override {
    Transaction own(context.mesh, context.workspace);
    CHECK(remove_edge_of_three(context, own) == Verdict::accepted);
    own.keep();
    return verdict_;
  }
  Verdict apply(OperatorContext&, Target, Transaction&, Empty&) const override {
    return Verdict::accepted;
  }

 private:
  inline static const OperatorInfo kInfo = {"hasty", TargetKind::tet, "", {}, nullptr};
  Verdict verdict_;
};

struct Recorder final : TraceSink {
  std::vector<std::string> events;
  void attempt_begins(const AttemptEvent& event) override {
    std::string text = std::string(event.operator_name) + " at";
    for (const VertexHandle v : event.target) text.append(" ").append(std::to_string(v.index()));
    events.push_back(text + " level " + std::to_string(event.level));
  }
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override {
    events.push_back(std::string(to_string(verdict)) + " " + std::to_string(before.size()) + " " +
                     std::to_string(now.size()));
  }
};

}  // namespace

TEST_CASE("an attempt ends at the first stage that refuses") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  const auto edit = [](OperatorContext& context, Transaction& transaction) {
    return remove_edge_of_three(context, transaction);
  };
  const Scripted first(Verdict::constrained, Verdict::accepted, edit);
  CHECK(worker.attempt(first, kFirstTet) == Verdict::constrained);
  CHECK(first.stages == "p");
  const Scripted second(Verdict::accepted, Verdict::depth_spent, edit);
  CHECK(worker.attempt(second, kFirstTet) == Verdict::depth_spent);
  CHECK(second.stages == "pe");
  CHECK(worker.mesh == start);
  const Scripted third(Verdict::accepted, Verdict::accepted, edit);
  CHECK(worker.attempt(third, kFirstTet) == Verdict::accepted);
  CHECK(third.stages == "pea");
  CHECK(worker.mesh.tet_count() == 2);
}

TEST_CASE("what apply did is undone when apply refuses in the end") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  const Scripted op(Verdict::accepted, Verdict::accepted,
                    [](OperatorContext& context, Transaction& transaction) {
                      CHECK(remove_edge_of_three(context, transaction) == Verdict::accepted);
                      return Verdict::budget_spent;
                    });
  CHECK(worker.attempt(op, kFirstTet) == Verdict::budget_spent);
  CHECK(worker.mesh == start);
}

TEST_CASE("an edit that makes the quality vector worse is undone") {
  LoneWorker worker(shell_of_three(0.3));
  const TetMesh start = worker.mesh;
  const Scripted op(Verdict::accepted, Verdict::accepted, remove_edge_of_three);
  CHECK(worker.attempt(op, kFirstTet) == Verdict::no_improvement);
  CHECK(worker.mesh == start);
}

TEST_CASE("an attempt that edits nothing is no improvement") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  const Scripted op(Verdict::accepted, Verdict::accepted,
                    [](OperatorContext&, Transaction&) { return Verdict::accepted; });
  CHECK(worker.attempt(op, kFirstTet) == Verdict::no_improvement);
  CHECK(worker.mesh == start);
}

TEST_CASE(
    "an exception out of apply undoes its edits and becomes an error that names the operator") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  const auto check = [&](const Scripted& op, const std::string& message) {
    CHECK_THROWS_WITH_AS(worker.attempt(op, kFirstTet), message.c_str(), Error);
    CHECK(worker.mesh == start);
  };
  check(Scripted(Verdict::accepted, Verdict::accepted,
                 [](OperatorContext& context, Transaction& transaction) -> Verdict {
                   remove_edge_of_three(context, transaction);
                   throw std::out_of_range("no such ring");
                 }),
        "operator 'scripted' failed at tet 0: no such ring");
  check(Scripted(Verdict::accepted, Verdict::accepted,
                 [](OperatorContext& context, Transaction& transaction) -> Verdict {
                   remove_edge_of_three(context, transaction);
                   throw 7;
                 }),
        "operator 'scripted' failed at tet 0: an exception of an unknown type");
  // The worker is as good as new.
  const Scripted op(Verdict::accepted, Verdict::accepted, remove_edge_of_three);
  CHECK(worker.attempt(op, kFirstTet) == Verdict::accepted);
  CHECK(to_string(check_integrity(worker.mesh)) == "");
}

TEST_CASE("a lack of memory stays what it is, and the edits are undone") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  const Scripted op(Verdict::accepted, Verdict::accepted,
                    [](OperatorContext& context, Transaction& transaction) -> Verdict {
                      remove_edge_of_three(context, transaction);
                      throw std::bad_alloc();
                    });
  CHECK_THROWS_AS(worker.attempt(op, kFirstTet), std::bad_alloc);
  CHECK(worker.mesh == start);
}

TEST_CASE("edits before apply are undone and are an error, kept or not, accepted or not") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  for (const Verdict verdict : {Verdict::accepted, Verdict::no_improvement}) {
    const Hasty op(verdict);
    CHECK_THROWS_WITH_AS(worker.attempt(op, kFirstTet),
                         "operator 'hasty' failed at tet 0: it edits the mesh before apply()",
                         Error);
    CHECK(worker.mesh == start);
  }
}

TEST_CASE("the trace hears operator, target, level, verdict and the quality vectors") {
  LoneWorker worker(shell_of_three(1.4));
  Recorder trace;
  const Scripted refusing(Verdict::inverted, Verdict::accepted, remove_edge_of_three);
  worker.attempt(refusing, kFirstTet, &trace, 2);
  const Scripted op(Verdict::accepted, Verdict::accepted, remove_edge_of_three);
  worker.attempt(op, Target::of(TetEdge(TetHandle(0), 0)), &trace);
  worker.attempt(refusing, Target::of(HalfFace(TetHandle(0), 0)), &trace);
  worker.attempt(refusing, Target::of(VertexHandle(4)), &trace);
  const auto face = worker.mesh.vertices(HalfFace(TetHandle(0), 0));
  std::string corners;
  for (const VertexHandle v : face) corners.append(" ").append(std::to_string(v.index()));
  const std::vector<std::string> expected = {"scripted at 0 1 2 3 level 2",
                                             "inverted 0 0",
                                             "scripted at 0 1 level 0",
                                             "accepted 3 2",
                                             "scripted at" + corners + " level 0",
                                             "inverted 0 0",
                                             "scripted at 4 level 0",
                                             "inverted 0 0"};
  CHECK(trace.events == expected);
}

TEST_CASE("the judge of the context decides before that of the operator") {
  LoneWorker worker(shell_of_three(0.3));  // two tets are worse
  const TetMesh start = worker.mesh;
  const Scripted op(Verdict::accepted, Verdict::accepted, remove_edge_of_three);
  const Judge patient = Judge::opening(0);
  const Judge strict = Judge::strict();
  OperatorContext context{worker.mesh, worker.workspace, worker.states};
  context.judge = &strict;
  CHECK(op.attempt(context, kFirstTet) == Verdict::no_improvement);
  CHECK(worker.mesh == start);
  context.judge = &patient;
  CHECK(op.attempt(context, kFirstTet) == Verdict::accepted);
  CHECK(context.judge == &patient);
}

namespace {

/// Proposes a bad edit first, then as many good ones as it is told.
class Persistent final : public OperatorOf<int> {
 public:
  explicit Persistent(int good) : OperatorOf(kInfo), good_(good) {}

 protected:
  Verdict precondition(const OperatorContext&, Target, int&) const override {
    return Verdict::accepted;
  }
  Verdict evaluate(OperatorContext&, Target, int& proposal) const override {
    proposal = 0;
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                int& proposal) const override {
    CHECK(transaction.empty());
    if (proposal == 0) {  // a vertex of the shell nearly into another
      const VertexHandle v(0);
      std::vector<HalfFace> link;
      if (!collect_link(context.mesh, v, context.workspace, link)) return Verdict::deferred;
      return Verdict::inverted;
    }
    return remove_edge_of_three(context, transaction);
  }
  bool propose_next(OperatorContext&, Target, int& proposal) const override {
    return ++proposal <= good_;
  }

 private:
  inline static const OperatorInfo kInfo = {"persistent", TargetKind::tet, "", {}, nullptr};
  int good_;
};

}  // namespace

TEST_CASE("an operator may make another proposal after one that was refused") {
  LoneWorker worker(shell_of_three(1.4));
  const TetMesh start = worker.mesh;
  CHECK(worker.attempt(Persistent(0), kFirstTet) == Verdict::inverted);
  CHECK(worker.mesh == start);
  CHECK(worker.attempt(Persistent(1), kFirstTet) == Verdict::accepted);
  CHECK(worker.mesh.tet_count() == 2);
  // Each that the judge refuses is undone before the next.
  LoneWorker low(shell_of_three(0.3));
  const TetMesh before = low.mesh;
  CHECK(low.attempt(Persistent(3), kFirstTet) == Verdict::no_improvement);
  CHECK(low.mesh == before);
}

TEST_CASE("operators of one class share a state, those of different classes do not") {
  OperatorStates states;
  const Persistent one(1);
  const Persistent other(2);
  const Hasty hasty(Verdict::accepted);
  CHECK(&states.of(one) == &states.of(other));
  CHECK(&states.of(one) != &states.of(hasty));
}

TEST_CASE("a target gives back the handle that it was made of") {
  CHECK(Target::of(TetHandle(7)).tet() == TetHandle(7));
  CHECK(Target::of(TetEdge(TetHandle(7), 4)).edge() == TetEdge(TetHandle(7), 4));
  CHECK(Target::of(HalfFace(TetHandle(7), 2)).face() == HalfFace(TetHandle(7), 2));
  CHECK(Target::of(VertexHandle(9)).vertex() == VertexHandle(9));
  CHECK(to_string(Target::of(VertexHandle(9)).kind) == "vertex");
}

TEST_CASE("an attempt takes no memory from the heap once the buffers have grown") {
  Registry registry = Registry::builtin();
  std::size_t accepted = 0;
  for (const OperatorInfo* info : registry.operators()) {
    std::vector<ParameterSettings> all = {{}};
    for (const ParameterSpec& spec : info->parameters) {
      if (spec.kind == ParameterSpec::Kind::flag) {
        all.push_back({{std::string(spec.name), 1 - spec.initial}});
      }
    }
    std::size_t refused = 0;
    for (const ParameterSettings& settings : all) {
      CAPTURE(info->name);
      CAPTURE(settings.size());
      const auto op = registry.make(info->name, settings);
      LoneWorker worker(delaunay_ball(150, 9));
      std::vector<Target> targets;
      for (const TetHandle t : live_tets(worker.mesh)) {
        if (info->target == TargetKind::tet) targets.push_back(Target::of(t));
        if (info->target == TargetKind::edge)
          targets.push_back(Target::of(TetEdge(t, t.index() % 6)));
        if (info->target == TargetKind::face)
          targets.push_back(Target::of(HalfFace(t, t.index() % 4)));
      }
      if (info->target == TargetKind::vertex) {
        for (const VertexHandle v : live_vertices(worker.mesh)) targets.push_back(Target::of(v));
      }
      for (const bool warm : {false, true}) {
        allocations = 0;
        for (const Target target : targets) {
          Transaction outer(worker.mesh, worker.workspace);
          counting = warm;
          const Verdict verdict = worker.attempt(*op, target);
          counting = false;
          if (warm) ++(verdict == Verdict::accepted ? accepted : refused);
        }
      }
      CHECK(allocations == 0);
    }
    CHECK_MESSAGE(refused > 0, info->name);
  }
  CHECK(accepted > 0);
}
