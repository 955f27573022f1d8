// SPDX-License-Identifier: MIT
#include "viewer/commands/commands.h"

#include <filesystem>
#include <new>
#include <set>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/viewer/session.h"
#include "viewer/commands/script.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

TEST_CASE("names and keys of commands are unique, and what has a key is in a menu") {
  std::set<std::string_view> names;
  std::set<std::string_view> keys;
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    CHECK(names.insert(command.name).second);
    CHECK(command.usage.starts_with(command.name));
    if (command.keys.empty()) continue;
    CHECK(keys.insert(command.keys).second);
    CHECK_FALSE(command.menu.empty());
  }
}

TEST_CASE("the manual has the keys and words of the program") {
  const std::string manual = test::read_text(TETMEND_SOURCE_DIR "/docs/viewer-words.md");
  CHECK_MESSAGE(manual.find(command_reference()) != std::string::npos,
                "put the output of tetmend-view --keys into docs/viewer-words.md");
}

TEST_CASE("a copied view can be pasted") {
  TestSession s(test::one_tet());
  s.run("peel", {3});
  s.run("copy_view");
  s.run("show_all");
  s.run("paste_view");
  CHECK(s.document.view.scene.peel == 3);
}

TEST_CASE("commands tell what is wrong with their arguments and how they are used") {
  TestSession s(test::one_tet());
  CHECK_THROWS_WITH_AS(s.run("peel", {"much"}), doctest::Contains("peel(LAYERS)"), Error);
  CHECK_THROWS_WITH_AS(s.run("open", {7}), doctest::Contains("open(\"FILE\")"), Error);
  CHECK_THROWS_WITH_AS(s.run("cut", {0}), doctest::Contains("numbered 1 to 3"), Error);
  CHECK_THROWS_WITH_AS(s.run("pick_kind", {"region"}), doctest::Contains("nearest, tet"), Error);
  CHECK_THROWS_WITH_AS(s.run("locate"), doctest::Contains("nothing is selected"), Error);
}

TEST_CASE("a script drives the document and sees its state") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  run_script(s.session, R"lua(
    expect(state().tets == 48, "48 tets")
    cut(1)
    expect(state().shown == 24, "half of them")
    local v = view{peel = 1, cut_2 = {on = true, normal = {0, 0, 1}}}
    expect(v.peel == 1 and v.cut_2.normal[3] == 1, "what was set")
    show_all()
    select_tet(5)
    expect(state().selection.tet == 5, "the selection")
    expect(pixel(3, 4).red == 0, "black")
    quit()
    error("never reached")
  )lua",
             "test");
  CHECK(s.document.quit);
}

TEST_CASE("an expectation that does not hold ends a script with its line") {
  TestSession s(test::one_tet());
  CHECK_THROWS_WITH_AS(run_script(s.session, "\nexpect(state().tets == 2, \"two tets\")", "t"),
                       doctest::Contains("t:2: expected: two tets"), Error);
  CHECK_THROWS_WITH_AS(run_script(s.session, "expect(nil)", "t"), doctest::Contains("t:1"), Error);
  CHECK_THROWS_WITH_AS(run_script(s.session, "explode()", "t"), doctest::Contains("explode"),
                       Error);
}

TEST_CASE("commands without a mesh are refused or do nothing") {
  test::BlankHost host;
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    if (command.name == "screenshot") continue;
    Document document;
    document.resize({20, 20});
    Session session{document, host};
    try {
      command.run(session, nlohmann::json::array());
    } catch (const Error&) {
    }
    CHECK(document.scene().surface.empty());
  }
}

TEST_CASE("whatever a command throws becomes a message") {
  TestSession s(test::one_tet());
  CHECK(guarded(s.document, [] {}));
  CHECK_FALSE(guarded(s.document, [] { throw std::filesystem::filesystem_error("no path", {}); }));
  CHECK(s.document.message.is_error);
  CHECK(s.document.message.text.find("no path") != std::string::npos);
  CHECK_FALSE(guarded(s.document, [] { throw std::bad_alloc(); }));
  CHECK(s.document.message.text == "out of memory");
}

TEST_CASE("a picture without a name replaces none") {
  const test::TempFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  TestSession s(test::one_tet());
  for (int i = 0; i < 3; ++i) s.run("screenshot", nlohmann::json::array());
  CHECK(s.document.message.text == "wrote tetmend-view-3.png");
  for (const char* name : {"tetmend-view.png", "tetmend-view-2.png", "tetmend-view-3.png"}) {
    CHECK(std::filesystem::exists(name));
  }
  std::filesystem::current_path(before);
}

TEST_CASE("a script undoes and redoes changes of the view") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  run_script(s.session, R"lua(
    peel(1)
    shrink(0.2)
    undo_view()
    expect(view().shrink == 0 and view().peel == 1, "one back")
    undo_view()
    expect(view().peel == 0, "two back")
    redo_view()
    redo_view()
    expect(view().shrink > 0, "and on again")
  )lua",
             "test");
  CHECK_THROWS_WITH_AS(s.run("redo_view"), doctest::Contains("no view after"), Error);
}

TEST_CASE("go_to selects what it is told and shows it in the middle") {
  TestSession s(test::shell_mesh({.degree = 6}));
  CHECK(s.run("go_to", {"edge 0-1"})["kind"] == "edge");
  CHECK(s.run("go_to", {"vertex 3"})["vertex"] == 3);
  CHECK(s.run("go_to", {"4"})["tet"] == 4);
  const nlohmann::json at = s.run("locate");
  CHECK(static_cast<double>(at["x"]) == doctest::Approx(200).epsilon(0.02));
  CHECK_THROWS_WITH_AS(s.run("go_to", {"edge 0"}), doctest::Contains("edge FROM TO"), Error);
  CHECK_THROWS_WITH_AS(s.run("go_to", {"shell 0 1"}), doctest::Contains("not understood"), Error);
  CHECK_THROWS_WITH_AS(s.run("go_to", {"tet 99"}), doctest::Contains("from 0 to 5"), Error);
  s.run("go_to", nlohmann::json::array());
  CHECK(s.document.ask_place);
}

TEST_CASE("the worst tet is shown alone, and Escape brings the mesh back") {
  TestSession s(test::delaunay_ball(100, 1));
  const std::size_t all = s.document.scene().tets_shown;
  s.run("look_from", {"+y"});
  const Camera before = s.document.view.camera;
  s.run("worst", nlohmann::json::array());
  CHECK(s.document.scene().tets_shown == 1);
  CHECK_FALSE(s.document.view.camera == before);
  s.run("next_worst");
  s.run("deselect");
  CHECK(s.document.scene().tets_shown == all);
  CHECK(s.document.view.camera == before);  // and not at the tet, in the midst of the others
  s.run("look_from", {"-z"});
  const Camera other = s.document.view.camera;
  s.run("deselect");
  CHECK(s.document.view.camera == other);
  s.run("select_vertex", {5});
  CHECK(s.document.scene().tets_shown == all);
  s.run("isolate");
  const std::size_t ball = s.document.scene().tets_shown;
  CHECK(ball > 1);
  CHECK(ball < all);
}

TEST_CASE("what a selection names can be pointed at, and it has numbers in the picture") {
  TestSession s(test::shell_mesh({.degree = 6}));
  s.run("select_edge", {0, 1});
  const auto& names = s.document.names();
  REQUIRE(names.size() == 8);
  CHECK(names[0] == NamedVertex{VertexHandle(0), "a"});
  CHECK(names[1] == NamedVertex{VertexHandle(1), "b"});
  CHECK(names[2].role == "p1");
  CHECK(names[7].role == "p6");
  s.run("fit");
  const auto pixel = [&](unsigned v) {
    const Point& p = s.document.mesh().point(VertexHandle(v));
    return *s.document.view.camera.project({p.x(), p.y(), p.z()}, s.document.canvas);
  };
  const glm::dvec2 a = pixel(0);
  const glm::dvec2 b = pixel(1);
  CHECK(s.document.find_named(a.x + 2, a.y, 8).vertices == std::vector{VertexHandle(0)});
  CHECK(s.document.find_named((a.x + b.x) / 2, (a.y + b.y) / 2 + 1, 8).vertices.size() == 2);
  CHECK(s.document.find_named(1, 1, 8).is_nothing());
  s.run("point_at", {"edge 0 1"});
  CHECK(state_of(s.document)["pointed"] == nlohmann::json{0, 1});
  CHECK_THROWS_WITH_AS(s.run("point_at", {"edge 0"}), doctest::Contains("not understood"), Error);
  CHECK_THROWS_WITH_AS(s.run("point_at", {"vertex 99"}), doctest::Contains("no vertex 99"), Error);
  s.run("point_at", nlohmann::json::array());
  CHECK(s.document.pointed().is_nothing());
}
