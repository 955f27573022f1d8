// SPDX-License-Identifier: MIT
#include "trace/lesson.h"

#include <algorithm>
#include <exception>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/error.h"
#include "kernel/formats/input_file.h"
#include "kernel/printable.h"

namespace tetmend {

namespace {

/// A file beside the lesson or below: who sends a lesson does not choose among the files of others.
std::filesystem::path file_of(const nlohmann::json& json, const char* member,
                              const std::filesystem::path& folder) {
  const std::filesystem::path name = json.at(member).get<std::string>();
  if (name.empty() || name.is_absolute() ||
      std::find(name.begin(), name.end(), "..") != name.end()) {
    throw Error(fmt::format("'{}' leads out of its folder", member));
  }
  return folder / name;
}

Lesson from_json(const nlohmann::json& json, const std::filesystem::path& folder) {
  Lesson lesson;
  lesson.title = json.at("title").get<std::string>();
  lesson.mesh = file_of(json, "mesh", folder);
  lesson.trace = file_of(json, "trace", folder);
  for (const nlohmann::json& step : json.at("steps")) {
    const nlohmann::json& at = step.at("at");
    if (!at.is_number_unsigned()) throw Error("'at' is no number of events");
    lesson.steps.push_back({at.get<std::uint64_t>(), step.at("text").get<std::string>()});
  }
  if (lesson.steps.empty()) throw Error("has no steps");
  const auto is_before = [](const LessonStep& a, const LessonStep& b) { return a.at < b.at; };
  if (!std::is_sorted(lesson.steps.begin(), lesson.steps.end(), is_before)) {
    throw Error("a step goes back");
  }
  return lesson;
}

/// Without "[json.exception.parse_error.101] ", which tells people nothing.
std::string_view reason_of(const std::exception& error) {
  const std::string_view text = error.what();
  const std::size_t end = text.starts_with("[json.") ? text.find("] ") : text.npos;
  return end == text.npos ? text : text.substr(end + 2);
}

}  // namespace

Lesson read_lesson(const std::filesystem::path& file) {
  const formats::InputFile text(file);
  try {
    return from_json(nlohmann::json::parse(text.begin(), text.end()), file.parent_path());
  } catch (const std::exception& error) {
    constexpr std::size_t kLongest = 200;  // the reason may quote any amount of the file
    throw Error(
        fmt::format("{}: is no lesson: {}", file.string(), printable(reason_of(error), kLongest)));
  }
}

bool is_lesson(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  try {
    const formats::InputFile text(file);
    const auto json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
    return json.is_object() && json.contains("title") && json.contains("steps");
  } catch (const Error&) {
    return false;
  }
}

std::vector<std::filesystem::path> list_lessons(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace tetmend
