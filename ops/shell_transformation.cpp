// SPDX-License-Identifier: MIT
#include "ops/builtin_operators.h"
#include "ops/shell_search.h"

namespace tetmend {

namespace {

/// Target: an edge. Replaces its shell by the best covering ([chen, Alg. 3]). With a core allowed,
/// this is the shell transformation: the edge vanishes (full reduction) or keeps a smaller shell
/// (partial reduction). Without, it is edge removal, the classic baseline: the best complete
/// triangulation of the ring ([shewchuk_two]; [chen, 4.1]). Refuses boundary and constrained edges
/// and rings of more than 16. Cost: O(m^3) for degree m.
template <Core core>
class ShellTransformation final : public OperatorOf<ShellState> {
 public:
  explicit ShellTransformation(const ParameterValues& values)
      : OperatorOf(kIsRemoval ? edge_removal_info() : shell_transformation_info()),
        max_degree_(kIsRemoval ? static_cast<unsigned>(values.integer("max_degree"))
                               : kMaxSearchRing) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       ShellState& state) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), state.shell);
    const bool is_large = verdict == Verdict::accepted && state.shell.degree > max_degree_;
    return is_large ? Verdict::not_applicable : verdict;
  }
  Verdict evaluate(OperatorContext& context, Target, ShellState& state) const override {
    return propose_covering(context, *context.judge, state.shell, {}, core, state);
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                ShellState& state) const override {
    return state.replacement.make(transaction);
  }

 private:
  static constexpr bool kIsRemoval = core == Core::refused;
  unsigned max_degree_;
};

constexpr std::array<ParameterSpec, 1> kRemovalParameters = {{
    {"max_degree", ParameterSpec::Kind::integer, 3, kMaxSearchRing, kMaxSearchRing,
     "most tets around the edge"},
}};

}  // namespace

const OperatorInfo& shell_transformation_info() {
  static constexpr OperatorInfo kInfo = describe<ShellTransformation<Core::allowed>>(
      "shell_transformation", TargetKind::edge,
      "best covering mesh of the shell of an edge, full or partial reduction");
  return kInfo;
}

const OperatorInfo& edge_removal_info() {
  static constexpr OperatorInfo kInfo = describe<ShellTransformation<Core::refused>>(
      "edge_removal", TargetKind::edge, "remove an edge: best complete triangulation of its ring",
      kRemovalParameters);
  return kInfo;
}

}  // namespace tetmend
