// SPDX-License-Identifier: MIT
// An operator of a program in the hands of a pass. Only for the source of runs.
#pragma once

#include "face/kernel/own_operators.h"
#include "face/kernel/tet_mesh.h"
#include "ops/operator.h"

namespace tetmend::kernel {

/// What it proposes; in between, nothing changes.
struct OwnState {
  Proposal proposal;
};

class OwnOperator final : public OperatorOf<OwnState> {
 public:
  /// All must outlive it.
  OwnOperator(const OperatorInfo& info, const Operators::Own& own, const TetMesh& look)
      : OperatorOf(info,
                   own.judge.criterion() ? tetmend::Judge::opening(0) : tetmend::Judge::strict()),
        own_(own),
        look_(look) {}

 protected:
  Verdict precondition(const OperatorContext&, Target, OwnState&) const override {
    return Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target target, OwnState& state) const override;
  Verdict apply(OperatorContext& context, Target target, tetmend::Transaction& transaction,
                OwnState& state) const override;

 private:
  EditResult make(const OperatorContext& context, tetmend::Transaction& transaction,
                  const Proposal& proposal) const;

  const Operators::Own& own_;
  const TetMesh& look_;
};

}  // namespace tetmend::kernel
