// SPDX-License-Identifier: MIT
#include "trace/text_trace.h"

#include <iterator>

#include <fmt/format.h>

namespace tetmend {

void TextTrace::attempt_begins(const AttemptEvent& event) {
  auto out = std::back_inserter(text_);
  fmt::format_to(out, "{:{}}{}(", "", 2 * depth_, event.operator_name);
  for (std::size_t i = 0; i < event.target.size(); ++i) {
    fmt::format_to(out, "{}{}", i > 0 ? " " : "", event.target[i].index());
  }
  fmt::format_to(out, ") level {}\n", event.level);
  ++depth_;
}

void TextTrace::attempt_ends(Verdict verdict, std::span<const Quality> before,
                             std::span<const Quality> now) {
  --depth_;
  auto out = std::back_inserter(text_);
  fmt::format_to(out, "{:{}}-> {}", "", 2 * depth_, to_string(verdict));
  if (!before.empty() && !now.empty()) {
    fmt::format_to(out, ", {} tets {:.4f} -> {} tets {:.4f}", before.size(), before[0], now.size(),
                   now[0]);
  }
  text_ += '\n';
}

}  // namespace tetmend
