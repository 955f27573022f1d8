// SPDX-License-Identifier: MIT
#include "explain/call_page.h"

#include <fmt/format.h>

#include "explain/lesson_maker.h"
#include "explain/page.h"
#include "kernel/error.h"

namespace tetmend::explain {

std::string page_of_call(const std::filesystem::path& trace, std::uint32_t call,
                         const std::string& program) {
  const TraceFile file(trace);
  if (call >= file.calls().size()) {
    throw Error(fmt::format("there is no call {}; the trace has {}, counted from 0", call,
                            file.calls().size()));
  }
  Replay replay(file);
  const Lesson lesson = propose_lesson(file, replay, call);
  return write_page(file, replay,
                    {.title = lesson.title,
                     .range = range_of_call(file, call),
                     .lesson = &lesson,
                     .program = program})
      .html;
}

}  // namespace tetmend::explain
