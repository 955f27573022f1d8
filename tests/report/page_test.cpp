// SPDX-License-Identifier: MIT
// The page of a real run, as text.
#include "report/page.h"

#include <regex>

#include <doctest/doctest.h>

#include "tests/support/text.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;
using nlohmann::json;
using tetmend::test::contains;

namespace {

/// All texts of it are `text`.
json report_of(const std::string& text) {
  const json mesh = {{"n_bad", 1}, {"theta_min", nullptr}, {"histogram", json::array({1, 2})}};
  return {{"tetmend", text},
          {"arguments", {text, text}},
          {"input", text},
          {"output", text},
          {"schedule", text},
          {"settings", {{text, text}}},
          {"notes", {text}},
          {"data", {{{"name", text}, {"on", text}, {"rule", text}, {"integral_error", 0.5}}}},
          {"worse_than_before", {text}},
          {"before", mesh},
          {"after", mesh},
          {"goal", {{"min_angle", 30.0}, {"max_angle", 150.0}}},
          {"passes", {{{"name", text}, {"seconds", 1.0}}}},
          {"worst_tets",
           {{{"tet", nullptr},
             {"reason", text},
             {"centre", {0, 0, 0}},
             {"corners", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
             {"may_move", {true, true, false, false}}}}}};
}

face::Portrait small_portrait() {
  const TetMesh mesh = test::make_mesh(contract::kuhn_cube(3, 0.4, 1));
  face::Portrait portrait;
  portrait.draw_before(mesh, std::nullopt);
  portrait.draw_after(mesh, {}, std::nullopt);
  return portrait;
}

}  // namespace

TEST_CASE("texts of a report are texts on its page, whatever they say") {
  const std::string bad =
      "</script><script>alert('x')</script><img src=x onerror=alert(1)>&\"\xff@SHAPE@";
  const std::string page = report::write_page(report_of(bad), small_portrait());
  CHECK(count_of(page, "<script") == 3);  // about the shape, the shape, the script
  CHECK(count_of(page, "</script>") == 3);
  CHECK(count_of(page, "<img") == 0);
  CHECK(count_of(page, "\xff") == 0);
  CHECK(contains(page, "&lt;img src=x"));
}

TEST_CASE("a page asks nobody for anything, and all its places are filled in") {
  const std::string page = report::write_page(report_of("a"), small_portrait());
  CHECK(contains(page, "default-src 'none'"));
  const std::regex load(R"((src|href)\s*=|url\(|@import|fetch\(|XMLHttpRequest|import\()");
  CHECK(!std::regex_search(page, load));
  CHECK(!std::regex_search(page, std::regex("@[A-Z_]+@")));
}

TEST_CASE("what is left out of the picture is said") {
  const face::Portrait portrait = small_portrait();
  const std::string whole = report::write_page(report_of("a"), portrait);
  CHECK(!contains(whole, "too many for a page"));
  const std::string less =
      report::write_page(report_of("a"), portrait, {.triangles = 10, .tets = 1});
  CHECK(contains(less,
                 "The surface has 108 triangles, too many for a page: only 36 of its sharp "
                 "edges are drawn."));
  CHECK(contains(less, " bad tets before the worst 1 are drawn."));
}
