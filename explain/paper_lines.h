// SPDX-License-Identifier: MIT
// The algorithms of the paper and of other operators in short, and the line at which a trace is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "trace/trace_file.h"

namespace tetmend::explain {

/// Lines count from 1, those of the paper's algorithms as there; line 0 of an algorithm is its head.
struct Pseudocode {
  std::string_view title;
  std::span<const std::string_view> lines;
};

/// [chen, Alg. 3], [chen, Alg. 4] and [chen, Alg. 5], in our words and with their numbers.
const Pseudocode& shell_transformation_code();
const Pseudocode& recursion_code();
const Pseudocode& reconnection_code();
/// [chen, Alg. 2], which fills the tables of Algorithm 3: for whoever shows how.
const Pseudocode& table_code();

struct CodePlace {
  const Pseudocode* code = nullptr;  ///< null: an operator that is not described
  unsigned line = 0;                 ///< of one that has called another: where it did that
  /// Where it goes on, while the call that it made has ended and nothing has happened since; 0: not
  /// so, or not known.
  unsigned goes_on = 0;
};

/// What an attempt of that kind follows; null where it is not described.
const Pseudocode* code_of(const TraceFile& file, const Call& call);

/// Where call number stack[i] is when `position` events have happened. Precondition: it is on the
/// stack of calls, which is given outermost first.
CodePlace code_place(const TraceFile& file, std::span<const std::uint32_t> stack, std::size_t i,
                     std::uint64_t position);

/// Where the pass is that `position` is in: in Algorithm 5, or nowhere. `stack` as call_stack()
/// has it there.
CodePlace pass_place(const TraceFile& file, std::span<const std::uint32_t> stack,
                     std::uint64_t position);

}  // namespace tetmend::explain
