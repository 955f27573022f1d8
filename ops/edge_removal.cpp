// SPDX-License-Identifier: MIT
#include "ops/edge_removal.h"

#include "ops/shell_search.h"

namespace tetmend {

namespace {

class EdgeRemoval final : public OperatorOf<ShellState> {
 public:
  explicit EdgeRemoval(const ParameterValues&) : OperatorOf(edge_removal_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       ShellState& state) const override {
    return find_searchable_shell(context, target.edge(), state.shell);
  }
  Verdict evaluate(OperatorContext& context, Target, ShellState& state) const override {
    return propose_covering(context, *context.judge, state.shell, {}, Core::refused, state);
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                ShellState& state) const override {
    return state.replacement.make(transaction);
  }
};

}  // namespace

const OperatorInfo& edge_removal_info() {
  static const OperatorInfo kInfo = {
      "edge_removal",
      TargetKind::edge,
      "remove an edge: best complete triangulation of its ring",
      {},
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<EdgeRemoval>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
