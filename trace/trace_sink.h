// SPDX-License-Identifier: MIT
// Where operators report what they do. A null sink costs one test for each attempt.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "kernel/handles.h"
#include "kernel/quality.h"

namespace tetmend {

/// One attempt of an operator as the trace sees it. Vertices name the target in a way that outlives
/// tet handles.
struct AttemptEvent {
  std::string_view operator_name;
  std::span<const VertexHandle> target;  ///< 1 vertex, 2 of an edge, 3 of a face, 4 of a tet
  unsigned level = 0;                    ///< recursion level, 0 for a call by the scheduler
};

/// Receives events in the order in which they happen; attempts nest. Views are valid during the
/// call only.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void attempt_begins(const AttemptEvent& event) = 0;
  /// `verdict` is the name of the verdict. The quality vectors (ascending) of what changed are
  /// empty after a refusal.
  virtual void attempt_ends(std::string_view verdict, std::span<const Quality> before,
                            std::span<const Quality> now) = 0;
};

}  // namespace tetmend
