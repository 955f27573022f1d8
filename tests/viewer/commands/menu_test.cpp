// SPDX-License-Identifier: MIT
#include "viewer/commands/menu.h"

#include <set>

#include <doctest/doctest.h>

#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

TEST_CASE("entries of menus are short, each another, and no sentences for scripts") {
  std::set<std::string> texts;
  for (const Command& command : commands()) {
    if (command.menu.empty()) continue;
    const std::string text = menu_text(command);
    CAPTURE(text);
    CHECK(text.size() <= 32);
    CHECK(text.find("result") == std::string::npos);
    CHECK(text.find(';') == std::string::npos);
    CHECK(texts.insert(text).second);
  }
}

TEST_CASE("what would only complain is greyed: without a mesh, a trace, a lesson or a run") {
  const auto is_on = [](std::string_view name, Document& document) {
    return is_possible(find_command(name), document);
  };
  Document empty;
  CHECK(is_on("open", empty));
  CHECK(is_on("quit", empty));
  for (const char* name : {"save", "worst", "step_into", "live_run", "live_stop", "isolate"}) {
    CHECK_FALSE(is_on(name, empty));
  }
  TestSession mesh(test::one_tet());
  CHECK(is_on("save", mesh.document));
  CHECK(is_on("live_run", mesh.document));
  CHECK_FALSE(is_on("live_stop", mesh.document));
  CHECK_FALSE(is_on("step_into", mesh.document));
  CHECK_FALSE(is_on("deselect", mesh.document));
  mesh.run("select_tet", {0});
  CHECK(is_on("deselect", mesh.document));
  const test::HandmadeTrace trace;
  mesh.document.open(trace.path());
  CHECK(is_on("step_into", mesh.document));
  CHECK_FALSE(is_on("next_lesson_step", mesh.document));
  CHECK_FALSE(is_on("next_bookmark", mesh.document));
  mesh.run("bookmark", {"here"});
  CHECK(is_on("next_bookmark", mesh.document));
}

TEST_CASE("in a menu a line stands between entries of different kinds, at the latest after nine") {
  for (const std::string_view menu : {"File", "View", "Show", "Select", "Trace", "Run"}) {
    CAPTURE(menu);
    int in_a_row = 0, lines = 0;
    for (const Command& command : commands()) {
      if (command.menu != menu) continue;
      if (begins_group(command)) {
        CHECK(in_a_row > 0);  // no line on top, nor two in a row
        in_a_row = 0;
        ++lines;
      }
      CHECK(++in_a_row <= 9);
    }
    CHECK(lines > 0);
  }
}
