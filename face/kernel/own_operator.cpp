// SPDX-License-Identifier: MIT
// Operators of a program among those of tetmend: propose by its function, edit, ask its judge.
#include "face/kernel/own_operator.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/transaction.h"
#include "kernel/workspace.h"

namespace tetmend::kernel {

const TetMesh& OwnOperator::look_at(OperatorContext& context, OwnState& state) const {
  if (program_ != nullptr && &program_->mesh_ == &context.mesh) return *program_;
  if (!state.look || &state.look->mesh_ != &context.mesh) {
    state.look.reset(new TetMesh(context.mesh));
  }
  return *state.look;
}

Verdict OwnOperator::evaluate(OperatorContext& context, Target target, OwnState& state) const {
  state.proposal = {};
  return own_.propose(look_at(context, state), target, state.proposal);
}

EditResult OwnOperator::make(OperatorContext& context, tetmend::Transaction& transaction,
                             OwnState& state) const {
  const Proposal& proposal = state.proposal;
  const TetMesh& look = look_at(context, state);
  const auto is_there = [&](VertexHandle v) {
    return v.index() < context.mesh.vertex_slots() && !context.mesh.is_deleted(v);
  };
  EditResult result = EditResult::not_closed;
  if (!proposal.old_.empty()) {
    const bool fits =
        std::none_of(proposal.old_.begin(), proposal.old_.end(),
                     [&](TetHandle t) { return look.is_deleted(t); }) &&
        std::all_of(proposal.created_.begin(), proposal.created_.end(), [&](const TetVertices& v) {
          return std::all_of(v.begin(), v.end(), is_there);
        });
    if (fits) result = transaction.replace_cavity(proposal.old_, proposal.created_);
    if (result != EditResult::made) return result;
  }
  if (!proposal.moves_) return result;
  const VertexHandle v = proposal.vertex_;
  const Point& point = proposal.place_;
  if (!is_there(v) || !point.allFinite()) return EditResult::not_closed;
  const Link link = look.link(v);
  if (link.empty()) return EditResult::not_closed;
  return transaction.move_vertex(v, context.mesh.scale().to_work(point),
                                 {link.data(), link.size()});
}

Verdict OwnOperator::apply(OperatorContext& context, Target, tetmend::Transaction& transaction,
                           OwnState& state) const {
  const EditResult made = make(context, transaction, state);
  const auto& is_better = own_.judge.criterion();
  if (made != EditResult::made || !is_better) return to_verdict(made);
  const auto to_file = [&](std::span<const std::array<Point, 4>> tets) {
    std::vector<std::array<Point, 4>> corners(tets.begin(), tets.end());
    for (auto& tet : corners) {
      for (Point& p : tet) p = context.mesh.scale().to_file(p);
    }
    return corners;
  };
  const auto changed = transaction.tets();
  const auto before = to_file(changed.before);
  const auto now = to_file(changed.now);
  return is_better(before, now) ? Verdict::accepted : Verdict::no_improvement;
}

void add_to(Registry& registry, const Operators& own, const TetMesh* program) {
  auto infos = std::make_shared<std::deque<OperatorInfo>>();  // each maker keeps them
  for (const auto& [name, each] : own.all()) {
    const OperatorInfo& info = infos->emplace_back(OperatorInfo{
        .name = name, .target = each.target, .help = each.help, .parameters = {}, .make = nullptr});
    registry.add(info, [infos, &info, &each = each, program](const ParameterValues&) {
      return std::make_unique<OwnOperator>(info, each, program);
    });
  }
  for (const Standard& measure : own.measures()) registry.add_measure(measure);
}

}  // namespace tetmend::kernel
