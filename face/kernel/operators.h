// SPDX-License-Identifier: MIT
// One attempt of an operator on a program's mesh, and all that happened in it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/api.h>

#include "face/kernel/tet_mesh.h"
#include "ops/parameters.h"
#include "ops/target.h"
#include "trace/verdict.h"

namespace tetmend::kernel {

using tetmend::ParameterSettings;
using tetmend::Target;
using tetmend::TargetKind;
using tetmend::Verdict;

/// An attempt, with those that it made itself.
struct TETMEND_API Call {
  std::string operator_name;
  std::vector<VertexHandle> target;  ///< 1 of a vertex, 2 of an edge, 3 of a face, 4 of a tet
  unsigned level = 0;                ///< of a recursion, from 0
  Verdict verdict = Verdict::not_applicable;
  /// Worst quality of what changed, or would have: 0 where nothing was compared.
  double worst_before = 0;
  double worst_after = 0;
  std::size_t edits = 0;  ///< those that were taken back included; not those of its calls
  std::vector<Call> children;

  bool accepted() const { return verdict == Verdict::accepted; }
  /// Calls in all, this one included.
  std::size_t size() const;
  /// A line for each call, indented by its depth.
  std::string text() const;
};

/// See attempt() and try_only().
TETMEND_API Call attempt_at(TetMesh& mesh, std::string_view operator_name, Target target,
                            const ParameterSettings& settings, bool keeps);

/// try_only(), written down: the bytes of a trace (docs/trace.md) whose first call is the attempt,
/// with what it did not undone. Cost: linear in the mesh. @throws Error as attempt() does, and
/// while a transaction is open
TETMEND_API std::string trace_of_attempt(TetMesh& mesh, std::string_view operator_name,
                                         Target target, const ParameterSettings& settings = {});

/// Tries an operator of tetmend at a tet, an edge, a face or a vertex, whichever it is for. What it
/// does stays if the operator's judge accepts it; otherwise the mesh is as it was, bit for bit. At
/// something deleted it is not applicable. May be called in a transaction.
/// @param settings values of its parameters: {{"max_level", 5}}
/// @throws Error for an unknown operator, a parameter or a target that it does not have
template <class Handle>
Call attempt(TetMesh& mesh, std::string_view operator_name, Handle target,
             const ParameterSettings& settings = {}) {
  return attempt_at(mesh, operator_name, Target::of(target), settings, true);
}

/// The same, and undone whatever came of it: what would happen.
template <class Handle>
Call try_only(TetMesh& mesh, std::string_view operator_name, Handle target,
              const ParameterSettings& settings = {}) {
  return attempt_at(mesh, operator_name, Target::of(target), settings, false);
}

}  // namespace tetmend::kernel
