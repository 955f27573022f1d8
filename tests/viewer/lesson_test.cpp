// SPDX-License-Identifier: MIT
#include "viewer/lesson.h"

#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TempFolder;

namespace {

std::filesystem::path write(const TempFolder& folder, const std::string& text) {
  std::ofstream(folder / "first.json") << text;
  return folder / "first.trace";
}

}  // namespace

TEST_CASE("a lesson has a step from its event on to the next") {
  const TempFolder folder;
  const auto trace = write(folder, R"({"title": "T", "steps": [{"event": 3, "text": "three"},
                                       {"event": 8, "text": "eight"}]})");
  const auto lesson = read_lesson(trace, 10);
  REQUIRE(lesson);
  CHECK(lesson->title == "T");
  CHECK(lesson->step_at(2) == std::nullopt);
  CHECK(lesson->step_at(3) == 0);
  CHECK(lesson->step_at(7) == 0);
  CHECK(lesson->step_at(10) == 1);
}

TEST_CASE("a trace without a lesson is none, and a damaged lesson names its file") {
  const TempFolder folder;
  CHECK_FALSE(read_lesson(folder / "other.trace", 10));
  for (const char* text : {"{", R"({"title": "T"})", R"({"title": "T", "steps": [{"event": 3}]})",
                           R"({"title": "T", "steps": [{"event": 30, "text": ""}]})"}) {
    CHECK_THROWS_WITH_AS(read_lesson(write(folder, text), 10), doctest::Contains("first.json"),
                         Error);
  }
}

TEST_CASE("traces with a lesson beside them are listed") {
  const TempFolder folder;
  for (const char* name : {"b.trace", "b.json", "a.trace", "a.json", "alone.trace"}) {
    std::ofstream(folder / name) << "{}";
  }
  ::setenv("TETMEND_LESSONS", (folder / ".").c_str(), 1);
  const auto found = list_lessons();
  ::unsetenv("TETMEND_LESSONS");
  REQUIRE(found.size() == 2);
  CHECK(found[0].filename() == "a.trace");
  CHECK(found[1].filename() == "b.trace");
}
