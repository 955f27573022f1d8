// SPDX-License-Identifier: MIT
// Sentences and promises, from reports as JSON.
#include "report/verdict.h"

#include <algorithm>
#include <regex>

#include <doctest/doctest.h>

#include "report/progress_chart.h"
#include "report/repeat.h"
#include "report/worst_tets.h"
#include "tests/support/text.h"

using namespace tetmend::report;
using nlohmann::json;
using tetmend::test::contains;

namespace {

json statistics(std::size_t n_bad, double theta_min, double theta_max) {
  return {{"tets", 1000},           {"vertices", 300},           {"boundary_triangles", 200},
          {"theta_min", theta_min}, {"theta_max", theta_max},    {"n_bad", n_bad},
          {"lambda", 1.5},          {"histogram", json::array()}};
}

json example_report() {
  return {
      {"before", statistics(40, 2.5, 171.25)},
      {"after", statistics(0, 30.5, 148)},
      {"goal", {{"min_angle", 30.0}, {"max_angle", 150.0}}},
      {"interrupted", false},
      {"out_of_time", false},
      {"limit", {{"n_forced", 0}, {"bad", json::object()}}},
      {"worse_than_before", json::array()},
      {"not_positive_tets", {{"before", 0}, {"after", 0}}},
      {"volume_change", 1e-16},
      {"surface", {{"unchanged", true}, {"fingerprint_before", "ab"}, {"fingerprint_after", "ab"}}},
      {"passes", json::array()}};
}

/// Without markup.
std::string plain(const std::string& html) {
  return std::regex_replace(html, std::regex("<[^>]*>"), "");
}

std::string sentence(const json& report) {
  return plain(verdict_of(Figures(report)).sentence);
}

}  // namespace

TEST_CASE("a goal that is reached") {
  const json report = example_report();
  CHECK(verdict_of(Figures(report)).outcome == Outcome::reached);
  CHECK(sentence(report) ==
        "The goal of 30 to 150 degrees is reached: all 40 bad tets are gone. The smallest angle "
        "was 2.50 degrees and is 30.50, the largest was 171.25 and is 148.00; the surface is "
        "untouched.");
}

TEST_CASE("a goal that is missed, and who is to blame") {
  json report = example_report();
  report["after"] = statistics(1, 7.25, 160);
  CHECK(verdict_of(Figures(report)).outcome == Outcome::missed);
  CHECK(sentence(report).starts_with(
      "1 of 40 bad tets is left and misses the goal of 30 to 150 degrees. "));
  report["after"] = statistics(12, 7.25, 160);
  report["limit"]["n_forced"] = 3;
  CHECK(
      sentence(report).starts_with("12 of 40 bad tets are left and miss the goal of 30 to 150 "
                                   "degrees; the surface forces at least 3 of them. "));
}

TEST_CASE("a mesh with nothing bad, a run that was stopped, tets that stay inverted") {
  json report = example_report();
  report["before"] = statistics(0, 31, 140);
  CHECK(sentence(report).starts_with("No tet missed the goal"));
  report["interrupted"] = true;
  CHECK(sentence(report).starts_with("The run was interrupted, and this is how far it came: "));
  CHECK(verdict_of(Figures(report)).outcome == Outcome::interrupted);
  report["interrupted"] = false;
  report["out_of_time"] = true;
  CHECK(sentence(report).starts_with("The time limit stopped the run"));
  report["not_positive_tets"] = {{"before", 9}, {"after", 2}};
  CHECK(contains(sentence(report), "; 2 of 9 inverted or flat tets are left. "));
}

TEST_CASE("each number of a sentence says where it stands, and what it is exactly") {
  json report = example_report();
  report["before"]["theta_min"] = 2.0 / 3;
  CHECK(contains(verdict_of(Figures(report)).sentence,
                 R"(<data data-of="before.theta_min" value="0.6666666666666666">0.67</data>)"));
}

TEST_CASE("promises are kept unless the report says what is worse") {
  json report = example_report();
  report["before"]["rulers"] = {{"mean_ratio", {{"worst", 0.1}}}};
  report["after"]["rulers"] = {{"mean_ratio", {{"worst", 0.2}}}};
  const auto broken = [&] {
    std::vector<std::string> texts;
    for (const Promise& promise : promises_of(Figures(report))) {
      if (!promise.is_kept) texts.push_back(promise.text);
    }
    return texts;
  };
  CHECK(broken().empty());
  report["worse_than_before"] = {"a worst mean ratio of 0.05 instead of 0.1", "a lambda of 3"};
  CHECK(broken() == std::vector<std::string>{"No larger share of bad angles, in percent",
                                             "No worse mean ratio of the worst tet"});
  report["worse_than_before"] = json::array();
  report["surface"]["fingerprint_after"] = "ac";
  CHECK(broken().size() == 1);
  report["surface"]["fingerprint_after"] = "ab";
  report["not_positive_tets"]["after"] = 1;
  CHECK(broken().size() == 1);
  report["worse_than_before"] = {"a mean <ratio>"};
  CHECK(broken().size() == 1);
  CHECK(contains(promise_table(Figures(report)), "<li>a mean &lt;ratio&gt;</li>"));
}

TEST_CASE("an angle that fell for mended tets is no broken promise, and is listed as worse") {
  json report = example_report();
  report["worse_than_before"] = {"a theta_min of 0.5 instead of 2.5"};
  const auto table = [&] { return promise_table(Figures(report)); };
  CHECK(contains(table(), "\u2717 broken"));
  report["not_positive_tets"] = {{"before", 9}, {"after", 0}};
  CHECK_FALSE(contains(table(), "\u2717 broken"));
  CHECK(contains(table(), "\u2717 worse, for mended tets"));
  CHECK(contains(table(), "<li>a theta_min of 0.5 instead of 2.5</li>"));
  report["worse_than_before"] = {"a lambda of 3 instead of 2"};
  CHECK(contains(table(), "\u2717 broken"));
}

TEST_CASE(
    "a surface that may move has its tolerance and the proven bound under headings of its own") {
  json report = example_report();
  const auto heads = [&] { return plain(promise_table(Figures(report))); };
  CHECK(!contains(heads(), "tolerance"));
  report["surface"]["tolerance"] = 0.0245;
  report["surface"]["proven_distance"] = 0.0229;
  CHECK(contains(heads(),
                 "promisetolerancemoved at most\nThe surface stays within its tolerance, "
                 "proven in both directions0.02450.0229\u2713 kept"));
  CHECK(contains(heads(), "promisebeforeafter\nNo more inverted"));
  report["surface"]["proven_distance"] = 0.0246;
  CHECK(contains(heads(), "0.0246\u2717 broken"));
}

TEST_CASE("the name of a pass of many operators is folded") {
  json report = example_report();
  const auto table = [&](const char* name) {
    report["passes"] = {{{"name", name},
                         {"round", 1},
                         {"seconds", 0.25},
                         {"attempts", 1},
                         {"accepted", 1},
                         {"n_bad", 25},
                         {"q_worst", 0.5}}};
    return pass_table(Figures(report));
  };
  CHECK(!contains(table("sequence(a, b, c, d)"), "<details>"));
  CHECK(contains(table("sequence(a, b, c, d, e)"),
                 "<details><summary>sequence of 5 operators, a first</summary>"
                 "sequence(a, b, c, d, e)</details>"));
}

TEST_CASE("passes of one name are summed up, and protected bad tets are nobody's work") {
  json report = example_report();
  const auto pass = [](const char* name, unsigned attempts, unsigned n_bad) {
    return json{{"name", name},
                {"round", 1},
                {"seconds", 0.25},
                {"attempts", attempts},
                {"accepted", attempts / 2},
                {"n_bad", n_bad},
                {"q_worst", 0.5}};
  };
  report["passes"] = {pass("smooth", 1000, 25), pass("reconnect", 10, 20), pass("smooth", 500, 21)};
  report["protected"] = {{"bad_tets", 4}};
  const std::string table = pass_table(Figures(report));
  CHECK(plain(table).find("smooth21,500750100.500") != std::string::npos);  // 36 - 25 + 20 - 21
  const std::string chart = progress_chart(Figures(report));
  CHECK(contains(chart,
                 "<title>smooth, round 1: 0.25 s; 1,000 tried, 500 kept; bad tets 36 to 25; "
                 "worst quality 0.5</title>"));
  CHECK(progress_chart(Figures(example_report())).empty());
}

TEST_CASE("words of a command are quoted where a shell would take them apart") {
  CHECK(shell_line({"tetmend", "improve", "a b.mesh", "--set", "goal=20", "it's", ""}) ==
        R"(tetmend improve 'a b.mesh' --set goal=20 'it'\''s' '')");
}

TEST_CASE("the picture of a tet marks the edges that miss the goal, and who may move") {
  using Eigen::Vector3d;
  const std::array<Vector3d, 4> regular = {Vector3d(1, 1, 1), Vector3d(1, -1, -1),
                                           Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)};
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
      ++found;
    }
    return found;
  };
  const std::string good = tet_picture(regular, {true, false, false, false}, {30, 150});
  CHECK(count(good, "edge bad") == 0);
  CHECK(count(good, "class=\"edge\"") == 6);
  CHECK(count(good, "class=\"free\"") == 1);
  CHECK(contains(good, "70.5\u00b0"));
  // Two opposite edges of a sliver have large angles, the four others small ones.
  const std::array<Vector3d, 4> sliver = {Vector3d(1, 0, 0.01), Vector3d(-1, 0, 0.01),
                                          Vector3d(0, 1, 0), Vector3d(0, -1, 0)};
  CHECK(count(tet_picture(sliver, {}, {30, 150}), "edge bad") == 6);
  const std::array<Vector3d, 4> point = {Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(1, 1, 1),
                                         Vector3d(1, 1, 1)};
  CHECK(!contains(tet_picture(point, {}, {30, 150}), "nan"));
}
