// SPDX-License-Identifier: MIT
// A sound operator, which the plugins of the tests spoil in one stage each: moves a vertex to the
// mean of the vertices of its link.
#pragma once

#include <memory>
#include <vector>

#include <tetmend/plugin.h>

namespace tetmend::test {

struct MoverState {
  std::vector<HalfFace> link;
  Point point = Point::Zero();
};

class VertexMover : public OperatorOf<MoverState> {
 public:
  using State = MoverState;
  explicit VertexMover(const OperatorInfo& info, const Judge& judge = Judge::strict())
      : OperatorOf(info, judge) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const VertexHandle v = target.vertex();
    if (!context.mesh.tet_of(v).is_valid()) return Verdict::not_applicable;
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    if (!collect_link(mesh, target.vertex(), context.workspace, state.link)) {
      return Verdict::deferred;
    }
    Point sum = Point::Zero();
    for (const HalfFace f : state.link) {
      for (const VertexHandle w : mesh.vertices(f)) sum += mesh.point(w);
    }
    state.point = sum / (3 * static_cast<double>(state.link.size()));
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext&, Target target, Transaction& transaction,
                State& state) const override {
    return to_verdict(transaction.move_vertex(target.vertex(), state.point, state.link));
  }
};

template <class Made>
std::unique_ptr<Operator> make(const ParameterValues&) {
  return std::make_unique<Made>();
}

}  // namespace tetmend::test
