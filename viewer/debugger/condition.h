// SPDX-License-Identifier: MIT
// Places of a trace to run to, and to stop at: what breakpoints are made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "explain/stepper.h"
#include "viewer/debugger/explained.h"

namespace tetmend::viewer {

/// Written as a word and its numbers: "deeper 2", "edge 3 17", "operator edge_removal".
struct Condition {
  enum class Kind {
    accepted,       ///< a call ended so
    refused,        ///< a call ended with any other verdict
    deeper,         ///< a call begins on a deeper level of recursion than numbers[0]
    operator_name,  ///< a call of `name` begins
    edge,           ///< a call begins whose target is the edge of two vertices
    face,           ///< likewise of three
    vertex,         ///< a call begins whose target has the vertex, or it is added, moved, removed
    tet             ///< the tet of this slot is created, changed or removed
  };
  Kind kind = Kind::accepted;
  std::string name;
  std::vector<std::uint32_t> numbers;

  friend bool operator==(const Condition&, const Condition&) = default;
};

/// @throws Error for anything else, with what is valid.
Condition parse_condition(std::string_view text);
std::string to_text(const Condition& condition);

/// The nearest position after (back: before) `from` at which the condition holds: just after the
/// event that makes it hold. Nothing if there is none.
/// Cost: linear in the calls; of a vertex or tet, reads the events on the way.
std::optional<std::uint64_t> find_stop(const TraceFile& file, const Condition& condition,
                                       std::uint64_t from, Direction direction);

}  // namespace tetmend::viewer
