// SPDX-License-Identifier: MIT
#include "explain/page.h"

#include <array>
#include <regex>

#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/page_parts.h"
#include "explain/page_text.h"
#include "explain/question.h"
#include "explain/stepper.h"
#include "figure/colour.h"
#include "kernel/error.h"

namespace tetmend::explain {

namespace {

Json origin_of(const TraceFile& file, const PageRequest& request) {
  const TraceHeader& header = file.header();
  Json settings = Json::array();
  for (const auto& [name, value] : header.settings) settings.push_back(name + " = " + value);
  return {{"title", request.title},
          {"mesh", header.input},
          {"schedule", header.schedule},
          {"settings", settings},
          {"recorder", header.program},
          {"program", request.program},
          {"damage", file.damage()},
          {"filter", header.filter},
          {"calls", count_calls(file, request.range)}};
}

/// With the answers to its questions, as the trace has them.
Json lesson_json(const TraceFile& file, Replay& replay, const Lesson& lesson) {
  Json steps = Json::array();
  for (const LessonStep& step : lesson.steps) {
    Json focus = Json::array();
    for (const Focus f : step.focus) focus.push_back(kFocusNames[static_cast<std::size_t>(f)]);
    if (focus.empty()) focus.push_back(kFocusNames[static_cast<std::size_t>(Focus::picture)]);
    Json row = {{"at", step.at}, {"text", step.text}, {"focus", focus}};
    if (step.ask) row["ask"] = to_json(answer(file, replay, step.at, *step.ask));
    steps.push_back(std::move(row));
  }
  return {{"title", lesson.title}, {"steps", steps}};
}

/// HTML of a text in which "M_q" is as print has it. Pages do the same to theirs: withIndices().
std::string with_indices(const std::string& text) {
  static const std::regex kName(R"(\b([A-Za-z])_([a-z0-9])\b)");
  constexpr const char* kIndexed = "<span class=\"index\">$1<sub><i>_</i>$2</sub></span>";
  return std::regex_replace(escaped(text), kName, kIndexed);
}

/// To the list of pages, and to those before and after; nothing for a page by itself.
std::string links_of(const PageRequest& request) {
  std::string links;
  const auto add = [&](const std::optional<PageLink>& page, std::string_view id,
                       std::string_view text) {
    if (!page) return;
    links += fmt::format("<a id=\"{}\" href=\"{}\" title=\"{}\">{}</a>\n", id, escaped(page->file),
                         escaped(page->title), text);
  };
  add(request.contents, "to-contents", "Contents");
  add(request.previous, "to-previous", "&#8592;<span> Lesson before</span>");
  add(request.next, "to-next", "<span>Next lesson </span>&#8594;");
  if (links.empty()) return links;
  return fmt::format("<nav class=\"links\" aria-label=\"Lessons\">\n{}</nav>\n", links);
}

/// Variables of the style sheet: parts of a shell look as in windows and figures. The dark page may
/// have some of them lighter.
std::string colours_of_shells() {
  constexpr std::array<std::pair<std::string_view, figure::Colour>, 8> kColours = {
      {{"edge", figure::kSupportingEdgeColour},
       {"visited", figure::kSelectionColour},
       {"skirt", figure::kSkirtColour},
       {"chord", figure::kChordColour},
       {"core", figure::kCoreColour},
       {"cell", figure::kCellColour},
       {"face", figure::kFaceToRemoveColour},
       {"caller", figure::kGhostColour}}};
  std::string style = ":root {";
  for (const auto& [name, c] : kColours) {
    style += fmt::format(" --{}: #{:02x}{:02x}{:02x};", name, c.red, c.green, c.blue);
  }
  return style + " }\n";
}

std::string html_of(const TraceFile& file, Replay& replay, const PageRequest& request,
                    const RecordingRange& range) {
  Json data = record(file, replay, range);
  data["origin"] = origin_of(file, request);
  if (request.lesson != nullptr) data["lesson"] = lesson_json(file, replay, *request.lesson);
  if (range.deepest < depth_of(file, range)) data["deepest"] = range.deepest;
  const std::string about =
      fmt::format("{}: a run of {} on {}, schedule {}, step by step.", request.title,
                  file.header().program, file.header().input, file.header().schedule);
  return fill_in(page_form(), {{"@TITLE@", escaped(request.title)},
                               {"@ABOUT@", escaped(about)},
                               {"@PROGRAM@", escaped(request.program)},
                               {"@LINKS@", links_of(request)},
                               {"@STYLE@", colours_of_shells() + std::string(page_style())},
                               {"@SCRIPT@", std::string(page_script())},
                               {"@RECORDING@", in_script(data)}});
}

}  // namespace

Page write_page(const TraceFile& file, Replay& replay, const PageRequest& request) {
  const unsigned whole = depth_of(file, request.range);
  RecordingRange range = request.range;
  for (unsigned deepest = whole;; --deepest) {
    range.deepest = deepest;
    Page page{html_of(file, replay, request, range), std::nullopt};
    if (deepest < whole) page.deepest = deepest;
    if (page.html.size() <= request.largest) return page;
    const bool is_least = deepest == 0 || deepest < call_stack(file, range.begin).size();
    if (is_least) {
      throw Error(
          fmt::format("'{}' makes a page of {:.1f} MB, and {:.1f} MB is the most: choose a "
                      "call in it",
                      request.title, 1e-6 * static_cast<double>(page.html.size()),
                      1e-6 * static_cast<double>(request.largest)));
    }
  }
}

std::string title_of_call(const TraceFile& file, std::uint32_t call) {
  const Call& c = file.calls()[call];
  return fmt::format("Call {}: {} {}", call, short_name(file, c), format_target(c));
}

std::string write_index(const std::string& title, const std::string& text,
                        const std::vector<PageLink>& pages, const std::string& program) {
  std::string list;
  for (const PageLink& page : pages) {
    list += fmt::format("<li><a href=\"{}\">{}</a><p>{}</p></li>\n", escaped(page.file),
                        with_indices(page.title), with_indices(page.text));
  }
  return fill_in(index_form(), {{"@TITLE@", escaped(title)},
                                {"@ABOUT@", escaped(text)},
                                {"@PROGRAM@", escaped(program)},
                                {"@STYLE@", std::string(page_style())},
                                {"@SCRIPT@", std::string(index_script())},
                                {"@LIST@", list}});
}

}  // namespace tetmend::explain
