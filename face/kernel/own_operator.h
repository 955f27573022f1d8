// SPDX-License-Identifier: MIT
// An operator of a program in the hands of a pass.
#pragma once

#include <memory>

#include "face/kernel/own_operators.h"
#include "face/kernel/tet_mesh.h"
#include "ops/operator.h"
#include "ops/registry.h"

namespace tetmend::kernel {

/// What it proposes; in between, nothing changes.
struct OwnState {
  Proposal proposal;
  std::unique_ptr<TetMesh> look;  // where the mesh of the pass is none of the program
};

class OwnOperator final : public OperatorOf<OwnState> {
 public:
  /// All must outlive it. @param program its mesh, if it has one
  OwnOperator(const OperatorInfo& info, const Operators::Own& own, const TetMesh* program)
      : OperatorOf(info,
                   own.judge.criterion() ? tetmend::Judge::opening(0) : tetmend::Judge::strict()),
        own_(own),
        program_(program) {}

 protected:
  Verdict precondition(const OperatorContext&, Target, OwnState&) const override {
    return Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target target, OwnState& state) const override;
  Verdict apply(OperatorContext& context, Target target, tetmend::Transaction& transaction,
                OwnState& state) const override;

 private:
  const TetMesh& look_at(OperatorContext& context, OwnState& state) const;
  EditResult make(OperatorContext& context, tetmend::Transaction& transaction,
                  OwnState& state) const;

  const Operators::Own& own_;
  const TetMesh* program_;
};

/// Operators and measures of a program for schedules. `own` must outlive the registry and its copies.
/// @param program the mesh that passes work on, or null where it is not one of <tetmend/kernel.h>
/// @throws Error for a name that is taken
void add_to(Registry& registry, const Operators& own, const TetMesh* program);

}  // namespace tetmend::kernel
