// SPDX-License-Identifier: MIT
#include "ops/edge_removal.h"

#include "ops/shell_search.h"

namespace tetmend {

namespace {

class EdgeRemoval final : public Operator {
 public:
  explicit EdgeRemoval(const ParameterValues&) : Operator(edge_removal_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    return find_searchable_shell(context, target.edge(), context.scratch.shell);
  }
  Verdict evaluate(OperatorContext& context, Target) const override {
    const Shell& shell = context.scratch.shell;
    return propose_covering(context, shell, {}, false, required_floor(context, shell));
  }
  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    return to_verdict(
        transaction.replace_cavity(context.scratch.old_tets, context.scratch.new_tets));
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
