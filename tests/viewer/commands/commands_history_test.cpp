// SPDX-License-Identifier: MIT
#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"
#include "viewer/commands/script.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

struct HistorySession {
  explicit HistorySession(const std::filesystem::path& file) {
    document.resize({400, 300});
    document.open(file);
  }
  Document document;
  test::BlankHost host;
  Session session{document, host};
};

}  // namespace

TEST_CASE("a script asks a trace about tets, edges and vertices") {
  const test::TracedBall trace;
  HistorySession s(trace.path());
  run_script(s.session, R"lua(
    seek(100)
    local worst = history{tet = "worst"}
    expect(state().trace.position == 100, "the place stays")
    expect(#worst.vertices == 4, "a tet")
    expect(worst.removed == nil, "it is there")
    local v = worst.vertices
    local edge = history{edge = {v[1], v[2]}}
    expect(#edge.vertices == 2, "an edge")
    local vertex = history("vertex:" .. string.format("%d", v[1]))
    expect(#vertex.vertices == 1, "a vertex")
    if #worst.calls > 0 then
      enter(worst.calls[1].call)
      expect(state().trace.call.number == worst.calls[1].call, "there")
    end
  )lua",
             "t.lua");
  REQUIRE(s.document.debugger()->history());
  CHECK(s.document.debugger()->history()->subject.size() == 1);
  const auto worst = find_command("history").run(s.session, {"tet:worst"});
  CHECK(worst["text"].get<std::string>().find("and is there when the trace ends") !=
        std::string::npos);
  find_command("to_end").run(s.session, {});
  find_command("history").run(s.session, {"tet:worst"});
  const auto* selected = std::get_if<TetHandle>(&s.document.selection());
  REQUIRE(selected != nullptr);
  for (const VertexHandle v : s.document.mesh().vertices(*selected)) {
    const auto& subject = s.document.debugger()->history()->subject;
    CHECK(std::find(subject.begin(), subject.end(), v) != subject.end());
  }
}

TEST_CASE("the selection is asked for, and numbers of a file count from 0") {
  const test::TracedBall trace;
  HistorySession s(trace.path());
  find_command("to_end").run(s.session, {});
  const auto file = trace.folder / "end.mesh";
  s.document.save(file);
  const MeshData written = read_mesh(file);
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < s.document.mesh().tet_slots(); ++i) {
    if (!s.document.mesh().is_deleted(TetHandle(i))) slots.push_back(i);
  }
  REQUIRE(slots.size() == written.tets.size());
  const std::size_t k = slots.size() / 2;
  const auto by_file =
      find_command("history").run(s.session, {{{"tet", k}, {"file", file.string()}}});
  s.document.select(TetHandle(slots[k]));
  const auto by_selection = find_command("history").run(s.session, nlohmann::json::array());
  CHECK(by_file["vertices"] == by_selection["vertices"]);
  CHECK(by_file["text"] == by_selection["text"]);
}

TEST_CASE("the visits that a history counts lead to its tet") {
  const test::TracedBall trace;
  HistorySession s(trace.path());
  const auto told = find_command("history").run(s.session, {"tet:worst"});
  REQUIRE(told["visited"].size() > 0);
  CHECK(told["visited"].size() == told["visits"]);
  for (const auto& visit : told["visited"]) {
    find_command("to_begin").run(s.session, {});
    const auto condition = fmt::format("visit {}", visit.get<int>());
    REQUIRE(find_command("run_to").run(s.session, {condition}).get<bool>());
    CHECK(s.document.debugger()->visit() == visit.get<std::uint32_t>());
    const auto named = s.document.pointed_selection(s.document.selection());
    CHECK(nlohmann::json(named.vertices.size()) == told["vertices"].size());
    for (const VertexHandle v : named.vertices) {
      CHECK(std::count(told["vertices"].begin(), told["vertices"].end(), v.index()) == 1);
    }
  }
}

TEST_CASE("questions that make no sense are errors that say what is valid, and nothing moves") {
  const test::TracedBall trace;
  HistorySession s(trace.path());
  find_command("seek").run(s.session, {50});
  const auto fails = [&](const nlohmann::json& arguments, const char* text) {
    CAPTURE(arguments.dump());
    CHECK_THROWS_WITH_AS(find_command("history").run(s.session, arguments), doctest::Contains(text),
                         Error);
    CHECK(s.document.debugger()->position() == 50);
  };
  s.document.select({});
  fails(nlohmann::json::array(), "select a tet");
  fails({{{"tot", 3}}}, "valid: one of tet, face, edge, vertex");
  fails({{{"tet", 3}, {"edge", {1, 2}}}}, "valid: one of");
  fails({{{"tet", -1}}}, "no number");
  fails({{{"tet", 3999999}}}, "no tet");
  fails({{{"edge", {1, 1}}}}, "edge:A,B");
  fails({"nonsense"}, "tet:worst");
}

TEST_CASE("what a script prints goes to the host, numbers and tables, too") {
  struct Listener : test::BlankHost {
    void print(const std::string& line) override { lines += line + "|"; }
    std::string lines;
  } host;
  Document document;
  Session session{document, host};
  run_script(session, "print('a', 2, 2.5, true, nil) print({x = 1}) print()", "t.lua");
  CHECK(host.lines == "a 2 2.5 true nil|{\n  \"x\": 1\n}||");
}
