// SPDX-License-Identifier: MIT
// Operators that throw in one of their stages.
#include <stdexcept>

#include "tests/plugins/vertex_mover.h"

namespace tetmend::test {
namespace {

struct ThrowsInPrecondition final : VertexMover {
  ThrowsInPrecondition() : VertexMover(kInfo) {}
  Verdict precondition(const OperatorContext&, Target, State&) const override {
    throw std::runtime_error("precondition is not written yet");
  }
  inline static const OperatorInfo kInfo = {
      "throws_in_precondition", TargetKind::vertex, "help", {}, make<ThrowsInPrecondition>};
};

struct ThrowsInEvaluate final : VertexMover {
  ThrowsInEvaluate() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext&, Target, State&) const override { throw 7; }
  inline static const OperatorInfo kInfo = {
      "throws_in_evaluate", TargetKind::vertex, "help", {}, make<ThrowsInEvaluate>};
};

/// After an edit inside a transaction of its own, inside that of the attempt.
struct ThrowsInApply final : VertexMover {
  ThrowsInApply() : VertexMover(kInfo) {}
  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    Transaction own(context.mesh, context.workspace);
    const Verdict verdict = VertexMover::apply(context, target, transaction, state);
    if (verdict == Verdict::accepted) throw std::runtime_error("index 17 out of range");
    return verdict;
  }
  inline static const OperatorInfo kInfo = {
      "throws_in_apply", TargetKind::vertex, "help", {}, make<ThrowsInApply>};
};

/// For a pass over bad tets: throws at bad ones.
struct ThrowsAtEdges final : VertexMover {
  ThrowsAtEdges() : VertexMover(kInfo) {}
  Verdict precondition(const OperatorContext&, Target, State&) const override {
    return Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target target, State&) const override {
    if (context.mesh.quality(target.edge().tet()) < kBadThreshold)
      throw std::runtime_error("a sliver");
    return Verdict::no_improvement;
  }
  inline static const OperatorInfo kInfo = {
      "throws_at_edges", TargetKind::edge, "help", {}, make<ThrowsAtEdges>};
};

struct ThrowsWhenMade final : VertexMover {
  ThrowsWhenMade() : VertexMover(kInfo) { throw std::runtime_error("no table found"); }
  inline static const OperatorInfo kInfo = {
      "throws_when_made", TargetKind::vertex, "help", {}, make<ThrowsWhenMade>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  registry.add(tetmend::test::ThrowsInPrecondition::kInfo);
  registry.add(tetmend::test::ThrowsInEvaluate::kInfo);
  registry.add(tetmend::test::ThrowsInApply::kInfo);
  registry.add(tetmend::test::ThrowsAtEdges::kInfo);
  registry.add(tetmend::test::ThrowsWhenMade::kInfo);
}
