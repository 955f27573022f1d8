// SPDX-License-Identifier: MIT
#include "explain/page.h"

#include <regex>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "explain/call_study.h"
#include "explain/event_text.h"
#include "explain/paper_lines.h"
#include "explain/stepper.h"
#include "kernel/error.h"
#include "tests/support/example_traces.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::explain;
using namespace tetmend::test;
using nlohmann::json;

namespace {

json recording_of(const std::string& html) {
  const std::string begin = R"(<script type="application/json" id="recording">)";
  const std::size_t from = html.find(begin);
  REQUIRE(from != std::string::npos);
  const std::size_t to = html.find("</script>", from);
  return json::parse(html.substr(from + begin.size(), to - from - begin.size()));
}

/// The largest call of a run, and its page.
struct LargestCall {
  LargestCall() {
    for (std::uint32_t k = 0; k < file.calls().size(); ++k) {
      const auto size = [&](std::uint32_t c) { return file.calls()[c].subtree_end - c; };
      if (size(k) > size(call)) call = k;
    }
  }
  PageRequest request() const {
    return {.title = title_of_call(file, call),
            .range = range_of_call(file, call),
            .program = "tetmend test",
            .largest = 10'000'000};
  }
  test::TracedBall trace;
  TraceFile file{trace.path()};
  Replay replay{file};
  std::uint32_t call = 0;
};

}  // namespace

TEST_CASE("each step of a page says what happened, where the algorithm is and where steps lead") {
  LargestCall largest;
  const TraceFile& file = largest.file;
  const Page page = write_page(file, largest.replay, largest.request());
  CHECK(!page.deepest);
  CHECK(largest.replay.position() == 0);
  const json recording = recording_of(page.html);
  const EventRange range = file.calls()[largest.call].events;
  REQUIRE(recording["steps"].size() == range.end - range.begin);
  CHECK(recording["steps"][0][1] == fmt::format("call {} begins", largest.call));
  std::uint64_t position = range.begin + 1;
  for (const json& step : recording["steps"]) {
    CHECK(step[0] == position);
    CHECK(step[1] == event_text(file, position));
    const auto stack = call_stack(file, position);
    CHECK(step[2] == (stack.empty() ? json() : json(stack.back())));
    for (std::size_t i = 0; i < stack.size(); ++i) {
      CHECK(step[3][i] == code_place(file, stack, i, position).line);
    }
    const std::uint64_t over = step_from(file, position, Step::over, Direction::forward);
    CHECK(step[5][0] == std::min(over, range.end));
    ++position;
  }
}

TEST_CASE("the tets that come and go on a page are those of the mesh") {
  LargestCall largest;
  const TraceFile& file = largest.file;
  const json recording = recording_of(write_page(file, largest.replay, largest.request()).html);
  std::set<std::uint32_t> live = recording["start"].get<std::set<std::uint32_t>>();
  for (const json& step : recording["steps"]) {
    for (const json& tet : step[6]) CHECK(live.erase(tet.get<std::uint32_t>()) == 1);
    for (const json& tet : step[7]) CHECK(live.insert(tet.get<std::uint32_t>()).second);
    largest.replay.seek(step[0].get<std::uint64_t>());
    const SlotMesh& mesh = largest.replay.mesh();
    std::multiset<std::multiset<std::uint32_t>> there;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i))) continue;
      std::multiset<std::uint32_t> tet;
      for (const VertexHandle v : mesh.vertices(TetHandle(i))) tet.insert(v.index());
      there.insert(tet);
    }
    std::multiset<std::multiset<std::uint32_t>> shown;
    for (const std::uint32_t tet : live) {
      std::multiset<std::uint32_t> corners;
      for (unsigned i = 0; i < 4; ++i) {
        corners.insert(recording["points"][recording["tets"][tet][i].get<std::size_t>()][0]
                           .get<std::uint32_t>());
      }
      shown.insert(corners);
    }
    CHECK(shown == there);  // the mesh is small enough to be shown whole
  }
}

TEST_CASE("the reason of each call is the one that the debugger tells") {
  LargestCall largest;
  const TraceFile& file = largest.file;
  const json recording = recording_of(write_page(file, largest.replay, largest.request()).html);
  for (std::uint32_t k = largest.call; k < file.calls()[largest.call].subtree_end; ++k) {
    const json& call = recording["calls"].at(std::to_string(k));
    const CallStudy study = study_call(file, largest.replay, k);
    CHECK(call["reason"] == explain_end(file, study));
    CHECK(call.contains("shell") == (study.picture && study.picture->ring.size() >= 3));
    CHECK(call["before"].size() == study.before.size());
    CHECK(call["after"].size() == study.after.size());
  }
}

TEST_CASE("a page that would be too large leaves the deepest calls out, then gives up") {
  LargestCall largest;
  PageRequest request = largest.request();
  const Page whole = write_page(largest.file, largest.replay, request);
  request.largest = whole.html.size() - 1;
  const Page less = write_page(largest.file, largest.replay, request);
  REQUIRE(less.deepest);
  CHECK(less.html.size() < whole.html.size());
  const json recording = recording_of(less.html);
  CHECK(recording["deepest"] == *less.deepest);
  // What the calls left out did to the mesh is not lost.
  const auto end_of = [](const json& all) {
    std::set<std::uint32_t> live = all["start"].get<std::set<std::uint32_t>>();
    for (const json& step : all["steps"]) {
      for (const json& tet : step[6]) live.erase(tet.get<std::uint32_t>());
      for (const json& tet : step[7]) live.insert(tet.get<std::uint32_t>());
    }
    return live.size();
  };
  CHECK(end_of(recording) == end_of(recording_of(whole.html)));
  request.largest = 1000;
  CHECK_THROWS_WITH_AS(write_page(largest.file, largest.replay, request),
                       doctest::Contains("choose a call"), Error);
}

TEST_CASE("names of a trace are texts on its page, whatever they say") {
  const test::TempFolder folder;
  const std::string bad =
      "</script><script>alert('x')</script><img src=x onerror=alert(1)>&\"\xff@DATA@";
  const TetMesh mesh(test::shell_mesh({.degree = 5}));
  {
    TraceRecorder recorder(folder / "a.trace", mesh,
                           {.program = bad,
                            .input = bad,
                            .schedule = bad,
                            .schedule_text = "",
                            .settings = {{bad, bad}},
                            .filter = bad});
    const std::array edge = {VertexHandle(0), VertexHandle(1)};
    recorder.pass_begins(bad, 1);
    recorder.attempt_begins({bad, edge, 0, bad});
    recorder.attempt_ends(Verdict::no_improvement, {}, {});
    recorder.pass_ends({});
    recorder.finish();
  }
  const TraceFile file(folder / "a.trace");
  Replay replay(file);
  const Lesson lesson{bad, {}, {}, {{0, bad}}};
  const Page page = write_page(
      file, replay,
      {.title = bad, .range = {0, file.event_count()}, .lesson = &lesson, .program = bad});
  CHECK(count_of(page.html, "<script") == 2);  // the recording and the script
  CHECK(count_of(page.html, "</script>") == 2);
  CHECK(count_of(page.html, "<img") == 0);
  CHECK(count_of(page.html, "\xff") == 0);
  const json recording = recording_of(page.html);
  CHECK(recording["lesson"]["steps"][0]["text"].get<std::string>().starts_with("</script>"));
  CHECK(recording["origin"]["mesh"].get<std::string>().starts_with("</script>"));
  const std::string index = write_index(bad, bad, {{bad, bad, bad}}, bad);
  CHECK(count_of(index, "<script") == 1);  // light and dark
  CHECK(count_of(index, "<img") == 0);
}

TEST_CASE("a page asks nobody for anything") {
  LargestCall largest;
  const Page page = write_page(largest.file, largest.replay, largest.request());
  CHECK(page.html.find("default-src 'none'") != std::string::npos);
  const std::regex load(R"((src|href)\s*=|url\(|@import|fetch\(|XMLHttpRequest|import\()");
  CHECK(!std::regex_search(page.html, load));
}
