// SPDX-License-Identifier: MIT
#include "trace/lesson.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "kernel/error.h"
#include "kernel/formats/input_file.h"
#include "kernel/printable.h"

namespace tetmend {

namespace {

constexpr std::uint64_t kLastCall = std::numeric_limits<std::uint32_t>::max() - 1;

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

/// The place of a word in a list.
template <std::size_t N>
std::size_t place_of(const std::string& word, const std::array<std::string_view, N>& words,
                     std::string_view what) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  throw Error(
      fmt::format("there is no {} '{}'; there are: {}", what, word, fmt::join(words, ", ")));
}

Ask ask_from(const nlohmann::json& json) {
  Ask ask;
  ask.kind = static_cast<Ask::Kind>(
      place_of(json.at("kind").get<std::string>(), Ask::kKindNames, "kind of question"));
  ask.text = json.at("text").get<std::string>();
  if (ask.kind != Ask::Kind::number) return ask;
  ask.of = json.at("of").get<std::string>();
  ask.within = json.value("within", 0.0);
  if (!(ask.within >= 0 && std::isfinite(ask.within))) throw Error("'within' is below 0");
  return ask;
}

LessonStep step_from(const nlohmann::json& json) {
  const nlohmann::json& at = json.at("at");
  if (!at.is_number_unsigned()) throw Error("'at' is no number of events");
  LessonStep step{at.get<std::uint64_t>(), json.at("text").get<std::string>()};
  if (json.contains("focus")) {
    for (const nlohmann::json& focus : json.at("focus")) {
      const std::size_t place = place_of(focus.get<std::string>(), kFocusNames, "focus");
      step.focus.push_back(static_cast<Focus>(place));
    }
  }
  if (json.contains("ask")) step.ask = ask_from(json.at("ask"));
  return step;
}

Lesson from_json(const nlohmann::json& json, const std::filesystem::path& folder) {
  Lesson lesson;
  lesson.title = json.at("title").get<std::string>();
  if (json.contains("mesh")) lesson.mesh = file_of(json, "mesh", folder);
  lesson.trace = file_of(json, "trace", folder);
  if (json.contains("call")) {
    const nlohmann::json& call = json.at("call");
    if (!call.is_number_unsigned() || call.get<std::uint64_t>() > kLastCall) {
      throw Error("'call' is no number of a call");
    }
    lesson.call = call.get<std::uint32_t>();
  }
  for (const nlohmann::json& step : json.at("steps")) lesson.steps.push_back(step_from(step));
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

nlohmann::ordered_json to_json(const LessonStep& step) {
  nlohmann::ordered_json json = {{"at", step.at}, {"text", step.text}};
  if (!step.focus.empty()) {
    nlohmann::ordered_json& focus = json["focus"] = nlohmann::ordered_json::array();
    for (const Focus f : step.focus) focus.push_back(kFocusNames[static_cast<std::size_t>(f)]);
  }
  if (!step.ask) return json;
  const Ask& ask = *step.ask;
  json["ask"] = {{"kind", Ask::kKindNames[static_cast<std::size_t>(ask.kind)]}, {"text", ask.text}};
  if (ask.kind != Ask::Kind::number) return json;
  json["ask"]["of"] = ask.of;
  if (ask.within > 0) json["ask"]["within"] = ask.within;
  return json;
}

/// "10-sheet" comes after "9-core".
std::pair<std::uint64_t, std::string> rank_of(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::uint64_t number = std::numeric_limits<std::uint64_t>::max();  // names without one come last
  std::from_chars(name.data(), name.data() + name.size(), number);
  return {number, std::move(name)};
}

}  // namespace

std::string lesson_text(const Lesson& lesson, const std::filesystem::path& folder) {
  const auto name_of = [&](const std::filesystem::path& file) {
    return file.lexically_relative(folder).generic_string();
  };
  nlohmann::ordered_json json = {{"title", lesson.title}};
  if (!lesson.mesh.empty()) json["mesh"] = name_of(lesson.mesh);
  json["trace"] = name_of(lesson.trace);
  if (lesson.call) json["call"] = *lesson.call;
  json["steps"] = nlohmann::ordered_json::array();
  for (const LessonStep& step : lesson.steps) json["steps"].push_back(to_json(step));
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

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
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return rank_of(a) < rank_of(b); });
  return files;
}

}  // namespace tetmend
