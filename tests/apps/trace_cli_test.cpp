// SPDX-License-Identifier: MIT
// Traces from the command line: recording, filters, exports, damaged files.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/formats/mesh_io.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/text.h"
#include "trace/call_tree.h"
#include "trace/lesson.h"
#include "trace/trace_file.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

struct TraceBench {
  TempFolder folder;
  std::string out = (folder / "out.mesh").string();
  std::string trace = (folder / "run.trace").string();

  Outcome improve(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"improve", asset("sheet.mesh"), "-o", out, "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  Outcome record(std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--trace", trace});
    return improve(more);
  }
  Outcome look(std::vector<std::string> more) {
    more.insert(more.begin(), {"trace", trace});
    return run_program(more);
  }
};

}  // namespace

TEST_CASE("a run that is recorded writes the same mesh, and its trace has a summary") {
  TraceBench bench;
  REQUIRE(bench.improve().status == 0);
  const std::string plain = read_text(bench.out);
  REQUIRE(bench.record({"--threads", "2"}).status == 0);
  CHECK(read_text(bench.out) == plain);
  CHECK(bench.folder.entries() == 2);
  const Outcome summary = bench.look({});
  CHECK(summary.status == 0);
  CHECK(summary.err.empty());
  const TraceFile file(bench.trace);
  CHECK(contains(summary.out, fmt::format("{} events in ", file.event_count())));
  CHECK(contains(summary.out, fmt::format("{} calls, ", file.calls().size())));
  CHECK(contains(summary.out, "recursive_shell_transformation"));
}

TEST_CASE("filters make the trace smaller and leave the mesh as it was") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const std::string mesh = read_text(bench.out);
  const std::size_t calls = TraceFile(bench.trace).calls().size();
  const std::vector<std::vector<std::string>> filters = {
      {"--trace-around", "17"}, {"--trace-around", "17,0.2"}, {"--trace-operator", "smoothing"},
      {"--trace-depth", "1"},   {"--trace-limit", "100K"},    {"--trace-around", "0,0,0,0.5"}};
  for (const auto& filter : filters) {
    CAPTURE(filter[0]);
    CAPTURE(filter[1]);
    REQUIRE(bench.record(filter).status == 0);
    CHECK(read_text(bench.out) == mesh);
    const TraceFile file(bench.trace);
    CHECK(file.calls().size() < calls);
    CHECK(!file.header().filter.empty());
  }
}

TEST_CASE("mistakes in the options of a trace are wrong usage, before any work") {
  TraceBench bench;
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--trace-around", "x"}, "--trace-around: 'x' is not a number"},
      {{"--trace-around", "1,2,3"}, "'1,2,3' is not of the form TET, TET,RADIUS or X,Y,Z,RADIUS"},
      {{"--trace-around", "1,-2"}, "the radius -2 is not positive"},
      {{"--trace-operator", "flip"}, "unknown operator 'flip'; valid: "},
      {{"--trace-depth", "-1"}, "--trace-depth"},
      {{"--trace-limit", "5X"}, "'5X' is not a size such as 500M"}};
  for (const auto& mistake : wrong) {
    CAPTURE(mistake.second);
    const Outcome outcome = bench.record(mistake.first);
    CHECK(outcome.status == 2);
    CHECK_MESSAGE(contains(outcome.err, mistake.second), outcome.err);
  }
  CHECK(bench.improve({"--trace-depth", "1"}).status == 2);
  CHECK(bench.folder.entries() == 0);
  const Outcome outcome = bench.record({"--trace-around", "3327"});
  CHECK(outcome.status == 1);
  CHECK(contains(outcome.err, "there is no tet 3327; the mesh has 3327, counted from 0"));
}

TEST_CASE("a call is shown as a tree, as a graph and as slices") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const TraceFile file(bench.trace);
  const auto calls_below = [&](std::uint32_t i) { return file.calls()[i].subtree_end - i; };
  std::uint32_t call = 0;
  for (std::uint32_t i = 1; i < file.calls().size(); ++i) {
    if (calls_below(i) > calls_below(call)) call = i;
  }
  REQUIRE(calls_below(call) >= 5);
  const std::string number = std::to_string(call);
  CHECK(bench.look({"--tree", number}).out == call_tree_text(file, call));
  CHECK(bench.look({"--dot", number}).out == call_tree_dot(file, call));
  const std::string slices = (bench.folder / "slices.json").string();
  REQUIRE(bench.look({"--slices", "-o", slices}).status == 0);
  const auto json = nlohmann::json::parse(read_text(slices));
  CHECK(json["traceEvents"].size() ==
        file.passes().size() + file.visits().size() + file.calls().size());
  const Outcome none = bench.look({"--tree", "99999999"});
  CHECK(none.status == 1);
  CHECK(contains(none.err, "there is no call 99999999"));
}

TEST_CASE("a ledger counts each call once, as text and as JSON") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const TraceFile file(bench.trace);
  const Outcome text = bench.look({"--ledger"});
  REQUIRE(text.status == 0);
  CHECK(contains(text.out, fmt::format("{} calls: ", file.calls().size())));
  CHECK(contains(text.out, "undone with a caller"));
  const Outcome outcome = bench.look({"--ledger", "--json"});
  REQUIRE(outcome.status == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  std::size_t calls = 0;
  for (const auto& row : json["rows"]) {
    for (const auto& [name, cell] : row["endings"].items()) {
      calls += cell["calls"].get<std::size_t>();
    }
  }
  CHECK(calls == file.calls().size());
  const Outcome wrong = bench.look({"--json"});
  CHECK(wrong.status == 2);
  CHECK(contains(wrong.err, "--json is for --ledger and --against"));
}

TEST_CASE("two traces are set side by side, and neither is written over") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const std::string other = (bench.folder / "other.trace").string();
  REQUIRE(bench.improve({"--trace", other, "--schedule", "conservative"}).status == 0);
  const Outcome outcome = bench.look({"--against", other});
  REQUIRE(outcome.status == 0);
  CHECK(contains(outcome.out, "bad in a where b has a good tet: "));
  const auto json = nlohmann::json::parse(bench.look({"--against", other, "--json"}).out);
  CHECK(json["b"]["all"]["calls"] == TraceFile(other).calls().size());
  CHECK(bench.look({"--against", other, "-o", other}).status == 2);
  const Outcome none = bench.look({"--against", (bench.folder / "none").string()});
  CHECK(none.status == 1);
  CHECK(contains(none.err, "none"));
}

TEST_CASE("a page without a call is of the whole trace, and one of call 0 is not") {
  TraceBench bench;
  bench.trace = std::string(TETMEND_SOURCE_DIR) + "/assets/lessons/2-two-shells.trace";
  const TraceFile file(bench.trace);
  const std::string page = (bench.folder / "page.html").string();
  const auto end_of_page = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"-o", page});
    const Outcome outcome = bench.look(more);
    CHECK(outcome.err == "");
    REQUIRE(outcome.status == 0);
    const std::string html = read_text(page);
    const std::string begin = "id=\"recording\">";
    const std::size_t from = html.find(begin) + begin.size();
    const auto recording =
        nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
    return recording["steps"].back()[0].get<std::uint64_t>();
  };
  CHECK(end_of_page({"--html"}) == file.event_count());
  CHECK(end_of_page({"--html", "0"}) == file.calls()[0].events.end);
  CHECK(file.calls()[0].events.end < file.event_count());
  const Outcome wrong = bench.look({"--html", "x", "-o", page});
  CHECK(wrong.status == 2);
  CHECK(contains(wrong.err, "--html: 'x' is no number of a call"));
}

TEST_CASE(
    "a lesson is made of a call of a run, told, and becomes a page that answers its questions") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const std::string json = (bench.folder / "run.json").string();
  const std::vector<std::string> make = {"lesson", "--make", bench.trace, "--call", "3"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = make;
    all.insert(all.end(), more.begin(), more.end());
    return run_program(all);
  };
  REQUIRE(with({"-o", json, "--title", "Of mine"}).status == 0);
  const Lesson lesson = read_lesson(json);
  CHECK(lesson.title == "Of mine");
  CHECK(lesson.call == 3);
  CHECK(std::ranges::count_if(lesson.steps,
                              [](const LessonStep& step) { return step.ask.has_value(); }) == 3);
  const Outcome told = run_program({"lesson", json});
  REQUIRE(told.status == 0);
  for (const LessonStep& step : lesson.steps) CHECK(contains(told.out, step.text));
  const std::string page = (bench.folder / "page.html").string();
  REQUIRE(run_program({"lesson", json, "--html", "-o", page}).status == 0);
  CHECK(contains(read_text(page), "\"answer\":"));

  const Outcome beyond =
      run_program({"lesson", "--make", bench.trace, "--call", "4000000", "-o", json});
  CHECK(beyond.status == 1);
  CHECK(contains(beyond.err, "there is no call 4000000"));
  std::filesystem::create_directory(bench.folder / "below");
  const Outcome below = with({"-o", (bench.folder / "below/x.json").string()});
  CHECK(below.status == 1);
  CHECK(contains(below.err, "a lesson lies beside its trace, or above"));
  CHECK(run_program({"lesson", "--make", bench.trace, "-o", json}).status == 2);
  CHECK(with({"-o", bench.trace}).status == 2);
  CHECK(with({}).status == 2);
  CHECK(with({"-o", json, "--html"}).status == 2);
  CHECK(run_program({"lesson", "--call", "3"}).status == 2);
  CHECK(run_program({"lesson", "--title", "x"}).status == 2);
}

TEST_CASE("the history of a tet is told by its number in the file that the run wrote") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const Outcome told = bench.look({"--history", "tet:1@" + bench.out});
  REQUIRE(told.status == 0);
  // The answer is what a terminal shows last; its vertices, as it names them.
  const std::size_t answer = told.out.rfind("\n\nTet ");
  REQUIRE(answer != std::string::npos);
  REQUIRE(told.out.find('\n', answer + 2) == told.out.size() - 1);
  CHECK(told.out.starts_with("part "));
  std::istringstream words(told.out.substr(answer + 6));
  std::string a, b, c, d;
  words >> a >> b >> c >> d;
  const std::string by_vertices = "tet:" + a + "," + b + "," + c + "," + d;
  CHECK(bench.look({"--history", by_vertices}).out == told.out);
  CHECK(bench.look({"--history", "tet:worst"}).status == 0);
  const Outcome alone = bench.look({"--all"});
  CHECK(alone.status == 2);
  CHECK(contains(alone.err, "--all is for --history"));
  const Outcome wrong = bench.look({"--history", "tet:1@"});
  CHECK(wrong.status == 1);
  CHECK(contains(wrong.err, "'tet:1@' names nothing in a trace: expected tet:N"));
  CHECK(bench.look({"--history", "tet:1", "--tree", "1"}).status == 2);
}

TEST_CASE("the mesh at an event is written, with the cavity as a field of a VTK file") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const TraceFile file(bench.trace);
  const std::string first = (bench.folder / "first.mesh").string();
  REQUIRE(bench.look({"--at", "0", "-o", first}).status == 0);
  CHECK(read_mesh(first).tets.size() == read_mesh(asset("sheet.mesh")).tets.size());
  const std::string last = (bench.folder / "last.mesh").string();
  REQUIRE(bench.look({"--at", std::to_string(file.event_count()), "-o", last}).status == 0);
  CHECK(read_mesh(last).tets.size() == read_mesh(bench.out).tets.size());
  EventCursor events(file);
  while (events.next().kind != EventKind::replace_cavity) {
  }
  const std::string vtk = (bench.folder / "then.vtk").string();
  REQUIRE(bench.look({"--at", std::to_string(events.position()), "-o", vtk}).status == 0);
  const std::string content = read_text(vtk);
  const std::string head = "SCALARS cavity int 1\nLOOKUP_TABLE default\n";
  const std::size_t at = content.find(head);
  REQUIRE(at != std::string::npos);
  EventCursor again(file);
  again.move_to(events.position() - 1);
  std::size_t created = 0;
  const std::size_t tets = read_mesh(vtk).tets.size();
  for (std::size_t i = 0; i < tets; ++i) created += content[at + head.size() + 4 * i + 3] & 1;
  CHECK(created == again.next().created.size());
  CHECK(bench.look({"--at", "0"}).status == 2);
  CHECK(bench.look({"--at", "99999999", "-o", vtk}).status == 1);
}

TEST_CASE("a call that was extracted goes the same way when it is repeated") {
  TraceBench bench;
  // A polish judges by the mean of the whole mesh, which the part does not have.
  // Nor has it the step of the whole mesh.
  std::vector<std::string> options = {"--set",         "polish_first=0", "--set",
                                      "polish_last=0", "--for",          "angles"};
  bool protects = false;
  SUBCASE("of a whole mesh") {}
  SUBCASE("beside protected tets") {
    options.insert(options.end(), {"--protect", "box:0,0,0,13,11,4"});
    protects = true;
  }
  SUBCASE("a sequence, by a goal that the schedule sets") {
    const std::string schedule = (bench.folder / "sequences.lua").string();
    write_text(schedule, R"(
        goal{min = 36, max = 150}
        judge_by{measure = "sine"}
        apply(sequence{{"edge_split"}, {"shell_transformation", order = "longest"},
                       all_of{"smoothing", "multi_face_removal"}, desperate = 0.9},
              {on = {worst = 60}}))");
    options = {"--schedule", schedule, "--goal", "20", "--for", "angles"};
  }
  // A goal that was asked for may be missed.
  const auto is_done = [](int status) { return status == 0 || status == 3; };
  REQUIRE(is_done(bench.record(options).status));
  const TraceFile file(bench.trace);
  std::size_t repeated = 0;
  std::size_t accepted = 0;
  std::size_t protected_again = 0;
  std::size_t outermost = 0;
  for (std::uint32_t c = 0; c < file.calls().size(); c = file.calls()[c].subtree_end) {
    const Call& call = file.calls()[c];
    if (outermost++ % 7 != 0 && !call.accepted()) continue;
    if (++repeated > 40) break;
    CAPTURE(describe_call(file, c));
    const std::string kit = (bench.folder / "kit").string();
    REQUIRE(bench.look({"--extract", std::to_string(c), "-o", kit}).status == 0);
    const std::string again = (bench.folder / "again.trace").string();
    std::vector<std::string> command = {
        "improve",    kit + "/call.mesh", "-o",      kit + "/out.mesh",
        "--schedule", kit + "/call.lua",  "--trace", again,
        "--for",      "angles",           "-q"};
    const std::string told = read_text(kit + "/README.txt");
    for (const std::string option : {"--layers", "--goal", "--protect"}) {
      const std::size_t at = told.find(option + " ");
      if (at == std::string::npos) continue;
      const std::size_t value = at + option.size() + 1;
      command.insert(command.end(), {option, told.substr(value, told.find(' ', value) - value)});
      protected_again += option == "--protect" ? 1 : 0;
    }
    const Outcome outcome = run_program(command);
    REQUIRE_MESSAGE(is_done(outcome.status), outcome.err);
    const TraceFile repeat(again);
    const Call& now = repeat.calls()[0];
    CHECK(now.verdict == call.verdict);
    CHECK(now.subtree_end == call.subtree_end - c);
    CHECK(now.worst_before == call.worst_before);
    CHECK(now.worst_after == call.worst_after);
    accepted += call.accepted() ? 1 : 0;
  }
  CHECK(repeated > 20);
  CHECK(accepted > 5);
  CHECK((protected_again > 0) == protects);
}

TEST_CASE("a trace that is cut off is summarised with a warning; what is none is refused") {
  TraceBench bench;
  REQUIRE(bench.record().status == 0);
  const std::string whole = read_text(bench.trace);
  write_text(bench.trace, whole.substr(0, whole.size() - 100));
  const Outcome cut = bench.look({});
  CHECK(cut.status == 0);
  CHECK(contains(cut.err, "tetmend: warning: "));
  CHECK(contains(cut.err, "read up to event "));
  write_text(bench.trace, "no trace");
  const Outcome none = bench.look({});
  CHECK(none.status == 1);
  CHECK(contains(none.err, "is no trace of tetmend"));
}
