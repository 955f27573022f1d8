// SPDX-License-Identifier: MIT
#include "explain/lesson_guide.h"

#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::explain;
using test::TempFolder;

namespace {

void write_lesson(const TempFolder& folder, const std::string& name) {
  std::ofstream(folder / name) << R"({"title": "T", "mesh": "a.mesh", "trace": "a.trace",
      "steps": [{"at": 3, "text": "three"}, {"at": 8, "text": "eight"}]})";
}

}  // namespace

TEST_CASE("the lesson beside a trace has a step from its event on to the next") {
  const TempFolder folder;
  write_lesson(folder, "a.json");
  const auto lesson = lesson_of(folder / "a.trace", 10);
  REQUIRE(lesson);
  CHECK(step_at(*lesson, 2) == std::nullopt);
  CHECK(step_at(*lesson, 3) == 0);
  CHECK(step_at(*lesson, 7) == 0);
  CHECK(step_at(*lesson, 10) == 1);
  CHECK_FALSE(lesson_of(folder / "b.trace", 10));
}

TEST_CASE("a lesson that goes beyond its trace is an error that names the file") {
  const TempFolder folder;
  write_lesson(folder, "a.json");
  CHECK_THROWS_WITH_AS(lesson_of(folder / "a.trace", 7), doctest::Contains("a.json"), Error);
}

TEST_CASE("lessons are found in the folder that is named") {
  const TempFolder folder;
  write_lesson(folder, "b.json");
  write_lesson(folder, "a.json");
  ::setenv("TETMEND_LESSONS", (folder / ".").c_str(), 1);
  const auto found = find_lessons();
  ::unsetenv("TETMEND_LESSONS");
  REQUIRE(found.size() == 2);
  CHECK(found[0].filename() == "a.json");
}
