// SPDX-License-Identifier: MIT
// The whole of a run: who was asked how often, how that ended and why, and what that cost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trace/trace_file.h"

namespace tetmend {

struct LedgerCell {
  std::size_t calls = 0;
  double seconds = 0;  ///< of the calls themselves, without those in them
  /// The least that a refused call of these was missing, see Call::missing(); infinite where none
  /// compared anything.
  double nearest = std::numeric_limits<double>::infinity();
  LedgerCell& operator+=(const LedgerCell& other);
};

/// Refused calls missed by less than the first, the second, ... of these: see Call::missing().
inline constexpr std::array<double, 4> kNearness = {0.001, 0.01, 0.1, 1};

/// Calls of one operator on one level of recursion, or a sum of such rows.
struct LedgerRow {
  std::string_view operator_name;  ///< valid as long as the trace; empty: of all
  unsigned level = 0;
  std::array<LedgerCell, kEndingCount> cells{};  ///< by CallEnding; each call is in one
  /// Of refusals: worst tet good enough, but not others; within each of kNearness; farther away;
  /// nothing compared.
  std::array<std::size_t, kNearness.size() + 3> nearness{};

  const LedgerCell& cell(CallEnding ending) const {
    return cells[static_cast<std::size_t>(ending)];
  }
  LedgerCell total() const;
  LedgerCell refused() const;
  LedgerRow& operator+=(const LedgerRow& other);
};

struct Ledger {
  std::vector<LedgerRow> rows;  ///< by name and level
  LedgerRow all;
  std::size_t edits = 0;    ///< made
  std::size_t lasting = 0;  ///< and never undone

  /// The rows of each operator, added up; the level is 0.
  std::vector<LedgerRow> by_operator() const;
};

/// Cost: linear in the calls, about a tenth of a microsecond each.
Ledger make_ledger(const TraceFile& file);

/// Which calls of a ledger; what is not given may be any.
struct LedgerQuestion {
  std::string operator_name;  ///< empty: all
  std::optional<unsigned> level;
  std::optional<CallEnding> ending;
  bool refused = false;  ///< all refusals
};
/// By Call::missing(): the nearest to being accepted first, those that lack as much in their order.
/// Cost: linear, and sorting what is found.
std::vector<std::uint32_t> calls_in(const TraceFile& file, const LedgerQuestion& question);

/// For people: a block for each operator, with a line for each way in which its calls ended.
std::string format_ledger(const Ledger& ledger);
/// For other programs: an object with number, share and seconds for each cell that has calls.
std::string ledger_json(const TraceFile& file, const Ledger& ledger);

}  // namespace tetmend
