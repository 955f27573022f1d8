// SPDX-License-Identifier: MIT
// Lessons as the viewer has them: the one of a trace, and those that there are.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "trace/lesson.h"

namespace tetmend::explain {

/// The lesson of a trace: NAME.json beside NAME.trace; nothing if there is no such file.
/// @throws Error, naming the file, when it is no lesson or goes beyond the end of the trace.
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
