// SPDX-License-Identifier: MIT
// A trace with a text beside it: NAME.json next to NAME.trace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tetmend::viewer {

/// {"title": "...", "steps": [{"event": N, "text": "..."}, ...]}
struct Lesson {
  struct Step {
    std::uint64_t position = 0;  ///< number of events that have happened
    std::string text;
  };
  std::string title;
  std::vector<Step> steps;  ///< ascending

  /// Number of the last step that is not after `position`; nothing before the first.
  std::optional<std::size_t> step_at(std::uint64_t position) const;
};

/// The lesson that lies beside a trace; nothing if there is no such file. Steps beyond the end of
/// the trace are an error. @throws Error, naming the file, when it is damaged.
std::optional<Lesson> read_lesson(const std::filesystem::path& trace, std::uint64_t event_count);

/// Traces with a lesson, by name. Looks in $TETMEND_LESSONS, or in assets/lessons above the current
/// folder, or where lessons are installed; empty without any.
std::vector<std::filesystem::path> list_lessons();

}  // namespace tetmend::viewer
