// SPDX-License-Identifier: MIT
// What attempts on one mesh need besides it. Only for the sources of attempts.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "face/kernel/own_operators.h"
#include "ops/registry.h"

namespace tetmend::kernel {

struct OperatorTools {
  Registry registry = Registry::builtin();
  std::map<std::string, std::unique_ptr<Operator>, std::less<>> operators;  // with their defaults
  OperatorStates states;

  static OperatorTools& of(TetMesh& mesh);
  const Operator& find(std::string_view name);
  /// The tet of a target; invalid for a vertex.
  static TetHandle tet_of(Target target);
  /// @throws Error for what the mesh never had
  static bool is_live(const TetMesh& mesh, Target target);
  /// @throws Error unless the operator is for it
  static void check_target(std::string_view name, TargetKind kind, Target target);
  /// @param observer told of all, but not of the undo at the end; null: nobody
  Call attempt(TetMesh& mesh, const Operator& op, Target target, bool keeps,
               TraceSink* observer = nullptr);
  static Call attempt_at(TetMesh& mesh, std::string_view operator_name, Target target,
                         const ParameterSettings& settings, bool keeps,
                         TraceSink* observer = nullptr);
  static std::string trace_of_attempt(TetMesh& mesh, std::string_view operator_name, Target target,
                                      const ParameterSettings& settings);
  Call attempt_own(TetMesh& mesh, const Operators::Own& op, Target target, bool keeps);
  bool accepts(const Judge& judge, Target target, const TetVertices& corners,
               const Transaction& scope);
};

}  // namespace tetmend::kernel
