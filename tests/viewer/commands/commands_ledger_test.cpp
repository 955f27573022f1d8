// SPDX-License-Identifier: MIT
#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/error.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"
#include "viewer/commands/script.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

struct LedgerSession {
  explicit LedgerSession(const std::filesystem::path& file) {
    document.resize({400, 300});
    document.open(file);
  }
  nlohmann::json run(std::string_view command, const nlohmann::json& arguments = {}) {
    return find_command(command).run(session, arguments);
  }
  const TraceFile& file() { return document.debugger()->file(); }

  Document document;
  test::BlankHost host;
  Session session{document, host};
};

std::size_t count(const TraceFile& file, bool (*holds)(const Call&)) {
  return static_cast<std::size_t>(std::count_if(file.calls().begin(), file.calls().end(), holds));
}

}  // namespace

TEST_CASE("the keys for accepted calls pass over those that a caller undid, unless asked") {
  const test::TracedBall trace;
  LedgerSession s(trace.path());
  std::size_t lasting = 0;
  while (s.run("next_accepted").get<bool>()) ++lasting;
  CHECK(lasting == count(s.file(), [](const Call& c) { return c.accepted_for_good(); }));
  s.run("to_begin");
  std::size_t all = 0;
  while (s.run("next_accepted", {"all"}).get<bool>()) ++all;
  CHECK(all == count(s.file(), [](const Call& c) { return c.accepted(); }));
  CHECK(all > lasting);
  CHECK_THROWS_WITH_AS(s.run("next_accepted", {"some"}), doctest::Contains("expected all"), Error);
}

TEST_CASE("a call that was undone says so where it ends, and not before") {
  const test::TracedBall trace;
  LedgerSession s(trace.path());
  REQUIRE(s.run("run_to", {"undone"}).get<bool>());
  const nlohmann::json ended = s.run("state")["trace"];
  const std::string verdict = ended["call"]["verdict"];
  CHECK(verdict == "undone with call " + std::to_string(ended["call"]["undone_with"].get<int>()));
  CHECK(ended["event"].get<std::string>().find(verdict) != std::string::npos);
  CHECK(ended["reason"].get<std::string>().find("undid it") != std::string::npos);
  s.run("back_into");
  CHECK(s.run("state")["trace"]["stack"].back()["verdict"] != verdict);
}

TEST_CASE("a script lists the calls of a condition and has the ledger of the run") {
  const test::TracedBall trace;
  LedgerSession s(trace.path());
  s.run("seek", {50});
  const auto found = s.run("list_calls", {"operator smoothing and refused"});
  REQUIRE(found.size() > 10);
  CHECK(s.document.debugger()->position() == 50);
  REQUIRE(s.document.debugger()->found());
  CHECK(s.document.debugger()->found()->calls.size() == found.size());
  const auto ledger = s.run("ledger");
  CHECK(ledger["all"]["calls"] == s.file().calls().size());
  std::size_t refused = 0;
  for (const auto& row : ledger["rows"]) {
    if (row["operator"] != "smoothing") continue;
    for (const auto& [name, cell] : row["endings"].items()) {
      const bool lasted = name == "accepted for good" || name == "undone with a caller";
      refused += lasted ? 0 : cell["calls"].get<std::size_t>();
    }
  }
  CHECK(found.size() == refused);
  // Each way to end is a condition, too.
  const auto undone = s.run("list_calls", {"ending undone_with_a_caller"});
  CHECK(undone.size() == s.run("list_calls", {"undone"}).size());
  CHECK_THROWS_WITH_AS(s.run("list_calls", {"ending badly"}), doctest::Contains("nothing_better"),
                       Error);
  CHECK_THROWS_WITH_AS(s.run("list_calls", {"tet 3"}), doctest::Contains("about edits"), Error);
}

TEST_CASE("running on without a breakpoint goes to the next of the calls that are listed") {
  const test::TracedBall trace;
  LedgerSession s(trace.path());
  s.run("list_calls", {"accepted for good"});
  s.run("run");
  const std::uint64_t first = s.document.debugger()->position();
  s.run("to_begin");
  s.run("next_accepted");
  CHECK(s.document.debugger()->position() == first);
  s.run("run");
  CHECK(s.document.debugger()->position() > first);
  CHECK(s.document.debugger()->position() < s.file().event_count());
  s.run("run_back");
  CHECK(s.document.debugger()->position() == first);
  s.run("breakpoint", {"level 100"});  // there is none: to the end
  s.run("run");
  CHECK(s.document.debugger()->position() == s.file().event_count());
}

TEST_CASE("an operator that no call is of is told, and what is not found is to be seen") {
  const test::TracedBall trace;
  LedgerSession s(trace.path());
  for (const char* command : {"list_calls", "run_to"}) {
    CAPTURE(command);
    CHECK_THROWS_WITH_AS(s.run(command, {"operator nonsense"}),
                         doctest::Contains("no call of this trace is of operator 'nonsense'; they "
                                           "are of "),
                         Error);
    s.run(command, {"level 100"});
    CHECK(s.document.message.is_to_be_seen);
    CHECK_FALSE(s.document.message.is_error);
  }
  s.run("list_calls", {"accepted"});
  CHECK_FALSE(s.document.message.is_to_be_seen);
}

TEST_CASE("another run stands beside the one that is looked at") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  TetMesh again = mesh;
  test::record(mesh, folder / "a.trace", {}, {}, Schedule("smooth.lua", "smooth{}"));
  test::record(again, folder / "b.trace");
  LedgerSession s(folder / "a.trace");
  const auto made = s.run("against", {(folder / "b.trace").string()});
  CHECK(made["bad_here"] > made["bad_there"]);
  CHECK(made["bad_here_good_there"].size() > 5);
  REQUIRE(s.document.debugger()->other() != nullptr);
  const RunComparison& found = s.document.debugger()->other()->comparison();
  CHECK(found.a.all.total().calls == s.file().calls().size());
  // Its names outlive the making of the comparison.
  const TraceFile there(folder / "b.trace");
  const auto rows = found.b.by_operator();
  const auto wanted = make_ledger(there).by_operator();
  REQUIRE(rows.size() == wanted.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i].operator_name == wanted[i].operator_name);
  }
  CHECK_THROWS_AS(s.run("against", {(folder / "none.trace").string()}), Error);
}

TEST_CASE(
    "a tet that one run alone left bad is looked at in both, at one place, with both histories") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  TetMesh again = mesh;
  test::record(mesh, folder / "a.trace", {}, {}, Schedule("smooth.lua", "smooth{}"));
  test::record(again, folder / "b.trace");
  LedgerSession s(folder / "a.trace");
  CHECK_THROWS_WITH_AS(s.run("beside", {0}), doctest::Contains("no other run"), Error);
  s.run("against", {(folder / "b.trace").string()});
  s.run("seek", {30});
  const std::size_t count = s.document.debugger()->other()->comparison().worse_in_a.size();
  const auto found = s.run("beside", {1});
  CHECK(s.document.debugger()->position() == 30);
  CHECK(found["here"] == s.run("history", {"tet:" + [&] {
                                 std::string numbers;
                                 for (const auto& v : found["bad"]) {
                                   numbers += fmt::format("{}{}", numbers.empty() ? "" : ",",
                                                          v.get<int>());
                                 }
                                 return numbers;
                               }()})["text"]);
  CHECK(found["there"].get<std::string>().starts_with("Tet "));
  const PlaceInBoth& place = *s.document.debugger()->other()->place();
  REQUIRE(place.here.size() > 3);
  REQUIRE(place.there.size() > 3);
  CHECK(place.here.front().quality == found["bad_quality"].get<Quality>());
  CHECK(place.there.front().quality == found["good_quality"].get<Quality>());
  const auto middle = [](const std::vector<LocalTet>& tets) {
    Point sum(0, 0, 0);
    for (const LocalTet& tet : tets) sum += tet.corners[0] + tet.corners[3];
    return Point(sum / (2.0 * static_cast<double>(tets.size())));
  };
  CHECK((middle(place.here) - middle(place.there)).norm() < place.ball.radius);
  CHECK_THROWS_AS(s.run("beside", {count}), Error);
  CHECK(s.document.debugger()->other()->place()->number == 1);
}

TEST_CASE("no breakpoint of a live run asks what only a record knows") {
  test::TestSession s(test::shell_mesh({.degree = 5}));
  CHECK_THROWS_WITH_AS(s.run("breakpoint", {"undone"}), doctest::Contains("only recorded runs"),
                       Error);
  CHECK_THROWS_AS(s.run("breakpoint", {"ending depth_spent"}), Error);
  CHECK(s.run("breakpoint", {"accepted"}) == 1);
}
