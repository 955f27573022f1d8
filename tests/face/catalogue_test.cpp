// SPDX-License-Identifier: MIT
// What there is to improve a mesh with.
#include <algorithm>

#include <doctest/doctest.h>
#include <tetmend/catalogue.h>

#include "tests/face/meshes.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("schedules are listed with their parameters, the default first") {
  const std::vector<ScheduleInfo> all = schedules();
  REQUIRE(all.size() >= 3);
  CHECK(all.front().name == "shell");
  for (const ScheduleInfo& info : all) {
    CAPTURE(info.name);
    CHECK(!info.description.empty());
    CHECK(describe_schedule(info.name).parameters.size() == info.parameters.size());
    CHECK(schedule_source(info.name).find("description") != std::string::npos);
  }
  const auto& parameters = describe_schedule("thorough").parameters;
  const auto rounds = std::find_if(parameters.begin(), parameters.end(),
                                   [](const auto& p) { return p.name == "max_rounds"; });
  REQUIRE(rounds != parameters.end());
  CHECK(!rounds->range().empty());
}

TEST_CASE("a script of one's own is described, and mistakes in it are told") {
  const TempFolder folder;
  const std::string file = (folder / "my.lua").string();
  write_text(file, "parameter{'n', default = 3, low = 1, high = 9}\nsmooth{}");
  CHECK(describe_schedule(file).parameters.at(0).range() == "1 to 9");
  write_text(file, "\nsmoth{}");
  CHECK(message_of([&] { describe_schedule(file); }).starts_with(file + ":2: "));
  CHECK(message_of([] { describe_schedule("varnish"); }).find("shell") != std::string::npos);
}

TEST_CASE("operators are listed with target, help and parameters") {
  const std::vector<OperatorDescription> all = operators();
  const auto smoothing = std::find_if(all.begin(), all.end(),
                                      [](const auto& info) { return info.name == "smoothing"; });
  REQUIRE(smoothing != all.end());
  CHECK(smoothing->target == "vertex");
  CHECK(!smoothing->help.empty());
  CHECK(smoothing->plugin.empty());
  const auto& parameters = smoothing->parameters;
  const auto steps = std::find_if(parameters.begin(), parameters.end(),
                                  [](const auto& p) { return p.name == "steps"; });
  REQUIRE(steps != parameters.end());
  CHECK(steps->kind == OperatorDescription::Parameter::Kind::integer);
  CHECK(steps->low <= steps->initial);
  CHECK(steps->initial <= steps->high);
  CHECK_THROWS_AS(operators({"nowhere.so"}), Error);
}
