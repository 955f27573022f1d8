// SPDX-License-Identifier: MIT
// Operators that say one thing and do another.
#include "tests/plugins/vertex_mover.h"

namespace tetmend::test {
namespace {

/// Keeps an edit of its own in evaluate() and then refuses.
struct EditsInEvaluate final : VertexMover {
  EditsInEvaluate() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    if (VertexMover::evaluate(context, target, state) != Verdict::accepted)
      return Verdict::deferred;
    Transaction own(context.mesh, context.workspace);
    if (VertexMover::apply(context, target, own, state) == Verdict::accepted) own.keep();
    return Verdict::no_improvement;
  }
  inline static const OperatorInfo kInfo = {
      "edits_in_evaluate", TargetKind::vertex, "help", {}, make<EditsInEvaluate>};
};

/// Says "accepted" and has done nothing.
struct DoesNothing final : VertexMover {
  DoesNothing() : VertexMover(kInfo) {}
  Verdict apply(OperatorContext&, Target, Transaction&, State&) const override {
    return Verdict::accepted;
  }
  inline static const OperatorInfo kInfo = {
      "does_nothing", TargetKind::vertex, "help", {}, make<DoesNothing>};
};

/// Says "accepted" and has moved the vertex nearly into another.
struct MakesItWorse final : VertexMover {
  MakesItWorse() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = VertexMover::evaluate(context, target, state);
    if (verdict != Verdict::accepted) return verdict;
    const Point& here = context.mesh.point(target.vertex());
    const Point& there = context.mesh.point(context.mesh.vertices(state.link[0])[0]);
    state.point = here + 0.999 * (there - here);
    return Verdict::accepted;
  }
  inline static const OperatorInfo kInfo = {
      "makes_it_worse", TargetKind::vertex, "help", {}, make<MakesItWorse>};
};

/// Answers differently the second time: counts in itself.
struct ChangesItsMind final : VertexMover {
  ChangesItsMind() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = VertexMover::evaluate(context, target, state);
    return ++count % 2 == 0 ? Verdict::budget_spent : verdict;
  }
  mutable int count = 0;
  inline static const OperatorInfo kInfo = {
      "changes_its_mind", TargetKind::vertex, "help", {}, make<ChangesItsMind>};
};

/// Walks past the border of its territory, with a workspace of its own.
struct Trespasses final : VertexMover {
  Trespasses() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    Workspace own(context.mesh);
    OperatorContext whole{context.mesh, own, context.states, nullptr, 0};
    return VertexMover::evaluate(whole, target, state);
  }
  inline static const OperatorInfo kInfo = {
      "trespasses", TargetKind::vertex, "help", {}, make<Trespasses>};
};

/// Looks at all points of the mesh, which other threads may be changing.
struct LooksAround final : VertexMover {
  LooksAround() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = VertexMover::evaluate(context, target, state);
    Point sum = Point::Zero();
    for (std::uint32_t i = 0; i < context.mesh.vertex_slots(); ++i) {
      sum += context.mesh.point(VertexHandle(i));
    }
    state.point += 1e-6 * sum;
    return verdict;
  }
  inline static const OperatorInfo kInfo = {
      "looks_around", TargetKind::vertex, "help", {}, make<LooksAround>};
};

struct MakesNothing final : VertexMover {
  inline static const OperatorInfo kInfo = {
      "makes_nothing",
      TargetKind::vertex,
      "help",
      {},
      [](const ParameterValues&) -> std::unique_ptr<Operator> { return nullptr; }};
};

struct MakesAnother final : VertexMover {
  inline static const OperatorInfo kInfo = {
      "makes_another", TargetKind::vertex, "help", {}, make<DoesNothing>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  using namespace tetmend::test;
  registry.add(EditsInEvaluate::kInfo);
  registry.add(DoesNothing::kInfo);
  registry.add(MakesItWorse::kInfo);
  registry.add(ChangesItsMind::kInfo);
  registry.add(Trespasses::kInfo);
  registry.add(LooksAround::kInfo);
  registry.add(MakesNothing::kInfo);
  registry.add(MakesAnother::kInfo);
}
