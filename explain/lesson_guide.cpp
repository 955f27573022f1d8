// SPDX-License-Identifier: MIT
#include "explain/lesson_guide.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "kernel/error.h"
#include "platform/platform.h"

namespace tetmend::explain {

namespace {

std::optional<std::filesystem::path> lessons_above(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (std::filesystem::path up = folder;; up = up.parent_path()) {
    std::filesystem::path lessons = up / "assets/lessons";
    if (std::filesystem::is_directory(lessons, ignored)) return lessons;
    if (up == up.parent_path()) return std::nullopt;
  }
}

std::filesystem::path lessons_folder() {
  if (const char* folder = std::getenv("TETMEND_LESSONS")) return folder;  // NOLINT: one thread
  std::error_code ignored;
  const std::filesystem::path programs = platform::program_file().parent_path();
  if (const auto found = lessons_above(std::filesystem::current_path(ignored))) return *found;
  if (const auto found = lessons_above(programs)) return *found;  // where it was built
  return programs.parent_path() / "share/tetmend/lessons";
}

}  // namespace

std::optional<std::filesystem::path> lesson_beside(const std::filesystem::path& trace) {
  std::filesystem::path file = trace;
  file.replace_extension(".json");
  if (!is_lesson(file)) return std::nullopt;
  return file;
}

std::optional<Lesson> lesson_of(const std::filesystem::path& trace, std::uint64_t event_count) {
  const auto file = lesson_beside(trace);
  if (!file) return std::nullopt;
  Lesson lesson = read_lesson(*file);
  const std::uint64_t last = lesson.steps.back().at;
  if (last > event_count) {
    throw Error(fmt::format("{}: a step is at {}, but the trace has {} events", file->string(),
                            last, event_count));
  }
  return lesson;
}

std::filesystem::path trace_of_lesson(const std::filesystem::path& lesson) {
  std::filesystem::path trace = read_lesson(lesson).trace;
  std::filesystem::path beside = lesson;
  if (trace.lexically_normal() != beside.replace_extension(".trace").lexically_normal()) {
    throw Error(fmt::format("{}: the trace of a lesson has its name: expected '{}', not '{}'",
                            lesson.string(), beside.filename().string(),
                            trace.filename().string()));
  }
  return trace;
}

std::optional<std::size_t> step_at(const Lesson& lesson, std::uint64_t position) {
  const auto after =
      std::upper_bound(lesson.steps.begin(), lesson.steps.end(), position,
                       [](std::uint64_t p, const LessonStep& step) { return p < step.at; });
  if (after == lesson.steps.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - lesson.steps.begin()) - 1;
}

std::vector<std::filesystem::path> find_lessons() {
  return list_lessons(lessons_folder());
}

}  // namespace tetmend::explain
