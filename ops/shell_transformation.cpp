// SPDX-License-Identifier: MIT
#include "ops/shell_transformation.h"

#include "ops/shell_search.h"

namespace tetmend {

namespace {

class ShellTransformation final : public Operator {
 public:
  explicit ShellTransformation(const ParameterValues&) : Operator(shell_transformation_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    return find_searchable_shell(context, target.edge(), context.scratch.shell);
  }
  Verdict evaluate(OperatorContext& context, Target) const override {
    const Shell& shell = context.scratch.shell;
    return propose_covering(context, shell, {}, true, required_floor(context, shell));
  }
  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    return to_verdict(
        transaction.replace_cavity(context.scratch.old_tets, context.scratch.new_tets));
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
