// SPDX-License-Identifier: MIT
// The algorithms of the paper in short, and the line at which a trace is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "trace/trace_file.h"

namespace tetmend::viewer {

/// Lines count from 1, as in the paper; line 0 of an algorithm is its head.
struct Pseudocode {
  std::string_view title;
  std::span<const std::string_view> lines;
};

/// [chen, Alg. 3] and [chen, Alg. 4], in our words and with their numbers.
const Pseudocode& shell_transformation_code();
const Pseudocode& recursion_code();

struct CodePlace {
  const Pseudocode* code = nullptr;  ///< null: an operator that neither of them describes
  unsigned line = 0;
};

/// Where call number stack[i] is when `position` events have happened. Precondition: it is on the
/// stack of calls, which is given outermost first.
CodePlace code_place(const TraceFile& file, std::span<const std::uint32_t> stack, std::size_t i,
                     std::uint64_t position);

}  // namespace tetmend::viewer
