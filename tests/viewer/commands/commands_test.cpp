// SPDX-License-Identifier: MIT
#include "viewer/commands/commands.h"

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
  const std::string manual = test::read_text(TETMEND_SOURCE_DIR "/docs/viewer.md");
  CHECK_MESSAGE(manual.find(command_reference()) != std::string::npos,
                "put the output of tetmend-view --keys into docs/viewer.md");
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
  CHECK_THROWS_WITH_AS(s.run("pick_kind", {"face"}), doctest::Contains("nearest, tet"), Error);
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
