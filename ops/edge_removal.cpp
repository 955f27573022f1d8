// SPDX-License-Identifier: MIT
#include "ops/edge_removal.h"

#include "ops/shell_search.h"

namespace tetmend {

namespace {

class EdgeRemoval final : public OperatorOf<ShellState> {
 public:
  explicit EdgeRemoval(const ParameterValues& values)
      : OperatorOf(edge_removal_info()),
        max_degree_(static_cast<unsigned>(values.integer("max_degree"))) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       ShellState& state) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), state.shell);
    const bool is_large = verdict == Verdict::accepted && state.shell.degree > max_degree_;
    return is_large ? Verdict::not_applicable : verdict;
  }
  Verdict evaluate(OperatorContext& context, Target, ShellState& state) const override {
    return propose_covering(context, *context.judge, state.shell, {}, Core::refused, state);
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                ShellState& state) const override {
    return state.replacement.make(transaction);
  }

 private:
  unsigned max_degree_;
};

constexpr std::array<ParameterSpec, 1> kParameters = {{
    {"max_degree", ParameterSpec::Kind::integer, 3, kMaxSearchRing, kMaxSearchRing,
     "most tets around the edge"},
}};

}  // namespace

const OperatorInfo& edge_removal_info() {
  static const OperatorInfo kInfo = {
      "edge_removal", TargetKind::edge, "remove an edge: best complete triangulation of its ring",
      kParameters, [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<EdgeRemoval>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
