// SPDX-License-Identifier: MIT
// A lesson proposed for a call of any run: steps and questions, to be told better by a person.
#pragma once

#include <cstdint>
#include <string>

#include "trace/lesson.h"
#include "trace/replay.h"

namespace tetmend::explain {

/// Number of questions that are proposed.
inline constexpr std::size_t kProposedQuestions = 3;

/// Steps into each level, to the first refusal of each kind, to the first change and to the end, at most
/// twelve; questions where the call begins. `title` empty: that of title_of_call().
/// Leaves the replay where it was. Cost: a study of each call that a step tells of.
/// Precondition: there is such a call.
/// @throws Error when the trace ends before the call does.
Lesson propose_lesson(const TraceFile& file, Replay& replay, std::uint32_t call,
                      const std::string& title = {});

}  // namespace tetmend::explain
