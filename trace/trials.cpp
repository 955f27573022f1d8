// SPDX-License-Identifier: MIT
#include "trace/trials.h"

#include <algorithm>

namespace tetmend {

void Trials::undo(std::uint64_t event) {
  const std::uint64_t begin = open_.back();
  open_.pop_back();
  ++undos_;
  while (!trials_.empty() && trials_.back().first > begin) trials_.pop_back();
  trials_.emplace_back(begin, event);
}

bool Trials::is_undone(std::uint64_t event) const {
  const auto after = std::upper_bound(trials_.begin(), trials_.end(), event,
                                      [](std::uint64_t e, const auto& t) { return e < t.first; });
  return after != trials_.begin() && event < (after - 1)->second;
}

}  // namespace tetmend
