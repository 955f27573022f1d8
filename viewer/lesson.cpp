// SPDX-License-Identifier: MIT
#include "viewer/lesson.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/error.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

std::filesystem::path lessons_folder() {
  // Read before any thread is started.
  if (const char* folder = std::getenv("TETMEND_LESSONS")) return folder;  // NOLINT
  std::error_code ignored;
  for (std::filesystem::path up = std::filesystem::current_path(ignored);; up = up.parent_path()) {
    const std::filesystem::path folder = up / "assets/lessons";
    if (std::filesystem::is_directory(folder, ignored)) return folder;
    if (up == up.parent_path()) break;
  }
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return program.parent_path().parent_path() / "share/tetmend/lessons";
}

Lesson parse(const json& content) {
  Lesson lesson;
  lesson.title = content.at("title").get<std::string>();
  for (const json& step : content.at("steps")) {
    lesson.steps.push_back(
        {step.at("event").get<std::uint64_t>(), step.at("text").get<std::string>()});
  }
  return lesson;
}

}  // namespace

std::optional<std::size_t> Lesson::step_at(std::uint64_t position) const {
  const auto after =
      std::upper_bound(steps.begin(), steps.end(), position,
                       [](std::uint64_t p, const Step& step) { return p < step.position; });
  if (after == steps.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - steps.begin()) - 1;
}

std::optional<Lesson> read_lesson(const std::filesystem::path& trace, std::uint64_t event_count) {
  std::filesystem::path file = trace;
  file.replace_extension(".json");
  std::ifstream in(file);
  if (!in) return std::nullopt;
  Lesson lesson;
  try {
    lesson = parse(json::parse(in));
  } catch (const json::exception& error) {
    throw Error(fmt::format("{}: this is no lesson: {}", file.string(), error.what()));
  }
  std::uint64_t last = 0;
  for (const Lesson::Step& step : lesson.steps) {
    if (step.position > event_count || step.position < last) {
      throw Error(fmt::format("{}: event {} must lie between {} and {}, the end of the trace",
                              file.string(), step.position, last, event_count));
    }
    last = step.position;
  }
  return lesson;
}

std::vector<std::filesystem::path> list_lessons() {
  std::vector<std::filesystem::path> traces;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(lessons_folder(), error)) {
    std::filesystem::path beside = entry.path();
    if (beside.extension() != ".trace") continue;
    if (std::filesystem::exists(beside.replace_extension(".json"))) traces.push_back(entry.path());
  }
  std::sort(traces.begin(), traces.end());
  return traces;
}

}  // namespace tetmend::viewer
