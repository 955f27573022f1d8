// SPDX-License-Identifier: MIT
// Questions of a lesson, answered by its trace.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "trace/lesson.h"
#include "trace/replay.h"

namespace tetmend::explain {

/// A question is about the call at hand or, where none is or that has ended, the next to begin.
struct Question {
  Ask ask = {};
  std::uint32_t call = kNoCall;  ///< that it is about; none: about the pass
  unsigned line = 0;             ///< the right one, from 1
  bool accepted = false;
  std::vector<std::array<std::uint32_t, 2>> chords = {};  ///< any of these, by vertices
  double number = 0;
  std::string why = {};  ///< in a sentence, once it is answered
};

/// The answer, from the trace alone. A number is `of`
///   degree, degree after       tets around the target of the call as it begins, and as it ends
///   worst before, worst after  quality of the worst tet among those that the call compared
///   tets removed, tets made    by the first change in the call
///   triangulations             of the whole ring, well-shaped or not
///   M_q I J, M_k I J           entries of the tables, by vertices
///   calls                      that the call makes, those in them included
///   deepest level              of recursion among them
///   bad tets                   of the mesh at this step
/// Leaves the replay where it was. Cost: a study of the call.
/// @throws Error where the trace has no answer, with the reason.
Question answer(const TraceFile& file, Replay& replay, std::uint64_t at, const Ask& ask);

/// The same, but nothing instead of an error.
std::optional<Question> try_answer(const TraceFile& file, Replay& replay, std::uint64_t at,
                                   const Ask& ask);

/// Whether these words are its answer: "accepted" or "refused"; the number of a line, from 1; the two
/// vertices of a chord; a number. Cost: few comparisons.
/// @throws Error where they are none of these, with what is expected.
bool is_right(const Question& question, std::string_view words);

/// {"kind", "text", "answer", "why"}, and "within" of a number. Lines count from 1.
nlohmann::ordered_json to_json(const Question& question);

}  // namespace tetmend::explain
