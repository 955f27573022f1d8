// SPDX-License-Identifier: MIT
// tetmend lesson: recorded runs with a text that leads through them, read here or in a browser.

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/catalogue.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/standard_streams.h"
#include "explain/lesson_guide.h"
#include "explain/page.h"
#include "kernel/formats/output_file.h"

namespace tetmend::apps {
namespace {

struct LessonOptions {
  std::string name;
  std::filesystem::path output;
  bool html = false;
};

std::string name_of(const std::filesystem::path& lesson) {
  return lesson.stem().string();
}

std::filesystem::path find(const std::string& name,
                           const std::vector<std::filesystem::path>& lessons) {
  const auto found = std::find_if(lessons.begin(), lessons.end(),
                                  [&](const auto& lesson) { return name_of(lesson) == name; });
  if (found != lessons.end()) return *found;
  std::vector<std::string> names;
  for (const auto& lesson : lessons) names.push_back(name_of(lesson));
  throw UsageError(
      fmt::format("there is no lesson '{}'; there are: {}", name, fmt::join(names, ", ")));
}

std::string program() {
  return fmt::format("tetmend {}", version());
}

std::string page_of(const Lesson& lesson) {
  const TraceFile file(lesson.trace);
  Replay replay(file);
  return explain::write_page(file, replay,
                             {.title = lesson.title,
                              .range = {0, file.event_count()},
                              .lesson = &lesson,
                              .program = program()})
      .html;
}

void put(const std::filesystem::path& file, std::string_view text) {
  OutputFile out(file);
  out.put(text);
  out.commit();
}

std::vector<NamedFile> files_of(const std::vector<std::filesystem::path>& lessons) {
  std::vector<NamedFile> files;
  for (const auto& lesson : lessons) {
    files.push_back({"the lesson", lesson});
    files.push_back({"the trace of the lesson", read_lesson(lesson).trace});
  }
  return files;
}

std::filesystem::path page_name(const std::filesystem::path& lesson) {
  return name_of(lesson) + ".html";
}

void write_all(const LessonOptions& options, const std::vector<std::filesystem::path>& lessons) {
  std::vector<NamedFile> outputs = {{"a page", options.output / "index.html"}};
  for (const auto& lesson : lessons)
    outputs.push_back({"a page", options.output / page_name(lesson)});
  check_distinct(files_of(lessons), outputs, nullptr);
  std::error_code failed;
  std::filesystem::create_directories(options.output, failed);
  std::vector<explain::PageLink> pages;
  for (const auto& path : lessons) {
    const Lesson lesson = read_lesson(path);
    const std::filesystem::path name = page_name(path);
    put(options.output / name, page_of(lesson));
    pages.push_back({name.string(), lesson.title, lesson.steps.front().text});
  }
  put(options.output / "index.html",
      explain::write_index("Lessons", "Recorded runs of tetmend, step by step.", pages, program()));
}

int run_lesson(const LessonOptions& options) {
  const auto lessons = explain::find_lessons();
  if (lessons.empty()) throw Error("there are no lessons: TETMEND_LESSONS may name their folder");
  if (options.name.empty() && !options.html) {
    for (const auto& path : lessons) {
      say(stdout, fmt::format("{:<16} {}\n", name_of(path), read_lesson(path).title));
    }
    return 0;
  }
  if (options.name.empty()) {
    if (options.output.empty()) throw UsageError("--html needs -o, a folder for the pages");
    write_all(options, lessons);
    return 0;
  }
  const std::filesystem::path file = find(options.name, lessons);
  if (!options.output.empty()) {
    const NamedFile output = {"-o", options.output};
    prepare_files(files_of({file}), {&output, 1}, nullptr);
  }
  const Lesson lesson = read_lesson(file);
  std::string text;
  if (options.html) {
    text = page_of(lesson);
  } else {
    text = lesson.title + "\n";
    for (const LessonStep& step : lesson.steps) {
      text += fmt::format("\n{:>4}  {}\n", step.at, step.text);
    }
  }
  if (options.output.empty()) {
    say(stdout, text);
  } else {
    put(options.output, text);
  }
  return 0;
}

}  // namespace

void add_lesson(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<LessonOptions>();
  CLI::App* command =
      app.add_subcommand("lesson", "Recorded runs with a text that leads through them");
  command->add_option("NAME", options->name, "Only this one")->type_name("");
  command->add_flag("--html", options->html, "As a page for a browser; of all lessons, a folder");
  command->add_option("-o,--output", options->output, "File, or folder for the pages of all")
      ->type_name("OUT");
  command->footer(R"(A page holds all that it needs: it opens by a double click, without a network.
tetmend-view opens the same lessons. They lie in share/tetmend/lessons, or where
TETMEND_LESSONS says.

Examples:
  tetmend lesson                                      the list
  tetmend lesson 2-two-shells                         its text
  tetmend lesson 2-two-shells --html -o lesson.html   its page
  tetmend lesson --html -o lessons                    pages of all, with an index

Exit status: 0 success, 1 the work failed, 2 wrong usage)");
  command->callback(
      [options, &invocation] { invocation.action = [options] { return run_lesson(*options); }; });
}

}  // namespace tetmend::apps
