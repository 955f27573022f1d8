// SPDX-License-Identifier: MIT
// Which events of a trace worked on a mesh that was undone afterwards.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "trace/trace_file.h"

namespace tetmend {

/// Reads the trace at the first question. Precondition: the file outlives this.
class Trials {
 public:
  explicit Trials(const TraceFile& file) : file_(file) {}

  /// The event changed a mesh, or looked at one, that an undo took back later.
  /// Cost: logarithmic; the first time, all events are read.
  bool is_undone(std::uint64_t event);

 private:
  void read();

  const TraceFile& file_;
  bool is_read_ = false;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> trials_;  // from an edit to its undo
};

}  // namespace tetmend
