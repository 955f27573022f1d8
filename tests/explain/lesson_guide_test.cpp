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

TEST_CASE("JSON beside a trace that is no lesson is none") {
  const TempFolder folder;
  for (const char* text : {"", "text", "[1, 2]", "3", "{}", R"({"title": "T"})", R"({"steps": []})",
                           R"({"schema": 1, "input": "a.mesh", "passes": []})"}) {
    CAPTURE(text);
    test::write_text(folder / "a.json", text);
    CHECK_FALSE(lesson_beside(folder / "a.trace"));
    CHECK_FALSE(lesson_of(folder / "a.trace", 10));
  }
  std::filesystem::remove(folder / "a.json");
  std::filesystem::create_directory(folder / "a.json");
  CHECK_FALSE(lesson_of(folder / "a.trace", 10));
}

TEST_CASE("a lesson beside a trace that has a mistake is an error without the words of a library") {
  const TempFolder folder;
  test::write_text(folder / "a.json",
                   R"({"title": 3, "mesh": "a.mesh", "trace": "a.trace", "steps": []})");
  CHECK(lesson_beside(folder / "a.trace") == folder / "a.json");
  std::string complaint;
  try {
    lesson_of(folder / "a.trace", 10);
  } catch (const Error& error) {
    complaint = error.what();
  }
  CHECK(complaint.find("a.json: is no lesson: ") != std::string::npos);
  CHECK(complaint.find("json.exception") == std::string::npos);
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
