// SPDX-License-Identifier: MIT
// Where operators report what they do. A null sink costs one test for each attempt.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <tetmend/api.h>

#include "kernel/edit.h"
#include "kernel/handles.h"
#include "kernel/quality.h"
#include "kernel/statistics.h"
#include "trace/verdict.h"

namespace tetmend {

/// What the trace calls an attempt of several parts, which stay or go together: a sequence of a
/// schedule. Attempts of the parts lie in it.
inline constexpr std::string_view kSequenceName = "sequence";
/// What it calls the attempt of a pass to untangle a part of the mesh. Its target is the worst tet.
inline constexpr std::string_view kUntanglingName = "untangling";
/// Likewise of the pass that keeps the best variant of a neighbourhood. Its target is the tet in the middle.
inline constexpr std::string_view kVariantsName = "variants";

/// One attempt of an operator, or of a sequence, as the trace sees it. Vertices name the target in a
/// way that outlives tet handles.
struct TETMEND_API AttemptEvent {
  std::string_view operator_name;
  std::span<const VertexHandle> target;  ///< 1 vertex, 2 of an edge, 3 of a face, 4 of a tet
  unsigned level = 0;                    ///< recursion level, 0 for a call by the scheduler
  /// Values of the operator's parameters, as a script writes them; of a sequence, its parts. Empty
  /// for a call by an operator.
  std::string_view settings = {};
};

/// Receives events in the order in which they happen: passes, in them visits of tets, in them
/// attempts, which nest. Views are valid during the call only. What a sink does not care about it
/// need not override.
class TETMEND_API TraceSink : public EditListener {
 public:
  virtual void attempt_begins(const AttemptEvent& event) = 0;
  /// The quality vectors (ascending) are those of what changed, or would have: empty when nothing
  /// was compared.
  virtual void attempt_ends(Verdict verdict, std::span<const Quality> before,
                            std::span<const Quality> now) = 0;
  /// The innermost attempt knows what to do, and is about to do it; of a sequence, its first part is
  /// done.
  virtual void candidate_found() {}

  virtual void pass_begins(std::string_view /*name*/, unsigned /*round*/) {}
  virtual void pass_ends(const QualityIndicators& /*now*/) {}
  /// A pass turns to a tet that it wants to get rid of.
  virtual void visit_begins(const TetVertices& /*tet*/, Quality /*quality*/) {}
  virtual void visit_ends() {}
  /// Between two passes: from now on tets are judged by another standard.
  virtual void standard_changed(const Standard& /*standard*/) {}

  void edit_made(const TetMesh& /*mesh*/, const Journal& /*journal*/) noexcept override {}
  void edit_undone() noexcept override {}
};

}  // namespace tetmend
