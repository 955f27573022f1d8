// SPDX-License-Identifier: MIT
#include "explain/paper_lines.h"

#include <map>

#include <doctest/doctest.h>

#include "explain/stepper.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

struct Line {
  const test::HandmadeTrace trace;
  const TraceFile file{trace.path()};

  /// Lines of the calls on the stack, outermost first.
  std::vector<unsigned> at(std::uint64_t position) const {
    const auto stack = call_stack(file, position);
    std::vector<unsigned> lines;
    for (std::size_t i = 0; i < stack.size(); ++i) {
      lines.push_back(code_place(file, stack, i, position).line);
    }
    return lines;
  }
};

}  // namespace

TEST_CASE("a recursion goes through the lines of Algorithm 4, its transformations of Algorithm 3") {
  const Line line;
  using Lines = std::vector<unsigned>;
  CHECK(line.at(3) == Lines{1});
  CHECK(line.at(4) == Lines{3, 1});
  CHECK(line.at(5) == Lines{3, 6});
  CHECK(line.at(6) == Lines{3, 7});
  CHECK(line.at(7) == Lines{12, 1});
  CHECK(line.at(8) == Lines{12, 7});
  CHECK(line.at(9) == Lines{15});
  const auto stack = call_stack(line.file, 5);
  CHECK(code_place(line.file, stack, 0, 5).code == &recursion_code());
  CHECK(code_place(line.file, stack, 1, 5).code == &shell_transformation_code());
}

TEST_CASE("while a call is at hand, its caller is at the line of the algorithm that calls it") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const auto words_of = [](const Call& call) -> std::string_view {
    if (call.algorithm == Algorithm::recursion) return "recursion";
    return call.algorithm == Algorithm::shell_transformation ? "transform the shell" : "removal of";
  };
  std::map<unsigned, unsigned> seen;
  for (const Call& call : file.calls()) {
    for (const std::uint64_t position : {call.events.begin + 1, call.events.end}) {
      const auto stack = call_stack(file, position);
      const bool is_outermost = stack.size() == 1;
      const CodePlace caller = is_outermost ? pass_place(file, stack, position)
                                            : code_place(file, stack, stack.size() - 2, position);
      const bool is_paper = caller.code == &recursion_code() || caller.code == &reconnection_code();
      if (!is_paper) continue;
      ++seen[caller.line];
      const std::string_view line = caller.code->lines[caller.line - 1];
      CAPTURE(line);
      CHECK(line.find(words_of(call)) != std::string_view::npos);
      CHECK(caller.goes_on == (position == call.events.end ? caller.line + 1 : 0));
    }
  }
  for (const unsigned line : {3U, 8U, 12U, 13U}) CHECK(seen[line] > 0);
}

TEST_CASE("an accepted transformation ends on the line that replaces the tets") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  unsigned seen = 0;
  for (std::size_t k = 0; k < file.calls().size() && seen < 5; ++k) {
    const Call& call = file.calls()[k];
    const bool is_made = call.algorithm == Algorithm::shell_transformation && call.accepted();
    if (!is_made && k % 50 != 0) continue;
    const auto stack = call_stack(file, call.events.end);
    const CodePlace place = code_place(file, stack, stack.size() - 1, call.events.end);
    if (is_made) {
      CHECK(place.line == 8);
      ++seen;
    }
    if (call.algorithm == Algorithm::other) {
      CHECK((place.code != nullptr) == (file.name(call.operator_name) == "mean_smoothing"));
    }
    if (call.algorithm == Algorithm::smoothing) {
      REQUIRE(place.code != nullptr);
      CHECK(place.line == (call.accepted() ? 7U : call.candidate_found ? 6U : 5U));
    }
  }
  CHECK(seen > 0);
}

TEST_CASE("a transformation that is undone goes from its covering back to the comparison") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  EventCursor cursor(file);
  unsigned seen = 0;
  for (const Call& call : file.calls()) {
    if (call.algorithm != Algorithm::shell_transformation || call.accepted()) continue;
    if (!call.candidate_found) {
      const auto stack = call_stack(file, call.events.end);
      const bool searched = call.verdict == Verdict::no_improvement;
      CHECK(code_place(file, stack, stack.size() - 1, call.events.end).line == (searched ? 4 : 7));
      continue;
    }
    ++seen;
    cursor.move_to(call.events.begin);
    while (cursor.position() < call.events.end) {
      const EventKind kind = cursor.next().kind;
      const auto stack = call_stack(file, cursor.position());
      const unsigned line = code_place(file, stack, stack.size() - 1, cursor.position()).line;
      if (kind == EventKind::attempt_begins) CHECK(line == 1);
      if (kind == EventKind::candidate_found) CHECK(line == 6);
      if (kind == EventKind::replace_cavity) CHECK(line == 8);
      if (kind == EventKind::undo || kind == EventKind::attempt_ends) CHECK(line == 7);
    }
  }
  CHECK(seen > 0);
}

TEST_CASE("a sequence opens, goes on with the other operators, and keeps or undoes it all") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  test::record(mesh, folder / "run.trace", {}, {}, Schedule("test.lua", R"lua(
    for _ = 1, 3 do
      apply(sequence{{"edge_split", order = "longest"}, "smoothing", "joint_smoothing"},
            {on = {worst = 50}})
    end)lua"));
  const TraceFile file(folder / "run.trace");
  std::map<unsigned, unsigned> lines;
  unsigned joint = 0;
  for (std::uint32_t k = 0; k < file.calls().size(); ++k) {
    const Call& call = file.calls()[k];
    for (const std::uint64_t position : {call.events.begin + 1, call.events.end}) {
      const auto stack = call_stack(file, position);
      for (std::size_t i = 0; i < stack.size(); ++i) {
        const CodePlace place = code_place(file, stack, i, position);
        REQUIRE(place.code != nullptr);
        CHECK(place.line >= 1);
        CHECK(place.line <= place.code->lines.size());
        const Call& at = file.calls()[stack[i]];
        joint += file.name(at.operator_name) == "joint_smoothing" ? 1 : 0;
        if (at.depth > 0) continue;
        CHECK(place.code->title == "Sequence of operators at one target");
        ++lines[place.line];
        if (position == at.events.end) CHECK((place.line == 6) == at.accepted());
      }
    }
  }
  for (const unsigned line : {1U, 4U, 6U}) CHECK(lines[line] > 0);
  CHECK(lines[2] + lines[7] > 0);
  CHECK(joint > 0);
}

TEST_CASE("mean smoothing ends where it keeps a place, has found none, or has tried all") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  test::record(mesh, folder / "run.trace", {}, {}, Schedule::builtin("polish"));
  const TraceFile file(folder / "run.trace");
  std::map<unsigned, unsigned> ends;
  for (std::uint32_t k = 0; k < file.calls().size(); ++k) {
    const Call& call = file.calls()[k];
    if (file.name(call.operator_name) != "mean_smoothing") continue;
    const auto stack = call_stack(file, call.events.end);
    const CodePlace place = code_place(file, stack, stack.size() - 1, call.events.end);
    REQUIRE(place.code != nullptr);
    CHECK(place.code->title == "Mean smoothing of vertex v");
    CHECK(place.line == (call.accepted() ? 5 : call.candidate_found ? 4 : 2));
    ++ends[place.line];
  }
  CHECK(ends[5] > 0);
  CHECK(ends[2] + ends[4] > 0);
}

TEST_CASE("the algorithms have as many lines as in the paper") {
  CHECK(shell_transformation_code().lines.size() == 8);
  CHECK(recursion_code().lines.size() == 15);
}
