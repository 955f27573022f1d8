// SPDX-License-Identifier: MIT
// A sound operator, which the plugins of the tests spoil in one stage each: moves a vertex to the
// mean of the vertices of its link.
#pragma once

#include <memory>

#include "kernel/star.h"
#include "ops/plugin.h"

namespace tetmend::test {

class VertexMover : public Operator {
 public:
  using Operator::Operator;

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const VertexHandle v = target.vertex();
    if (!context.mesh.tet_of(v).is_valid()) return Verdict::not_applicable;
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    if (!collect_link(mesh, target.vertex(), context.workspace, scratch.link)) {
      return Verdict::deferred;
    }
    Point sum = Point::Zero();
    for (const HalfFace f : scratch.link) {
      for (const VertexHandle w : mesh.vertices(f)) sum += mesh.point(w);
    }
    scratch.point = sum / (3 * static_cast<double>(scratch.link.size()));
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext& context, Target target, Transaction& transaction) const override {
    return to_verdict(
        transaction.move_vertex(target.vertex(), context.scratch.point, context.scratch.link));
  }
};

template <class Made>
std::unique_ptr<Operator> make(const ParameterValues&) {
  return std::make_unique<Made>();
}

}  // namespace tetmend::test
