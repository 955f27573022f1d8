// SPDX-License-Identifier: MIT
#include <algorithm>

#include <doctest/doctest.h>

#include "explain/timeline.h"
#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_view.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/second_order.h"
#include "tests/viewer/session.h"
#include "trace/replay.h"
#include "viewer/commands/script.h"

using namespace tetmend;
using namespace tetmend::viewer;
using nlohmann::json;
using test::TestSession;

namespace {

/// The mesh that is shown, as a file.
std::string bytes_of(const Document& document) {
  const test::TempFolder folder;
  write_mesh(folder / "now.mesh", MeshView(document.mesh()));
  return test::read_text(folder / "now.mesh");
}

/// An accepted removal of an edge of the worst tet of the mesh; "" where there is none.
bool try_until_accepted(TestSession& s) {
  const TetMesh mesh = s.document.mesh();
  for (const TetHandle t : std::vector<TetHandle>(s.document.worst())) {
    for (unsigned e = 0; e < 6; ++e) {
      const auto ends = mesh.vertices(TetEdge(t, e));
      const json result =
          s.run("try_operator",
                {{{"operator", "edge_removal"}, {"edge", {ends[0].index(), ends[1].index()}}}});
      if (result["accepted"] == true) return true;
      s.run("undo");
    }
  }
  return false;
}

MeshData sheet() {
  return read_mesh(TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh");
}

}  // namespace

TEST_CASE("an operator that was tried is a call of the debugger, and undo leaves the same bytes") {
  TestSession s(sheet());
  const std::string before = bytes_of(s.document);
  s.run("worst");
  const json view = to_json(s.document.view);
  REQUIRE(try_until_accepted(s));
  const json state = state_of(s.document);
  CHECK(state["trial"]["operator"] == "edge_removal");
  CHECK(state["trial"]["worst_after"] > state["trial"]["worst_before"]);
  CHECK(state["trace"].is_object());
  REQUIRE(s.document.debugger() != nullptr);
  CHECK(s.document.debugger()->study() != nullptr);
  CHECK(s.document.debugger()->study()->picture.has_value());  // the ring
  CHECK(bytes_of(s.document) != before);
  CHECK(state["unsaved"] == false);  // not before it is kept
  s.run("undo");
  CHECK(bytes_of(s.document) == before);
  CHECK(s.document.debugger() == nullptr);
  CHECK(state_of(s.document)["trial"].is_null());
  CHECK(to_json(s.document.view) == view);
}

namespace {

/// What is known of the mesh that is shown is what a look at the whole of it tells.
void check_derived(Document& document) {
  const TetMesh& mesh = document.mesh();
  TetLists fresh;
  CHECK(document.worst() == fresh.worst(mesh, "quality"));
  CHECK(
      std::ranges::equal(document.histogram().counts(), fresh.histogram(mesh, "quality").counts()));
  CHECK(document.statistics().n_bad == compute_statistics(mesh, mesh.standard().goal()).n_bad);
  CHECK(document.statistics().q_worst == compute_statistics(mesh, mesh.standard().goal()).q_worst);
  SceneSettings settings = document.view.scene;
  settings.isolate = false;
  const Scene truth =
      build_scene({mesh, settings, {document.values(), {}}, {}, {}, std::nullopt, document.ball()});
  const bool was_isolated = document.view.scene.isolate;
  document.view.scene.isolate = false;
  const Scene& shown = document.scene();
  CHECK(shown.tets_shown == truth.tets_shown);
  CHECK(shown.bad_shown == truth.bad_shown);
  const auto sorted = [](std::vector<TetHandle> tets) {
    std::sort(tets.begin(), tets.end());
    return tets;
  };
  CHECK(sorted(shown.surface_tets) == sorted(truth.surface_tets));
  CHECK(sorted(shown.through_tets) == sorted(truth.through_tets));
  document.view.scene.isolate = was_isolated;
}

/// The tets of what a call aimed at, by a look at all.
void check_tets_around(Document& document) {
  Debugger& debugger = *document.debugger();
  for (const Call& call : debugger.file().calls()) {
    std::vector<TetHandle> found;
    for (std::uint32_t i = 0; i < document.mesh().tet_slots(); ++i) {
      const TetHandle t(i);
      const auto target = call.target();
      const bool has_all = std::all_of(target.begin(), target.end(), [&](VertexHandle v) {
        return document.mesh().local_index(t, v) < 4;
      });
      if (!document.mesh().is_deleted(t) && has_all) found.push_back(t);
    }
    CHECK(debugger.tets_around(call.target()) == found);
  }
}

}  // namespace

TEST_CASE(
    "a trial and its undo look at what they change alone, and all that is known stays right") {
  TestSession s(sheet());
  check_derived(s.document);
  const std::uint64_t scene = s.document.scene().number;
  const std::vector<TetHandle> worst = s.document.worst();
  unsigned accepted = 0;
  for (const char* name : {"edge_split", "recursive_shell_transformation", "edge_removal"}) {
    for (std::size_t k = 0; k < 6; ++k) {
      const TetVertices v = s.document.mesh().vertices(worst[k]);
      const json edge = {v[k % 3].index(), v[3].index()};
      accepted += s.run("try_operator", {{{"operator", name}, {"edge", edge}}})["accepted"] == true;
      check_derived(s.document);
      Debugger& debugger = *s.document.debugger();
      Replay replay(debugger.file());
      const auto timeline = explain::make_timeline(debugger.file(), replay);
      REQUIRE(debugger.timeline().samples.size() == timeline.samples.size());
      for (std::size_t i = 0; i < timeline.samples.size(); ++i) {
        CHECK(debugger.timeline().samples[i].n_bad == timeline.samples[i].n_bad);
        CHECK(debugger.timeline().samples[i].q_worst == timeline.samples[i].q_worst);
      }
      for (const char* step : {"back_into", "back_into", "step_into", "to_begin", "to_end"}) {
        s.run(step);
        check_tets_around(s.document);
      }
      if (k % 2 == 0) continue;  // the next one is tried on the mesh as it was all the same
      s.run("undo");
      check_derived(s.document);
      CHECK(s.document.scene().number == scene);  // nothing was built anew
    }
  }
  CHECK(accepted > 2);
}

TEST_CASE("what is kept is in the mesh and unsaved until it is written") {
  TestSession s(sheet());
  REQUIRE(try_until_accepted(s));
  const std::string tried = bytes_of(s.document);
  s.run("keep");
  CHECK(bytes_of(s.document) == tried);
  CHECK(s.document.debugger() == nullptr);
  CHECK(state_of(s.document)["unsaved"] == true);
  CHECK(s.document.title().starts_with("* "));
  const test::TempFolder folder;
  s.run("save", {(folder / "kept.mesh").string()});
  CHECK(state_of(s.document)["unsaved"] == false);
  REQUIRE(try_until_accepted(s));  // again, on a mesh that was edited
  s.run("undo");
  CHECK(bytes_of(s.document) == tried);
}

TEST_CASE("other parameters try it again on the mesh as it was") {
  TestSession s(sheet());
  const std::string before = bytes_of(s.document);
  const TetVertices v = s.document.mesh().vertices(s.document.worst().front());
  const json edge = {v[0].index(), v[1].index()};
  const auto calls = [&](double level) {
    return s
        .run("try_operator", {{{"operator", "recursive_shell_transformation"},
                               {"edge", edge},
                               {"set", {{"max_level", level}}}}})["calls"]
        .get<int>();
  };
  const int flat = calls(0);
  const int deep = calls(5);
  CHECK(flat >= 1);
  CHECK(deep >= flat);
  CHECK(calls(0) == flat);
  s.run("undo");
  CHECK(bytes_of(s.document) == before);
}

TEST_CASE("faces are picked, selected and tried") {
  TestSession s(sheet());
  const TetVertices v = s.document.mesh().vertices(TetHandle(0));
  s.run("select_face", {v[0].index(), v[1].index(), v[2].index()});
  CHECK(state_of(s.document)["selection"]["kind"] == "face");
  const json result = s.run("try_operator", {{{"operator", "flip_2_3"}}});
  CHECK(result["target"].size() == 3);
  s.run("undo");
  CHECK(state_of(s.document)["selection"]["kind"] == "face");
  CHECK_THROWS_WITH_AS(s.run("select_face", {v[0].index(), v[1].index(), v[1].index()}),
                       doctest::Contains("there is no face"), Error);
}

TEST_CASE("a trial that cannot be is refused in words, and nothing changes") {
  TestSession s(sheet());
  const std::string before = bytes_of(s.document);
  const auto fails = [&](const json& request, const char* words) {
    CHECK_THROWS_WITH_AS(s.run("try_operator", json::array({request})), doctest::Contains(words),
                         Error);
    CHECK(bytes_of(s.document) == before);
    CHECK(s.document.debugger() == nullptr);
  };
  fails({{"operator", "nope"}}, "nope");
  fails({{"operator", "edge_removal"}}, "is for an edge, which is neither selected nor given");
  fails({{"operator", "edge_removal"}, {"edge", {0, 1e9}}}, "there is no vertex");
  fails({{"operator", "edge_removal"}, {"tet", 0}}, "is for an edge");
  fails({{"operator", "edge_removal"}, {"edge", {0, 1}}, {"set", {{"max_degree", 99}}}},
        "max_degree");
  fails({{"operator", "edge_removal"}, {"egde", {0, 1}}}, "'egde' is not known");
  CHECK_THROWS_WITH_AS(s.run("keep"), doctest::Contains("no operator was tried"), Error);
  CHECK_THROWS_WITH_AS(s.run("undo"), doctest::Contains("no operator was tried"), Error);
}

TEST_CASE("what a panel asks for while panels are drawn is done when all are drawn, in its order") {
  TestSession s(sheet());
  REQUIRE(try_until_accepted(s));
  s.session.is_drawing = true;
  run_from_window(find_command("undo"), s.session);
  run_from_window(find_command("undo"), s.session);
  CHECK(s.document.trial() != nullptr);
  CHECK(s.document.debugger() != nullptr);
  s.session.is_drawing = false;
  do_asked(s.session);
  CHECK(s.document.trial() == nullptr);
  CHECK(s.document.message.text == "undo: no operator was tried");  // what the second has said
  s.document.message = {};
  do_asked(s.session);  // nothing is done twice
  CHECK(s.document.message.text.empty());
}

TEST_CASE("what would lose unsaved work waits for an answer in the window, not in a script") {
  TestSession s(sheet());
  REQUIRE(try_until_accepted(s));
  s.run("keep");
  run_from_window(find_command("quit"), s.session);
  CHECK_FALSE(s.document.quit);
  REQUIRE(s.document.waiting);
  CHECK(s.document.waiting->name == "quit");
  run_waiting(s.session);
  CHECK(s.document.quit);
  s.document.quit = false;
  const std::string other = TETMEND_SOURCE_DIR "/assets/meshes/two_materials.mesh";
  run_from_window(find_command("open"), s.session, {other});
  CHECK(s.document.file() == "test.mesh");
  s.run("open", {other});
  CHECK(s.document.file() == other);
  CHECK(s.document.recent.front() == other);
  CHECK_FALSE(s.document.has_unsaved());
}

TEST_CASE("to save while a trial is shown keeps what was accepted and undoes what was refused") {
  const test::TempFolder folder;
  {
    TestSession s(sheet());
    REQUIRE(try_until_accepted(s));
    const std::string tried = bytes_of(s.document);
    s.run("save", {(folder / "kept.mesh").string()});
    CHECK(test::read_text(folder / "kept.mesh") == tried);
    CHECK(s.document.trial() == nullptr);
    CHECK(bytes_of(s.document) == tried);
    CHECK_FALSE(s.document.has_unsaved());
  }
  TestSession s(sheet());
  const std::string before = bytes_of(s.document);
  const TetVertices v = s.document.mesh().vertices(TetHandle(0));
  const json result = s.run("try_operator", {{{"operator", "edge_removal"},
                                              {"edge", {v[0].index(), v[1].index()}},
                                              {"set", {{"max_degree", 3}}}}});
  REQUIRE(result["accepted"] == false);
  s.run("save", {(folder / "undone.mesh").string()});
  CHECK(test::read_text(folder / "undone.mesh") == before);
  CHECK(s.document.trial() == nullptr);
}

TEST_CASE("what is kept keeps mid-side nodes and arrays of its file, and is saved with them") {
  const test::TempFolder folder;
  MeshData data = test::second_order(sheet(), 0);
  data.tet_data = {{"number", 1, std::vector<double>(data.tets.size(), 7)}};
  write_mesh(folder / "in.vtu", data);
  TestSession s(sheet());
  s.document.open(folder / "in.vtu");
  for (int i = 0; i < 2; ++i) {  // the second on what the first has made
    REQUIRE(try_until_accepted(s));
    s.run("keep");
    const auto tets = s.document.mesh().tet_count();
    s.run("save", {(folder / "out.vtu").string()});
    const MeshData out = read_mesh(folder / "out.vtu");
    CHECK(out.tets.size() == tets);
    CHECK(out.mid_nodes.size() > tets);  // one for each edge
    REQUIRE(out.tet_data.size() == 1);
    CHECK(out.tet_data[0].name == "number");
    CHECK(s.document.message.text.find("without") == std::string::npos);
  }
}

TEST_CASE("a trial steps back to the mesh as it was, and on again, tet by tet") {
  TestSession s(sheet());
  const std::string before = bytes_of(s.document);
  REQUIRE(try_until_accepted(s));
  const std::string tried = bytes_of(s.document);
  REQUIRE(tried != before);
  s.run("to_begin");
  CHECK(bytes_of(s.document) == before);
  s.run("to_end");
  CHECK(bytes_of(s.document) == tried);
  for (int i = 0; i < 3; ++i) s.run("back_into");
  s.run("keep");  // what was tried, wherever one looks
  CHECK(bytes_of(s.document) == tried);
}
