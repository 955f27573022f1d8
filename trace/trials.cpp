// SPDX-License-Identifier: MIT
#include "trace/trials.h"

#include <algorithm>

namespace tetmend {

bool Trials::is_undone(std::uint64_t event) {
  if (!is_read_) read();
  const auto after = std::upper_bound(trials_.begin(), trials_.end(), event,
                                      [](std::uint64_t e, const auto& t) { return e < t.first; });
  return after != trials_.begin() && event < (after - 1)->second;
}

/// Trials inside others are left out. Nothing is undone across the border of a chunk.
void Trials::read() {
  EventCursor cursor(file_);
  std::vector<std::uint64_t> open;
  const auto begins = file_.chunk_begins();
  for (std::uint64_t k = 0; k < file_.event_count(); ++k) {
    if (!open.empty() && std::binary_search(begins.begin(), begins.end(), k)) open.clear();
    const EventKind kind = cursor.next().kind;
    if (kind == EventKind::undo) {
      while (!trials_.empty() && trials_.back().first > open.back()) trials_.pop_back();
      trials_.emplace_back(open.back(), k);
      open.pop_back();
    } else if (changes_mesh(kind)) {
      open.push_back(k);
    }
  }
  is_read_ = true;
}

}  // namespace tetmend
