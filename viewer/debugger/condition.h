// SPDX-License-Identifier: MIT
// Places of a run to go to, and to stop at: what breakpoints are made of, in traces and live.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "explain/stepper.h"
#include "trace/replay.h"
#include "viewer/debugger/explained.h"

namespace tetmend::viewer {

/// Terms that hold together: "edge 3 17 and refused", "level 3 and worse than 0.2", "tet 4 for good".
struct Condition {
  enum class Kind : std::uint8_t {
    accepted,       ///< a call ended so; whether it lasted, `for_good` asks
    undone,         ///< a call was accepted, and undone with a caller
    refused,        ///< a call ended with any other verdict
    verdict,        ///< a call ended with the verdict `name`
    ending,         ///< a call ended in the way `name`, see CallEnding
    deeper,         ///< a call on a deeper level of recursion than numbers[0]
    level,          ///< a call on this level
    visit,          ///< a call in this visit of a tet, and the beginning of the visit
    operator_name,  ///< a call of `name`
    edge,           ///< a call whose target is the edge of two vertices
    face,           ///< likewise of three
    vertex,         ///< a call whose target has the vertex, or it is added, moved, removed
    tet,            ///< the tet of this slot is created, changed or removed
    worse,          ///< a call that has a tet of lower quality than values[0] before it
    better,         ///< a call whose worst tet before it is at least that good
    near            ///< a call with a target vertex within values[3] of the place values[0..2]
  };
  struct Term {
    Kind kind = Kind::accepted;
    std::string name;
    std::vector<std::uint32_t> numbers;
    std::vector<double> values;
    friend bool operator==(const Term&, const Term&) = default;
  };
  std::vector<Term> terms;
  bool for_good = false;  ///< no undo took back later what was there at that place

  friend bool operator==(const Condition&, const Condition&) = default;
};

struct Breakpoint {
  Condition condition;
  bool on = true;
};

/// @throws Error for anything else, with the part that is wrong and what is valid.
Condition parse_condition(std::string_view text);
std::string to_text(const Condition& condition);
/// "nothing_better": a way to end as conditions have it.
std::string word_of(CallEnding ending);
/// "accepted, refused, deeper LEVEL, ...": for help.
std::string condition_usage();

/// What conditions ask of a call, wherever it comes from.
struct ConditionCall {
  std::string_view operator_name;
  unsigned level = 0;
  std::span<const VertexHandle> target;
  std::optional<Verdict> verdict;           ///< nothing: it has not ended
  double worst = 0;                         ///< quality of the worst tet that it has before it
  std::optional<CallEnding> ending = {};    ///< what became of it; of live runs nobody knows yet
  std::optional<std::uint32_t> visit = {};  ///< that it is in; of a recorded run
};
/// Where a vertex is, in lengths of the file; nothing for one that is not there.
using PlaceOf = std::function<std::optional<Point>(VertexHandle)>;

/// Whether a term holds of a call. One about a tet never does.
bool holds(const Condition::Term& term, const ConditionCall& call, const PlaceOf& place_of);
/// A term that asks how the call ended.
bool is_about_end(const Condition::Term& term);
/// A term that asks what became of a call later, for its reason, or for a number of the record.
bool is_about_record(const Condition::Term& term);
/// A term that edits make hold, too.
bool is_about_edit(const Condition::Term& term);

/// What find_stop() reads.
struct ConditionSource {
  const TraceFile& file;
  Replay& replay;  ///< left anywhere by conditions on places
};

/// The nearest position after (back: before) `from` at which the condition holds: just after the
/// event that makes it hold. Nothing if there is none.
/// Cost: linear in the calls on the way; of a vertex or tet, reads the events on the way.
std::optional<std::uint64_t> find_stop(const ConditionSource& source, const Condition& condition,
                                       std::uint64_t from, Direction direction);

/// @throws Error where a term names an operator that no call of the trace is of, with those that are.
/// Cost: linear in the calls.
void need_known_operators(const TraceFile& file, const Condition& condition);

/// All calls of which the condition holds, the nearest to being accepted first: see Call::missing().
/// @throws Error when it is about edits. Cost: linear in the calls; of a place, replays them.
std::vector<std::uint32_t> find_all(const ConditionSource& source, const Condition& condition);

}  // namespace tetmend::viewer
