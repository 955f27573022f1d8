// SPDX-License-Identifier: MIT
// Lessons as the viewer has them: the one of a trace, and those that there are.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "trace/lesson.h"

namespace tetmend::explain {

/// Where the lesson of a trace is: NAME.json beside NAME.trace. Nothing if there is no such file, or if
/// it is no lesson, such as the report of the run.
std::optional<std::filesystem::path> lesson_beside(const std::filesystem::path& trace);

/// That lesson.
/// @throws Error, naming the file, when it has mistakes or goes beyond the end of the trace.
std::optional<Lesson> lesson_of(const std::filesystem::path& trace, std::uint64_t event_count);

/// The trace that a lesson leads through: NAME.trace beside NAME.json.
/// @throws Error, naming the file, when it is no lesson, or one of a trace of another name.
std::filesystem::path trace_of_lesson(const std::filesystem::path& lesson);

/// Number of the last step that is not after `position`; nothing before the first.
std::optional<std::size_t> step_at(const Lesson& lesson, std::uint64_t position);

/// Those of the folder that TETMEND_LESSONS names, else of assets/lessons in or above the current
/// folder or that of the program, else of share/tetmend/lessons where the program is installed.
std::vector<std::filesystem::path> find_lessons();

}  // namespace tetmend::explain
