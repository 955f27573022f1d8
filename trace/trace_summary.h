// SPDX-License-Identifier: MIT
// A trace in numbers: who was called how often, how deep, with what success, for how long.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "trace/trace_file.h"

namespace tetmend {

struct TraceSummary {
  struct Tally {
    std::size_t calls = 0;
    std::size_t for_good = 0;  ///< accepted, and it lasted
    std::size_t undone = 0;    ///< accepted, and undone with a caller
  };
  struct Operator {
    Tally all;
    std::map<std::string_view, std::size_t> verdicts;  ///< by Call::verdict_text()
    std::map<unsigned, Tally> levels;                  ///< by level of recursion
    double seconds = 0;      ///< of calls that are in no other call of the operator
    double own_seconds = 0;  ///< without calls in them
  };

  std::map<std::string, Operator> operators;  ///< by name
  std::size_t calls = 0;
  std::size_t outermost_calls = 0;
  std::size_t visits = 0;
  std::size_t edits = 0;
  std::size_t undos = 0;
  unsigned deepest = 0;                ///< calls around the deepest call
  std::vector<std::uint32_t> largest;  ///< outermost calls with most calls in them, ten at most
};

/// Cost: linear.
TraceSummary summarize(const TraceFile& file);

/// As text, with a line for each pass.
std::string format_summary(const TraceFile& file, const TraceSummary& summary);

}  // namespace tetmend
