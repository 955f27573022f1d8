// SPDX-License-Identifier: MIT
// The rows of the tree of calls: what is unfolded, and no more.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "explain/icicle.h"
#include "viewer/debugger/explained.h"

namespace tetmend::viewer {

struct CallRow {
  std::uint32_t call = kNoCall;
  unsigned indent = 0;
  bool has_children = false;
  bool is_open = false;
};

/// Unfolded are the calls of the stack and those that the user unfolds.
class CallList {
 public:
  void toggle(std::uint32_t call);
  /// Cost: linear in the rows; nothing while neither window nor stack nor folds change.
  const std::vector<CallRow>& rows(const TraceFile& file, const CallWindow& window,
                                   std::span<const std::uint32_t> stack);

 private:
  std::set<std::uint32_t> open_;
  std::set<std::uint32_t> closed_;  // of the stack
  std::vector<std::uint32_t> made_for_;
  bool stale_ = true;
  std::vector<CallRow> rows_;
};

}  // namespace tetmend::viewer
