// SPDX-License-Identifier: MIT
// A lesson: a recorded trace with a text that leads through it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tetmend {

struct LessonStep {
  std::uint64_t at = 0;  ///< the mesh after so many events: see Replay::seek()
  std::string text;      ///< one paragraph, without markup
};

struct Lesson {
  std::string title;
  std::filesystem::path mesh;     ///< as it is before the first event
  std::filesystem::path trace;    ///< of a run on it
  std::vector<LessonStep> steps;  ///< at least one; `at` never goes back
};

/// Reads a JSON file: {"title": "", "mesh": "FILE", "trace": "FILE", "steps": [{"at": 0, "text":
/// ""}]}. Files lie in its folder or below, and are not opened.
/// @throws Error when it cannot be read or is no lesson, with the reason.
Lesson read_lesson(const std::filesystem::path& file);

/// It is JSON that has a title and steps. False also where it cannot be read.
bool is_lesson(const std::filesystem::path& file);

/// The lessons of a folder: its files *.json, by name. Empty when there is no such folder.
std::vector<std::filesystem::path> list_lessons(const std::filesystem::path& folder);

}  // namespace tetmend
