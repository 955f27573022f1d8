// SPDX-License-Identifier: MIT
// What the tree of calls says about each call, in one row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "trace/replay.h"

namespace tetmend::explain {

/// The tets around the target of a call, when it begins and when it has ended.
struct CallFacts {
  unsigned degree_before = 0, degree_after = 0;   ///< their number; 0: the target is gone
  Quality quality_before = 0, quality_after = 0;  ///< of the worst of them
};

/// Facts of the calls of a trace, computed for a whole outermost call at a time and kept.
class FactTable {
 public:
  /// Leaves the replay where it was. Cost, the first time in an outermost call: replay of that
  /// call, there and back.
  const CallFacts& facts(const TraceFile& file, Replay& replay, std::uint32_t call);

 private:
  static constexpr std::size_t kMostKept = 1000;

  std::map<std::uint32_t, std::vector<CallFacts>> by_root_;
};

/// The outermost call around a call, itself if there is none.
std::uint32_t root_of(const TraceFile& file, std::uint32_t call);

/// "edge 3 17"
std::string format_target(const Call& call);
/// Name of the operator, shortened for narrow columns: "recursion", "face removal".
std::string short_name(const TraceFile& file, const Call& call);
std::string short_name(std::string_view operator_name);

/// The tets that a call works on, as headings say it: "Shell", "Ball", "Cavity", ... A literal.
std::string_view neighbourhood_of(const Call& call);

/// "5 -> 4"
std::string degree_text(const CallFacts& facts);
/// "0.074 -> 0.758": of what the call compared, or of the tets around its target.
std::string quality_text(const Call& call, const CallFacts& facts);

/// How a call ended, as colours and marks tell it.
enum class Outcome {
  unfinished,
  accepted,  ///< for good
  undone,    ///< accepted, and undone with a caller
  no_improvement,
  limit,
  constrained,
  rejected,
  not_applicable,
  deferred  ///< to be tried again
};
inline constexpr std::size_t kOutcomeCount = static_cast<std::size_t>(Outcome::deferred) + 1;
Outcome outcome_of(const Call& call);
/// As legends say it: "nothing better found".
std::string_view outcome_name(Outcome outcome);
/// "accepted", "undone with call 17", "no improvement", ...; "under way" for a call that has not
/// ended at that position, "to come" before it has begun.
std::string outcome_text(const Call& call, std::uint64_t position);

}  // namespace tetmend::explain
