// SPDX-License-Identifier: MIT
#include "trace/lesson.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::string with_steps(const std::string& steps) {
  return R"({"title": "a", "mesh": "m.mesh", "trace": "t.trace", "steps": )" + steps + "}";
}

}  // namespace

TEST_CASE("a lesson names its files from its own folder, and has its steps in order") {
  const TempFolder folder;
  write_text(folder / "a.json",
             with_steps(R"([{"at": 0, "text": "one"}, {"at": 7, "text": "two"}])"));
  const Lesson lesson = read_lesson(folder / "a.json");
  CHECK(lesson.title == "a");
  CHECK(lesson.mesh == folder / "m.mesh");
  CHECK(lesson.trace == folder / "t.trace");
  REQUIRE(lesson.steps.size() == 2);
  CHECK(lesson.steps[1].at == 7);
  CHECK(lesson.steps[1].text == "two");
}

TEST_CASE("what is no lesson is refused with the name of the file and the reason") {
  const TempFolder folder;
  const auto complaint = [&](const std::string& text) -> std::string {
    write_text(folder / "a.json", text);
    try {
      read_lesson(folder / "a.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(complaint("no JSON").find("a.json: is no lesson: ") != std::string::npos);
  CHECK(complaint("{}").find("'title'") != std::string::npos);
  CHECK(complaint(with_steps("[]")).find("has no steps") != std::string::npos);
  CHECK(complaint(with_steps(R"([{"at": 2, "text": ""}, {"at": 1, "text": ""}])"))
            .find("a step goes back") != std::string::npos);
  CHECK(complaint(with_steps(R"([{"at": -1, "text": ""}])")).find("no number of events") !=
        std::string::npos);
  CHECK_THROWS_WITH_AS(read_lesson(folder / "none.json"), doctest::Contains("No such file"), Error);
}

TEST_CASE("a lesson of a stranger names no file of others, and its message is short") {
  const TempFolder folder;
  const auto complaint = [&](const std::string& text) -> std::string {
    write_text(folder / "a.json", text);
    try {
      read_lesson(folder / "a.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const std::string steps = R"(, "steps": [{"at": 0, "text": ""}]})";
  for (const char* name : {"/etc/passwd", "../b.trace", "b/../../c.trace", ""}) {
    CAPTURE(name);
    const std::string text = R"({"title": "a", "mesh": "m.mesh", "trace": ")";
    CHECK(complaint(text + name + '"' + steps).find("'trace' leads out of its folder") !=
          std::string::npos);
  }
  const std::string inner = R"({"title": "a", "mesh": "b/m.mesh", "trace": "..b.trace")";
  CHECK(complaint(inner + steps).empty());
  for (const std::string& text :
       {std::string(1'000'000, '['), std::string(1'000'000, 'x'), '"' + std::string(1'000'000, 'x'),
        std::string(500'000, '[') + std::string(500'000, ']')}) {
    const std::string message = complaint(text);
    CHECK(message.find("a.json: is no lesson: ") != std::string::npos);
    CHECK(message.size() < 500);
  }
}

TEST_CASE(
    "steps name what they speak of and ask questions; what there is none of is refused by name") {
  const TempFolder folder;
  const auto read = [&](const std::string& step) {
    write_text(folder / "a.json", with_steps(R"([{"at": 1, "text": "t", )" + step + "}]"));
    return read_lesson(folder / "a.json").steps.front();
  };
  const LessonStep step = read(
      R"("focus": ["ring", "tables"], "ask": {"kind": "number", "text": "How many?", "of": "degree", "within": 0.5})");
  CHECK(step.focus == std::vector{Focus::ring, Focus::tables});
  REQUIRE(step.ask);
  CHECK(step.ask->kind == Ask::Kind::number);
  CHECK(step.ask->of == "degree");
  CHECK(step.ask->within == 0.5);
  const auto complaint = [&](const std::string& text) -> std::string {
    try {
      read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(complaint(R"("focus": ["sheep"])").find("there is no focus 'sheep'") != std::string::npos);
  CHECK(complaint(R"("ask": {"kind": "sheep", "text": ""})").find("no kind of question 'sheep'") !=
        std::string::npos);
  CHECK(complaint(R"("ask": {"kind": "line"})").find("'text'") != std::string::npos);
  CHECK(complaint(R"("ask": {"kind": "number", "text": ""})").find("'of'") != std::string::npos);
  CHECK(complaint(R"("ask": {"kind": "number", "text": "", "of": "degree", "within": -1})")
            .find("'within' is below 0") != std::string::npos);
}

TEST_CASE("a lesson may be about one call, and without its mesh") {
  const TempFolder folder;
  const std::string rest = R"(, "steps": [{"at": 0, "text": ""}]})";
  write_text(folder / "a.json", R"({"title": "a", "trace": "t.trace", "call": 17)" + rest);
  CHECK(read_lesson(folder / "a.json").call == 17);
  CHECK(read_lesson(folder / "a.json").mesh.empty());
  for (const char* call : {"-1", "1.5", "\"x\"", "4294967295", "99999999999999999999"}) {
    CAPTURE(call);
    write_text(folder / "a.json",
               R"({"title": "a", "trace": "t.trace", "call": )" + std::string(call) + rest);
    CHECK_THROWS_WITH_AS(read_lesson(folder / "a.json"), doctest::Contains("no number of a call"),
                         Error);
  }
}

TEST_CASE("the lessons of a folder come by the number that they begin with") {
  const TempFolder folder;
  for (const char* name : {"10-b.json", "2-a.json", "x.json", "1-c.json"}) {
    write_text(folder / name, "");
  }
  std::vector<std::string> names;
  for (const auto& lesson : list_lessons(folder / "")) names.push_back(lesson.filename().string());
  CHECK(names == std::vector<std::string>{"1-c.json", "2-a.json", "10-b.json", "x.json"});
}

TEST_CASE("the lessons of a folder are its JSON files, by name") {
  const TempFolder folder;
  for (const char* name : {"b.json", "a.json", "a.trace"}) write_text(folder / name, "");
  const auto lessons = list_lessons(folder / "");
  REQUIRE(lessons.size() == 2);
  CHECK(lessons[0].filename() == "a.json");
  CHECK(lessons[1].filename() == "b.json");
  CHECK(list_lessons(folder / "none").empty());
}
