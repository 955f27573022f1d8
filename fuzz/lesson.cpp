// SPDX-License-Identifier: MIT
// A lesson of a stranger: an Error of one line, or steps in order and files that lie beside it.
#include "trace/lesson.h"

#include "fuzz/target.h"
#include "kernel/error.h"

using namespace tetmend;
using namespace tetmend::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const RamFolder folder;
  const auto file = folder / "in.json";
  write_file(file, {reinterpret_cast<const char*>(data), size});
  try {
    const Lesson lesson = read_lesson(file);
    require(!lesson.steps.empty(), "a lesson has a step");
    std::uint64_t at = 0;
    for (const LessonStep& step : lesson.steps) {
      require(step.at >= at, "steps never go back");
      at = step.at;
    }
    require(!lesson.trace.empty(), "a lesson has a trace");
    for (const auto& other : {lesson.mesh, lesson.trace}) {
      if (other.empty()) continue;  // a trace has its own mesh
      const auto inside =
          std::filesystem::path(other).lexically_normal().lexically_relative(folder.path());
      require(!inside.empty() && *inside.begin() != "..", "files lie in the folder of the lesson");
    }
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
