// SPDX-License-Identifier: MIT
// Operators that change the mesh past what an attempt looks at.
#include "tests/plugins/vertex_mover.h"

namespace tetmend::test {
namespace {

/// Moves a vertex that the attempt knows nothing of, with a workspace of its own: nearer to a vertex
/// beside it. False if it cannot be moved.
bool move_behind(TetMesh& mesh, VertexHandle v) {
  Workspace own(mesh);
  std::vector<HalfFace> link;
  if (mesh.is_fixed(v) || !mesh.tet_of(v).is_valid() || !collect_link(mesh, v, own, link))
    return false;
  const Point& there = mesh.point(mesh.vertices(link[0])[0]);
  Transaction hidden(mesh, own);
  const Point point = mesh.point(v) + 1e-3 * (there - mesh.point(v));
  if (hidden.move_vertex(v, point, link) != EditResult::made) return false;
  hidden.keep();
  return true;
}

/// Refuses, and has moved the vertex.
struct RefusesAndMoves final : VertexMover {
  RefusesAndMoves() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State&) const override {
    move_behind(context.mesh, target.vertex());
    return Verdict::no_improvement;
  }
  inline static const OperatorInfo kInfo = {
      "refuses_and_moves", TargetKind::vertex, "help", {}, make<RefusesAndMoves>};
};

struct ThrowsAndMoves final : VertexMover {
  ThrowsAndMoves() : VertexMover(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State&) const override {
    if (move_behind(context.mesh, target.vertex())) throw Error("out of ideas");
    return Verdict::no_improvement;
  }
  inline static const OperatorInfo kInfo = {
      "throws_and_moves", TargetKind::vertex, "help", {}, make<ThrowsAndMoves>};
};

/// Makes its vertex better, and another one worse.
struct MovesAnother final : VertexMover {
  MovesAnother() : VertexMover(kInfo) {}
  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    const Verdict verdict = VertexMover::apply(context, target, transaction, state);
    Comparison comparison;
    if (verdict != Verdict::accepted || !context.judge->accepts({transaction, comparison}))
      return Verdict::no_improvement;
    for (std::uint32_t i = 0; i < context.mesh.vertex_slots(); ++i) {
      const VertexHandle v(i);
      if (v == target.vertex() || is_near(context.mesh, v, state)) continue;
      if (move_behind(context.mesh, v)) break;
    }
    return verdict;
  }
  static bool is_near(const TetMesh& mesh, VertexHandle v, const State& state) {
    for (const HalfFace f : state.link) {
      for (const VertexHandle w : mesh.vertices(f)) {
        if (v == w) return true;
      }
    }
    return false;
  }
  inline static const OperatorInfo kInfo = {
      "moves_another", TargetKind::vertex, "help", {}, make<MovesAnother>};
};

/// Moves its vertex a good deal towards another.
class MakesWorse : public VertexMover {
 protected:
  using VertexMover::VertexMover;
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const Verdict verdict = VertexMover::evaluate(context, target, state);
    if (verdict != Verdict::accepted) return verdict;
    const Point& here = context.mesh.point(target.vertex());
    const Point& there = context.mesh.point(context.mesh.vertices(state.link[0])[0]);
    state.point = here + 0.3 * (there - here);
    return Verdict::accepted;
  }
};

/// Brings along a judge to whom nearly all is good enough.
struct JudgesItself final : MakesWorse {
  JudgesItself() : MakesWorse(kInfo, Judge::opening(0)) {}
  inline static const OperatorInfo kInfo = {
      "judges_itself", TargetKind::vertex, "help", {}, make<JudgesItself>};
};

/// Puts such a judge where its own was.
struct SwapsTheJudge final : MakesWorse {
  SwapsTheJudge() : MakesWorse(kInfo) {}
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    static const Judge kMild = Judge::opening(0);
    context.judge = &kMild;
    return MakesWorse::evaluate(context, target, state);
  }
  inline static const OperatorInfo kInfo = {
      "swaps_the_judge", TargetKind::vertex, "help", {}, make<SwapsTheJudge>};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  using namespace tetmend::test;
  registry.add(RefusesAndMoves::kInfo);
  registry.add(ThrowsAndMoves::kInfo);
  registry.add(MovesAnother::kInfo);
  registry.add(JudgesItself::kInfo);
  registry.add(SwapsTheJudge::kInfo);
}
