// SPDX-License-Identifier: MIT
// tetmend lesson: recorded runs with a text that leads through them, read here or in a browser.

#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/catalogue.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/standard_streams.h"
#include "explain/lesson_guide.h"
#include "explain/lesson_maker.h"
#include "explain/page.h"
#include "kernel/formats/output_file.h"
#include "kernel/printable.h"

namespace tetmend::apps {
namespace {

struct LessonOptions {
  std::string name;
  std::filesystem::path output;
  bool html = false;
  std::filesystem::path trace;  ///< to make a lesson of; empty: none
  std::optional<std::uint32_t> call;
  std::string title;
};

std::string lesson_name(const std::filesystem::path& lesson) {
  return lesson.stem().string();
}

/// One of those that there are, or a file.
std::filesystem::path find(const std::string& name,
                           const std::vector<std::filesystem::path>& lessons) {
  if (std::filesystem::path(name).extension() == ".json") return name;
  const auto found = std::find_if(lessons.begin(), lessons.end(),
                                  [&](const auto& lesson) { return lesson_name(lesson) == name; });
  if (found != lessons.end()) return *found;
  std::vector<std::string> names;
  for (const auto& lesson : lessons) names.push_back(lesson_name(lesson));
  throw UsageError(
      fmt::format("there is no lesson '{}'; there are: {}", name, fmt::join(names, ", ")));
}

std::string program() {
  return fmt::format("tetmend {}", version());
}

/// Pages before and after it, and the list of all: nothing for a page by itself.
struct Neighbours {
  std::optional<explain::PageLink> contents = {}, previous = {}, next = {};
};

std::string page_of(const Lesson& lesson, const Neighbours& neighbours = {}) {
  const TraceFile file(lesson.trace);
  if (lesson.steps.back().at > file.event_count() ||
      (lesson.call && *lesson.call >= file.calls().size())) {
    throw Error(fmt::format("{}: the lesson goes beyond the end of its trace",
                            printable(lesson.trace.string())));
  }
  Replay replay(file);
  return explain::write_page(file, replay,
                             {.title = lesson.title,
                              .range = lesson.call ? explain::range_of_call(file, *lesson.call)
                                                   : explain::RecordingRange{0, file.event_count()},
                              .lesson = &lesson,
                              .program = program(),
                              .contents = neighbours.contents,
                              .previous = neighbours.previous,
                              .next = neighbours.next})
      .html;
}

void write_file(const std::filesystem::path& file, std::string_view text) {
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
  return lesson_name(lesson) + ".html";
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
    pages.push_back({page_name(path).string(), lesson.title, lesson.steps.front().text});
  }
  const std::string title = fmt::format("A lecture in {} pages", pages.size());
  for (std::size_t n = 0; n < lessons.size(); ++n) {
    Neighbours around{.contents = explain::PageLink{"index.html", title, ""}};
    if (n > 0) around.previous = pages[n - 1];
    if (n + 1 < pages.size()) around.next = pages[n + 1];
    write_file(options.output / page_name(lessons[n]), page_of(read_lesson(lessons[n]), around));
  }
  write_file(options.output / "index.html",
             explain::write_index(title, "Recorded runs of tetmend, step by step, with questions.",
                                  pages, program()));
}

void check_making(const LessonOptions& options) {
  if (options.trace.empty()) {
    if (options.call) throw UsageError("--call is for --make");
    if (!options.title.empty()) throw UsageError("--title is for --make");
    return;
  }
  if (!options.call) throw UsageError("--make needs --call, the call to tell of");
  if (options.output.extension() != ".json") throw UsageError("--make needs -o, a .json file");
  if (!options.name.empty() || options.html) {
    throw UsageError("--make writes a new lesson: without NAME and --html");
  }
}

std::filesystem::path where(const std::filesystem::path& file) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file));
}

/// A lesson names its trace from its own folder.
void make_lesson(const LessonOptions& options) {
  const NamedFile output = {"-o", options.output};
  const std::vector<NamedFile> inputs = {{"the trace", options.trace}};
  prepare_files(inputs, {&output, 1}, nullptr);
  const TraceFile file(options.trace);
  if (!file.damage().empty()) complain(kSuccess, "warning: " + file.damage());
  if (*options.call >= file.calls().size()) {
    throw Error(
        fmt::format("there is no call {}: the trace has {}", *options.call, file.calls().size()));
  }
  Replay replay(file);
  Lesson lesson = explain::propose_lesson(file, replay, *options.call, options.title);
  lesson.trace = where(options.trace);
  const auto folder = where(options.output).parent_path();
  const auto beside = lesson.trace.lexically_relative(folder);
  if (beside.empty() || *beside.begin() == "..") {
    throw Error(fmt::format("a lesson lies beside its trace, or above: -o {} does not",
                            printable(options.output.string())));
  }
  write_file(options.output, lesson_text(lesson, folder));
}

int run_lesson(const LessonOptions& options) {
  check_making(options);
  if (!options.trace.empty()) {
    make_lesson(options);
    return 0;
  }
  const auto lessons = explain::find_lessons();
  if (lessons.empty()) throw Error("there are no lessons: TETMEND_LESSONS may name their folder");
  if (options.name.empty() && !options.html) {
    for (const auto& path : lessons) {
      say(stdout, fmt::format("{:<16} {}\n", lesson_name(path), read_lesson(path).title));
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
      if (step.ask) text += fmt::format("      {}\n", step.ask->text);
    }
  }
  if (options.output.empty()) {
    say(stdout, text);
  } else {
    write_file(options.output, text);
  }
  return 0;
}

}  // namespace

void add_lesson(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<LessonOptions>();
  CLI::App* command =
      app.add_subcommand("lesson", "Recorded runs with a text that leads through them");
  command->add_option("NAME", options->name, "Only this one; or a file of your own, .json")
      ->type_name("");
  command->add_flag("--html", options->html, "As a page for a browser; of all lessons, a folder");
  command->add_option("-o,--output", options->output, "File, or folder for the pages of all")
      ->type_name("OUT");
  command
      ->add_option("--make", options->trace,
                   "Proposes a lesson on a call of a run: steps and\nthree questions, -o NAME.json")
      ->type_name("TRACE");
  command->add_option("--call", options->call, "The call of --make")->type_name("CALL");
  command->add_option("--title", options->title, "Of --make")->type_name("TEXT");
  command->footer(R"(A page holds all that it needs: it opens by a double click, without a network.
tetmend-view opens the same lessons. They lie in share/tetmend/lessons, or where
TETMEND_LESSONS says.

Examples:
  tetmend lesson                                      the list
  tetmend lesson 2-two-shells                         its text
  tetmend lesson 2-two-shells --html -o lesson.html   its page
  tetmend lesson --html -o lessons                    pages of all, with an index
  tetmend lesson --make run.trace --call 17 -o run.json
  tetmend lesson run.json --html -o run.html

Exit status: 0 success, 1 the work failed, 2 wrong usage)");
  command->callback(
      [options, &invocation] { invocation.action = [options] { return run_lesson(*options); }; });
}

}  // namespace tetmend::apps
