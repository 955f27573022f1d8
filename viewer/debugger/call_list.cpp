// SPDX-License-Identifier: MIT
#include "viewer/debugger/call_list.h"

#include <algorithm>

namespace tetmend::viewer {

void CallList::toggle(std::uint32_t call) {
  const auto row =
      std::find_if(rows_.begin(), rows_.end(), [&](const CallRow& r) { return r.call == call; });
  if (row == rows_.end()) return;
  open_.erase(call);
  closed_.erase(call);
  (row->is_open ? closed_ : open_).insert(call);
  stale_ = true;
}

const std::vector<CallRow>& CallList::rows(const TraceFile& file, const CallWindow& window,
                                           std::span<const std::uint32_t> stack) {
  std::vector<std::uint32_t> wanted(stack.begin(), stack.end());
  wanted.push_back(window.first_call);
  wanted.push_back(window.last_call);
  if (!stale_ && wanted == made_for_) return rows_;
  if (wanted != made_for_) closed_.clear();  // a step shows where it has led
  made_for_ = std::move(wanted);
  stale_ = false;
  rows_.clear();
  for (std::uint32_t k = window.first_call; k < window.last_call;) {
    const Call& call = file.calls()[k];
    const bool on_stack = std::find(stack.begin(), stack.end(), k) != stack.end();
    CallRow row{k, call.depth, call.subtree_end > k + 1, false};
    row.is_open = row.has_children && (open_.contains(k) || (on_stack && !closed_.contains(k)));
    rows_.push_back(row);
    k = row.is_open ? k + 1 : call.subtree_end;
  }
  return rows_;
}

}  // namespace tetmend::viewer
