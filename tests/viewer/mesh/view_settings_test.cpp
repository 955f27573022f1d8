// SPDX-License-Identifier: MIT
#include "viewer/mesh/view_settings.h"

#include <doctest/doctest.h>

#include "kernel/error.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("a view written as JSON and read again is the same") {
  ViewSettings view;
  view.camera.target = {1.0 / 3, -2, 1e-7};
  view.camera.orthographic = true;
  view.scene.cuts[1] = {true, true, {1, 2, 3}, -0.25};
  view.scene.filtered = true;
  view.scene.range = {0.1, 0.2};
  view.scene.peel = 3;
  view.scene.hidden_regions = {4, -1};
  view.theme = "dark";
  view.background = Background::transparent;
  view.colour_bar = true;
  view.title = "Figure 3";
  ViewSettings copy;
  apply_json_text(copy, to_json(view).dump());
  CHECK(copy == view);
}

TEST_CASE("a patch changes what it names and nothing else") {
  ViewSettings view;
  view.scene.peel = 2;
  ViewSettings wanted = view;
  wanted.scene.cuts[0].position = 0.5;
  apply_json_text(view, R"({"cut_1": {"position": 0.5}})");
  CHECK(view == wanted);
}

TEST_CASE("a wrong patch is refused in words, and changes nothing") {
  struct Case {
    const char* patch;
    const char* message;
  };
  for (const Case& c : {Case{R"({"peel": 1, "peal": 2})", "no setting 'peal': expected one of"},
                        Case{R"({"cut_1": {"pos": 1}})", "'cut_1.pos'"},
                        Case{R"({"shrink": 2})", "shrink must be from 0 to 0.9, not 2"},
                        Case{R"({"edges": 1})", "edges must be true or false, not 1"},
                        Case{R"({"colour": "speed"})", "unknown quality measure 'speed'"},
                        Case{R"({"map": "jet"})", "no colour map 'jet'"},
                        Case{R"({"theme": "blue"})", "expected light or dark"},
                        Case{R"({"background": "blue"})", "one of gradient, white, transparent"},
                        Case{R"({"background": 1})", "one of gradient, white, transparent"},
                        Case{R"({"cut_2": {"normal": [0, 0, 0]}})", "normal"},
                        Case{R"({"range": [2, 1]})", "the smaller number first"},
                        Case{"[1]", "a table of settings"}, Case{"{", "no JSON text"}}) {
    CAPTURE(c.patch);
    ViewSettings view;
    CHECK_THROWS_WITH_AS(apply_json_text(view, c.patch), doctest::Contains(c.message), Error);
    CHECK(view == ViewSettings());
  }
}
