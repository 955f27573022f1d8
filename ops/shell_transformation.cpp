// SPDX-License-Identifier: MIT
#include "ops/shell_transformation.h"

#include "ops/shell_search.h"

namespace tetmend {

namespace {

class ShellTransformation final : public OperatorOf<ShellState> {
 public:
  explicit ShellTransformation(const ParameterValues&) : OperatorOf(shell_transformation_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       ShellState& state) const override {
    return find_searchable_shell(context, target.edge(), state.shell);
  }
  Verdict evaluate(OperatorContext& context, Target, ShellState& state) const override {
    return propose_covering(context, *context.judge, state.shell, {}, Core::allowed, state);
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                ShellState& state) const override {
    return state.replacement.make(transaction);
  }
};

}  // namespace

const OperatorInfo& shell_transformation_info() {
  static const OperatorInfo kInfo = {
      "shell_transformation",
      TargetKind::edge,
      "best covering mesh of the shell of an edge, full or partial reduction",
      {},
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<ShellTransformation>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
