// SPDX-License-Identifier: MIT
// Texts and JSON of mesh statistics.
#include "apps/report.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "kernel/quality.h"

using namespace tetmend;

namespace {

MeshStatistics example() {
  MeshStatistics s;
  s.tets = 1095604;
  s.vertices = 204056;
  s.boundary_triangles = 124810;
  s.volume = 621943759.197;
  s.theta_min = 0.0193192;
  s.theta_max = 179.92608;
  s.lambda = 5.739;
  s.lambda_bands = {0.214, 0.582, 1.01, 1.58, 2.353};
  s.q_worst = 0.0003372;
  s.q_mean = 0.69626;
  s.n_bad = 124730;
  s.q_aver = 0.3594;
  for (std::size_t i = 0; i < s.histogram.size(); ++i) s.histogram[i] = 1000 * (i + 1) * (36 - i);
  return s;
}

/// As `example` after a good run: all bad angles but one are gone.
MeshStatistics improved() {
  MeshStatistics s = example();
  s.theta_min = 9.5;
  s.theta_max = 152;
  s.lambda = 1e-5;
  s.lambda_bands = {0, 1e-5, 0, 0, 0};
  s.q_worst = 0.165;
  s.n_bad = 1;
  s.q_aver = 0.165;
  std::fill(s.histogram.begin(), s.histogram.begin() + 6, 0u);
  std::fill(s.histogram.begin() + 30, s.histogram.end(), 0u);
  s.histogram[1] = 1;
  return s;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

/// Blanks between the words of a line reduced to one each.
std::string squeezed(const std::string& line) {
  std::istringstream stream(line);
  std::string result;
  for (std::string word; stream >> word;) result += result.empty() ? word : " " + word;
  return result;
}

bool has_line(const std::string& text, const std::string& expected) {
  const auto all = lines(text);
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& line) { return squeezed(line) == expected; });
}

void check_layout(const std::string& text) {
  REQUIRE(!text.empty());
  CHECK(text.back() == '\n');
  for (const std::string& line : lines(text)) {
    CAPTURE(line);
    CHECK(line.size() <= 80);
    CHECK((line.empty() || line.back() != ' '));
    CHECK(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; }));
  }
}

}  // namespace

TEST_CASE("the comparison shows every figure before and after") {
  const std::string text = format_comparison(example(), improved());
  CHECK(has_line(text, "measure before after"));
  CHECK(has_line(text, "tets 1,095,604 1,095,604"));
  CHECK(has_line(text, "points 204,056 204,056"));
  CHECK(has_line(text, "theta_min, degrees 0.0193 9.5000"));
  CHECK(has_line(text, "theta_max, degrees 179.9261 152.0000"));
  CHECK(has_line(text, "lambda % (<= 30 or >= 150) 5.7390 1e-05"));
  CHECK(has_line(text, "lambda_1 % (0-6, 174-180) 0.2140 0"));
  CHECK(has_line(text, "lambda_2 % (6-12, 168-174) 0.5820 1e-05"));
  CHECK(has_line(text, "lambda_5 % (24-30, 150-156) 2.3530 0"));
  CHECK(has_line(text, "bad tets (miss the goal) 124,730 1"));
  CHECK(has_line(text, "q_worst (min sine) 0.00034 0.16500"));
  CHECK(has_line(text, "q_aver (bad tets) 0.35940 0.16500"));
  CHECK(has_line(text, "volume 621943759.197 621943759.197"));
}

TEST_CASE("the rows of a table are equally wide and the numbers stand to the right") {
  const std::string text = format_comparison(example(), improved());
  check_layout(text);
  std::set<std::size_t> widths;
  for (const std::string& line : lines(text)) widths.insert(line.size());
  CHECK(widths.size() == 1);
}

TEST_CASE("inverted and flat tets appear only when one of the meshes has some") {
  MeshStatistics broken = example();
  CHECK(format_comparison(broken, example()).find("inverted") == std::string::npos);
  CHECK(format_comparison(broken, example()).find("flat") == std::string::npos);
  broken.inverted = 12;
  broken.flat = 3;
  CHECK(has_line(format_comparison(broken, example()), "inverted tets 12 0"));
  CHECK(has_line(format_comparison(broken, example()), "flat tets 3 0"));
  CHECK(has_line(format_statistics(broken), "flat tets 3"));
}

TEST_CASE("a small number that is not zero never prints as zero") {
  MeshStatistics s = example();
  s.theta_min = 2.6e-13;
  s.q_worst = -4.5e-15;
  s.lambda_bands[0] = 6.3e-5;
  const std::string text = format_statistics(s);
  CHECK(has_line(text, "theta_min, degrees 2.6e-13"));
  CHECK(has_line(text, "q_worst (min sine) -4.5e-15"));
  CHECK(has_line(text, "lambda_1 % (0-6, 174-180) 6.3e-05"));
}

TEST_CASE("the table of one mesh has a row for every further measure") {
  const std::array<MeasureSummary, 2> extra = {{
      {"radius_ratio", 1.25e-7, 0.75},
      {"min_angle", -3.5, 41.25},
  }};
  const std::string text = format_statistics(example(), extra);
  check_layout(text);
  CHECK(has_line(text, "tets 1,095,604"));
  CHECK(has_line(text, "radius_ratio, worst 1.25e-07"));
  CHECK(has_line(text, "radius_ratio, mean 0.75000"));
  CHECK(has_line(text, "min_angle, worst -3.50000"));
  CHECK(format_statistics(example()).find("radius_ratio") == std::string::npos);
}

TEST_CASE("tables of extreme numbers keep to 80 columns") {
  MeshStatistics s = example();
  s.tets = s.vertices = 4000000000u;
  s.volume = -1.2345678901234567e-301;
  s.theta_min = -std::numeric_limits<double>::infinity();
  s.q_mean = -std::numeric_limits<double>::quiet_NaN();
  s.q_aver = 1e300;
  s.histogram.fill(24000000000u);
  check_layout(format_comparison(s, s));
  check_layout(format_histogram(s, &s));
  CHECK(has_line(format_statistics(s), "q_mean (all tets) nan"));
}

TEST_CASE("the histogram has 18 rows that together count every angle") {
  const MeshStatistics s = example();
  const std::string text = format_histogram(s, nullptr);
  check_layout(text);
  const auto all = lines(text);
  REQUIRE(all.size() == 20);
  CHECK(all[0].find("logarithmic") != std::string::npos);
  CHECK(squeezed(all[1]) == "degrees angles");
  CHECK(squeezed(all[2]).starts_with("0-10 106,000 #"));  // 36 + 70 thousand
  CHECK(squeezed(all[19]).starts_with("170-180 106,000 #"));
}

TEST_CASE("a single angle among millions has a bar, an empty bin has none") {
  const MeshStatistics before = example();
  const MeshStatistics after = improved();
  const std::string text = format_histogram(before, &after);
  check_layout(text);
  const auto all = lines(text);
  REQUIRE(all.size() == 20);
  CHECK(squeezed(all[1]) == "degrees before after");
  CHECK(squeezed(all[2]).ends_with("## 1 #"));
  CHECK(all[19].ends_with(" 0"));
}

TEST_CASE("both meshes of a histogram share one scale") {
  MeshStatistics few{};
  few.histogram[10] = 10;
  MeshStatistics many{};
  many.histogram[10] = 1000;
  const std::string row = lines(format_histogram(few, &many))[7];
  const std::string words = squeezed(row);
  const std::size_t second = words.find(" 1,000 ");
  REQUIRE(second != std::string::npos);
  const auto short_bar = std::count(words.begin(), words.begin() + static_cast<int>(second), '#');
  const auto long_bar = std::count(words.begin() + static_cast<int>(second), words.end(), '#');
  CHECK(short_bar > 1);
  CHECK(long_bar > 2 * short_bar);
}

TEST_CASE("the histogram of an empty mesh has no bars") {
  const std::string text = format_histogram(MeshStatistics{}, nullptr);
  CHECK(text.find('#') == std::string::npos);
  CHECK(lines(text).size() == 20);
}

TEST_CASE("JSON has the names and the values of the fields") {
  const MeshStatistics s = example();
  const nlohmann::json json = nlohmann::json::parse(to_json(s).dump());
  CHECK(json.at("tets") == s.tets);
  CHECK(json.at("vertices") == s.vertices);
  CHECK(json.at("boundary_triangles") == s.boundary_triangles);
  CHECK(json.at("inverted") == 0);
  CHECK(json.at("flat") == 0);
  CHECK(json.at("volume") == s.volume);
  CHECK(json.at("theta_min") == s.theta_min);
  CHECK(json.at("theta_max") == s.theta_max);
  CHECK(json.at("lambda") == s.lambda);
  CHECK(json.at("lambda_bands") == s.lambda_bands);
  CHECK(json.at("q_worst") == s.q_worst);
  CHECK(json.at("q_mean") == s.q_mean);
  CHECK(json.at("n_bad") == s.n_bad);
  CHECK(json.at("q_aver") == s.q_aver);
  CHECK(json.at("histogram") == s.histogram);
  CHECK(json.size() == 15);
}

TEST_CASE("numbers that are not finite become null in JSON") {
  MeshStatistics s = example();
  s.volume = std::numeric_limits<double>::infinity();
  s.lambda = std::numeric_limits<double>::quiet_NaN();
  s.lambda_bands[2] = -std::numeric_limits<double>::infinity();
  const nlohmann::json built = to_json(s);
  CHECK(built.at("volume").is_null());
  CHECK(built.at("lambda").is_null());
  CHECK(built.at("lambda_bands")[2].is_null());
  CHECK(nlohmann::json::parse(built.dump()) == built);
}

TEST_CASE("the table of rulers has worst, 1 % and mean, of two meshes beside each other") {
  MeshRulers before;
  before.figures.fill({0.123456, 2127.736086, -1.924043224e-06});
  before.figures[static_cast<std::size_t>(Ruler::condition)].worst =
      std::numeric_limits<double>::infinity();
  before.faces_above_70 = 1234567;
  before.work = 5e6;
  MeshRulers after = before;
  after.figures[0].worst = 0.5;
  after.faces_above_70 = 7;
  const std::string one = format_rulers(before, nullptr);
  check_layout(one);
  CHECK(has_line(one, "measures of other programs worst 1 % mean"));
  CHECK(has_line(one, "mean ratio 0.1235 2128 -1.9e-06"));
  CHECK(has_line(one, "condition number (VTK) inf 2128 -1.9e-06"));
  CHECK(has_line(one, "faces above 70 degrees 1234567"));
  CHECK(has_line(one, "work, tets x CG steps 5e+06"));
  CHECK(lines(one).size() == kRulerCount + 3 + kSolverRulers.size());
  const std::string two = format_rulers(before, &after);
  check_layout(two);
  CHECK(has_line(two, "before after before after before after"));
  CHECK(has_line(two, "mean ratio 0.1235 0.5 2128 2128 -1.9e-06 -1.9e-06"));
  CHECK(has_line(two, "faces above 70 degrees 1234567 7"));
}

TEST_CASE("rulers as JSON have their names, and null for what is infinite") {
  MeshRulers rulers;
  rulers.inner_faces = 9;
  rulers.faces_above_70 = 2;
  rulers.work = 600;
  rulers.figures[0] = {0.25, 0.5, 0.75};
  rulers.figures[4].worst = std::numeric_limits<double>::infinity();
  const nlohmann::json json = nlohmann::json::parse(to_json(rulers).dump());
  CHECK(json.size() == kRulerCount + 3 + kSolverRulers.size());
  CHECK(json.at("work") == 600);
  CHECK(json.at("inner_faces") == 9);
  CHECK(json.at("faces_above_70") == 2);
  CHECK(json.at("mean_ratio") ==
        nlohmann::json({{"worst", 0.25}, {"one_percent", 0.5}, {"mean", 0.75}}));
  CHECK(json.at("condition").at("worst").is_null());
}

TEST_CASE("the limit is told with bounds rounded outward, and the bad tets by what holds them") {
  SurfaceLimit limit;
  limit.n_bad = 1014;
  limit.n_forced = 12;
  limit.theta_min = 10.0011;
  limit.theta_max = 165.2099;
  limit.bad = {3, 12, 0, 2, 1000};
  CHECK(format_limit(limit) ==
        "limit                at least 12 of the 1,014 bad tets are forced by the surface\n"
        "                     theta_min is 10.01 at most, theta_max is 165.20 at least\n"
        "bad tets             3 protected\n"
        "                     12 where the surface forces one\n"
        "                     2 without a free vertex\n"
        "                     1,000 that nothing is known to hold\n");
  limit = {};
  limit.n_bad = 1;
  limit.bad[4] = 1;
  CHECK(format_limit(limit) ==
        "limit                no bad tet is known to be forced by the surface\n"
        "bad tets             1 that nothing is known to hold\n");
}

TEST_CASE("a bound that is not known is null in JSON, and bad tets are listed by hindrance") {
  SurfaceLimit limit;
  limit.n_bad = 14;
  limit.n_forced = 12;
  limit.theta_min = 10.5;
  limit.bad = {0, 12, 0, 1, 1};
  const nlohmann::json json = nlohmann::json::parse(to_json(limit).dump());
  CHECK(json.at("n_bad") == 14);
  CHECK(json.at("n_forced") == 12);
  CHECK(json.at("theta_min") == 10.5);
  CHECK(json.at("theta_max").is_null());
  CHECK(json.at("q_worst").is_null());
  CHECK(json.at("bad").size() == kHindranceCount);
  CHECK(json.at("bad").at("surface") == 12);
  CHECK(json.at("bad").at("search") == 1);
  CHECK(json.size() == 6);
}
