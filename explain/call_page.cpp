// SPDX-License-Identifier: MIT
#include "explain/call_page.h"

#include <fmt/format.h>

#include "explain/figures/call_figure.h"
#include "explain/lesson_maker.h"
#include "explain/page.h"
#include "figure/drawing_file.h"
#include "kernel/error.h"

namespace tetmend::explain {

namespace {

void check_call(const TraceFile& file, std::uint32_t call) {
  if (call < file.calls().size()) return;
  throw Error(fmt::format("there is no call {}; the trace has {}, counted from 0", call,
                          file.calls().size()));
}

}  // namespace

std::string page_of_call(const std::filesystem::path& trace, std::uint32_t call,
                         const std::string& program) {
  const TraceFile file(trace);
  check_call(file, call);
  Replay replay(file);
  const Lesson lesson = propose_lesson(file, replay, call);
  return write_page(file, replay,
                    {.title = lesson.title,
                     .range = range_of_call(file, call),
                     .lesson = &lesson,
                     .program = program})
      .html;
}

std::vector<std::string> drawings_of_call(std::string_view trace, std::uint32_t call) {
  const TraceFile file("the trace", trace);
  check_call(file, call);
  Replay replay(file, 0);
  std::vector<std::string> drawings;
  for (const FigureKind kind : {FigureKind::ring, FigureKind::tree}) {
    try {
      drawings.push_back(figure::svg_of(draw_call(file, replay, {kind, call, {}})));
    } catch (const Error&) {  // it has none of that kind, or too much of it
    }
  }
  return drawings;
}

}  // namespace tetmend::explain
