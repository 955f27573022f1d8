// SPDX-License-Identifier: MIT
#include "explain/question.h"

#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "explain/call_study.h"
#include "explain/lesson_maker.h"
#include "explain/page.h"
#include "kernel/error.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

const std::filesystem::path kLessons = TETMEND_SOURCE_DIR "/assets/lessons";

struct LessonTrace {
  explicit LessonTrace(const std::string& name) : file(kLessons / (name + ".trace")) {}
  Question ask(std::uint64_t at, Ask::Kind kind, const std::string& of = {}) {
    return answer(file, replay, at, {kind, "?", of});
  }
  double number(std::uint64_t at, const std::string& of) {
    return ask(at, Ask::Kind::number, of).number;
  }
  TraceFile file;
  Replay replay{file};
};

}  // namespace

TEST_CASE("the trace says which line comes next, in a call and in a pass") {
  LessonTrace shells("2-two-shells");
  // Algorithm 4 begins with a test, and goes on to the transformation of its shell.
  const Question line = shells.ask(2, Ask::Kind::line);
  CHECK(line.line == 3);
  CHECK(line.why == "Line 3 of Algorithm 4 comes next: transform the shell of e (Algorithm 3).");
  LessonTrace pass("5-reconnection");
  CHECK(pass.ask(1, Ask::Kind::line).line > 1);
  CHECK_THROWS_WITH_AS(shells.ask(0, Ask::Kind::line), doctest::Contains("no algorithm is at hand"),
                       Error);
}

TEST_CASE("the trace says whether the call at hand, or else the next one, is accepted") {
  LessonTrace core("1-core");
  CHECK_FALSE(core.ask(0, Ask::Kind::accepted).accepted);  // edge removal comes
  CHECK_FALSE(core.ask(2, Ask::Kind::accepted).accepted);
  CHECK(core.ask(6, Ask::Kind::accepted).accepted);   // shell transformation is at hand
  CHECK(core.ask(3, Ask::Kind::accepted).call == 1);  // edge removal has ended
  CHECK_THROWS_WITH_AS(core.ask(10, Ask::Kind::accepted), doctest::Contains("no call is there"),
                       Error);
}

TEST_CASE("the chords of a question are those of the covering that the call makes") {
  LessonTrace core("1-core");
  const Question question = core.ask(6, Ask::Kind::chord);
  const CallStudy study = study_call(core.file, core.replay, 1);
  std::set<std::array<std::uint32_t, 2>> chords;
  for (const auto& t : study.covering->triangles) {
    for (unsigned n = 0; n < 3; ++n) {
      const unsigned i = std::min(t.corners[n], t.corners[(n + 1) % 3]);
      const unsigned j = std::max(t.corners[n], t.corners[(n + 1) % 3]);
      const bool is_side = j == i + 1 || (i == 0 && j == 5);  // of the ring of six
      if (!is_side) chords.insert({study.picture->ring[i].index(), study.picture->ring[j].index()});
    }
  }
  CHECK(chords.size() == 2);
  CHECK(std::set(question.chords.begin(), question.chords.end()) == chords);
  LessonTrace smoothing("6-smoothing");
  CHECK_THROWS_WITH_AS(smoothing.ask(2, Ask::Kind::chord), doctest::Contains("no ring"), Error);
}

TEST_CASE("the numbers of a question are those of the trace") {
  LessonTrace tables("4-tables");
  CHECK(tables.number(0, "triangulations") == 14);
  CHECK(tables.number(2, "degree") == 6);
  CHECK(tables.number(2, "M_k 2 7") == 3);
  CHECK(tables.number(2, "M_q 2 7") == doctest::Approx(1.0971).epsilon(0.0001));
  CHECK(tables.number(2, "worst before") == doctest::Approx(0.0856).epsilon(0.001));
  CHECK(tables.number(2, "tets made") == 8);
  CHECK(tables.number(2, "tets removed") == 6);
  LessonTrace shells("2-two-shells");
  CHECK(shells.number(2, "degree") == 5);
  CHECK(shells.number(2, "calls") == 4);
  CHECK(shells.number(2, "deepest level") == 1);
  CHECK(LessonTrace("5-reconnection").number(0, "bad tets") == 7);
  CHECK(LessonTrace("3-refusals").number(10, "triangulations") == 5);
}

TEST_CASE("an answer in words is right, is not, or is no answer to the question") {
  LessonTrace core("1-core");
  const Question accepted = core.ask(6, Ask::Kind::accepted);
  CHECK(is_right(accepted, "accepted"));
  CHECK_FALSE(is_right(accepted, " refused "));
  CHECK_THROWS_WITH_AS(is_right(accepted, "perhaps"), "expected accepted or refused, not 'perhaps'",
                       Error);
  const Question chord = core.ask(6, Ask::Kind::chord);
  REQUIRE(!chord.chords.empty());
  const auto [from, to] = chord.chords.front();
  CHECK(is_right(chord, fmt::format("{} {}", from, to)));
  CHECK(is_right(chord, fmt::format("{} - {}", to, from)));
  CHECK(is_right(chord, fmt::format("{},{}", to, from)));
  CHECK_FALSE(is_right(chord, fmt::format("{} {}", from, from)));
  for (const char* words : {"", "2", "a b", "2 7 1"}) {
    CHECK_THROWS_AS(is_right(chord, words), Error);
  }
  LessonTrace shells("2-two-shells");
  const Question line = shells.ask(2, Ask::Kind::line);
  CHECK(is_right(line, "3"));
  CHECK_FALSE(is_right(line, "4"));
  CHECK_THROWS_AS(is_right(line, "3rd"), Error);
  Question number = core.ask(6, Ask::Kind::number, "worst before");
  number.ask.within = 0.001;
  CHECK(is_right(number, fmt::format("{}", number.number + 0.0009)));
  CHECK_FALSE(is_right(number, fmt::format("{}", number.number + 0.0011)));
  number.number = 0.5;
  CHECK(is_right(number, "0,5"));
  CHECK_THROWS_AS(is_right(number, "half"), Error);
}

TEST_CASE("a number that the trace does not have is an error with the question and the reason") {
  LessonTrace shells("2-two-shells");
  for (const char* of : {"", "sheep", "M_q", "M_q 2", "M_q 2 3 4", "M_q 0 2", "M_k 2 2"}) {
    CAPTURE(of);
    CHECK_THROWS_WITH_AS(shells.number(4, of), doctest::Contains("does not answer '?' at 4"),
                         Error);
  }
  CHECK_THROWS_WITH_AS(shells.number(2, "degree after"), doctest::Contains("not there"), Error);
  CHECK_THROWS_WITH_AS(LessonTrace("3-refusals").number(2, "tets made"),
                       doctest::Contains("changes nothing"), Error);
  CHECK_THROWS_WITH_AS(shells.number(99, "bad tets"), doctest::Contains("ends before"), Error);
  CHECK_FALSE(try_answer(shells.file, shells.replay, 4, {Ask::Kind::number, "?", "sheep"}));
}

TEST_CASE("a page holds the answers to its questions, and there is none without them") {
  const Lesson lesson = read_lesson(kLessons / "4-tables.json");
  LessonTrace tables("4-tables");
  PageRequest request{
      .title = "T", .range = {0, tables.file.event_count()}, .lesson = &lesson, .program = "test"};
  const std::string html = write_page(tables.file, tables.replay, request).html;
  CHECK(html.find(R"("answer":14.0)") != std::string::npos);
  Lesson wrong = lesson;
  wrong.steps.front().ask = Ask{Ask::Kind::line, "Which line?"};
  request.lesson = &wrong;
  CHECK_THROWS_WITH_AS(write_page(tables.file, tables.replay, request),
                       doctest::Contains("Which line?"), Error);
}

TEST_CASE("a lesson is proposed for any call of a run, with three questions that have answers") {
  const test::TracedBall ball;
  const TraceFile file(ball.path());
  Replay replay(file);
  std::set<std::string_view> kinds;
  const auto every = static_cast<std::uint32_t>(file.calls().size() / 25 + 1);
  unsigned transformed = 0;
  for (std::uint32_t call = 0; call < file.calls().size(); ++call) {
    const Call& c = file.calls()[call];
    const bool is_changed = c.accepted() && c.algorithm == Algorithm::shell_transformation;
    const bool is_wanted =
        is_changed && study_call(file, replay, call).covering->core.size() < 4 && transformed < 3;
    if (is_wanted) ++transformed;
    if (call % every != 0 && !is_wanted) continue;
    CAPTURE(call);
    const Lesson lesson = propose_lesson(file, replay, call);
    CHECK(lesson.call == call);
    CHECK(lesson.steps.size() >= 4);
    CHECK(lesson.steps.size() <= 12);
    std::size_t questions = 0;
    std::uint64_t last = file.calls()[call].events.begin + 1;
    for (const LessonStep& step : lesson.steps) {
      CHECK(step.at >= last);
      CHECK(!step.text.empty());
      last = step.at;
      if (!step.ask) continue;
      ++questions;
      kinds.insert(Ask::kKindNames[static_cast<std::size_t>(step.ask->kind)]);
      CHECK_NOTHROW(answer(file, replay, step.at, *step.ask));
      if (step.ask->kind == Ask::Kind::chord) {  // else its ring would say that none is better
        CHECK(study_call(file, replay, call).covering);
      }
    }
    CHECK(last == file.calls()[call].events.end);
    CHECK(questions == kProposedQuestions);
  }
  CHECK(transformed == 3);
  CHECK(kinds.size() == Ask::kKindNames.size());
  CHECK(replay.position() == 0);
}

TEST_CASE("a proposed lesson that is written and read again is the same") {
  const test::TracedBall ball;
  const TraceFile file(ball.path());
  Replay replay(file);
  const Lesson lesson = propose_lesson(file, replay, 3, "A title");
  test::write_text(ball.folder / "ball.json", lesson_text(lesson, ball.folder / "."));
  const Lesson again = read_lesson(ball.folder / "ball.json");
  CHECK(again.title == "A title");
  CHECK(again.call == 3);
  CHECK(again.trace.filename() == "ball.trace");
  REQUIRE(again.steps.size() == lesson.steps.size());
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) {
    CHECK(again.steps[i].at == lesson.steps[i].at);
    CHECK(again.steps[i].text == lesson.steps[i].text);
    CHECK(again.steps[i].focus == lesson.steps[i].focus);
    CHECK(again.steps[i].ask.has_value() == lesson.steps[i].ask.has_value());
  }
}
