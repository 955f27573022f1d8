// SPDX-License-Identifier: MIT
// Attempts of operators that a program wrote: propose, edit, judge, keep or undo.
#include "face/kernel/own_operators.h"

#include <utility>

#include <fmt/format.h>

#include "face/kernel/operator_tools.h"
#include "kernel/workspace.h"
#include "ops/registry.h"

namespace tetmend::kernel {

Verdict Proposal::replace(std::span<const TetHandle> old, std::span<const TetVertices> created) {
  old_.assign(old.begin(), old.end());
  created_.assign(created.begin(), created.end());
  return Verdict::accepted;
}

Verdict Proposal::move(VertexHandle v, const Point& point) {
  moves_ = true;
  vertex_ = v;
  place_ = point;
  return Verdict::accepted;
}

EditResult Proposal::make(Transaction& edit) const {
  EditResult result = EditResult::not_closed;
  if (!old_.empty()) {
    result = edit.replace(old_, std::span<const TetVertices>(created_));
    if (result != EditResult::made) return result;
  }
  return moves_ ? edit.move(vertex_, place_) : result;
}

void Operators::add(std::string_view name, std::string_view help, TargetKind target, Judge judge,
                    std::function<Verdict(const TetMesh&, Target, Proposal&)> propose) {
  const Registry builtin = Registry::builtin();
  for (const OperatorInfo* known : builtin.operators()) {
    if (known->name == name) throw Error(fmt::format("operator '{}' is one of tetmend", name));
  }
  const bool is_new = operators_
                          .try_emplace(std::string(name), Own{target, std::string(help),
                                                              std::move(judge), std::move(propose)})
                          .second;
  if (!is_new) throw Error(fmt::format("operator '{}' is registered twice", name));
}

Standard Operators::add_measure(OwnMeasure measure) {
  Standard standard = Standard::of(std::move(measure), {}, Standard::kUsualPrice);
  for (const Standard& known : measures_) {
    if (known.measure_name() == standard.measure_name()) {
      throw Error(fmt::format("measure '{}' is registered twice", standard.measure_name()));
    }
  }
  return measures_.emplace_back(std::move(standard));
}

const Operators::Own* Operators::find(std::string_view name) const {
  const auto found = operators_.find(name);
  return found == operators_.end() ? nullptr : &found->second;
}

bool OperatorTools::accepts(const Judge& judge, Target target, const TetVertices& corners,
                            const Transaction& scope) {
  if (const auto& is_better = judge.criterion()) {
    const auto before = scope.before();
    const auto now = scope.after();
    return is_better(before, now);
  }
  return tetmend::Judge::strict().accepts(
      {scope.inner_, states.comparison, tet_of(target), corners});
}

/// Where something is there. Exceptions leave the mesh to the end of the scope.
Call OperatorTools::attempt_own(TetMesh& mesh, const Operators::Own& op, Target target,
                                bool keeps) {
  Call call;
  const TargetVertices vertices(mesh.mesh_, target);
  call.target.assign(vertices.all().begin(), vertices.all().end());
  const TetHandle tet = tet_of(target);
  const TetVertices corners = tet.is_valid() ? mesh.vertices(tet) : TetVertices{};
  Proposal proposal;
  call.verdict = op.propose(mesh, target, proposal);
  if (!call.accepted()) return call;
  Transaction scope(mesh);
  call.verdict = to_verdict(proposal.make(scope));
  if (!call.accepted()) return call;
  call.edits = 1;
  std::vector<Quality> before, now;
  scope.inner_.compare(before, now);
  if (!before.empty()) call.worst_before = static_cast<double>(before.front());
  if (!now.empty()) call.worst_after = static_cast<double>(now.front());
  if (!accepts(op.judge, target, corners, scope)) call.verdict = Verdict::no_improvement;
  if (keeps && call.accepted()) scope.keep();
  return call;
}

Call attempt_at(TetMesh& mesh, const Operators& operators, std::string_view operator_name,
                Target target, bool keeps) {
  const Operators::Own* own = operators.find(operator_name);
  if (own == nullptr) return attempt_at(mesh, operator_name, target, {}, keeps);
  OperatorTools::check_target(operator_name, own->target, target);
  Call call;
  if (OperatorTools::is_live(mesh, target)) {
    call = OperatorTools::of(mesh).attempt_own(mesh, *own, target, keeps);
  }
  call.operator_name = operator_name;
  return call;
}

}  // namespace tetmend::kernel
