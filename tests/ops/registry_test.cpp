// SPDX-License-Identifier: MIT
// The registry of operators and the checks of their parameters.
#include "ops/registry.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "ops/builtin_operators.h"
#include "tests/support/text.h"

using namespace tetmend;
using tetmend::test::contains;

namespace {

/// The message of the error that making the operator ends in; empty if there is none.
std::string error_of(const Registry& registry, std::string_view name,
                     const ParameterSettings& settings = {}) {
  try {
    registry.make(name, settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the builtin operators are listed in the order of registration, with help") {
  const Registry registry = Registry::builtin();
  REQUIRE(registry.operators().size() >= 2);
  CHECK(registry.operators()[0]->name == "shell_transformation");
  CHECK(registry.operators()[1]->name == "recursive_shell_transformation");
  for (const OperatorInfo* info : registry.operators()) {
    CAPTURE(info->name);
    CHECK_FALSE(info->help.empty());
    CHECK(&registry.find(info->name) == info);
    CHECK(&registry.make(info->name)->info() == info);
    for (const ParameterSpec& spec : info->parameters) {
      CAPTURE(spec.name);
      CHECK_FALSE(spec.help.empty());
      CHECK(spec.low < spec.high);
      CHECK(spec.initial >= spec.low);
      CHECK(spec.initial <= spec.high);
      if (spec.kind == ParameterSpec::Kind::flag) {
        CHECK(spec.low == 0);
        CHECK(spec.high == 1);
      }
      if (spec.kind != ParameterSpec::Kind::real) CHECK(spec.initial == std::floor(spec.initial));
    }
  }
}

TEST_CASE("an unknown operator is an error that lists the valid names") {
  const Registry registry = Registry::builtin();
  const std::string message = error_of(registry, "edge_removel");
  CHECK(contains(message, "'edge_removel'"));
  for (const OperatorInfo* info : registry.operators()) CHECK(contains(message, info->name));
  CHECK_THROWS_AS(registry.find(""), Error);
}

TEST_CASE("registering a name twice is an error that gives the name") {
  Registry registry = Registry::builtin();
  CHECK_THROWS_WITH_AS(registry.add(smoothing_info()), "operator 'smoothing' is registered twice",
                       Error);
  CHECK(registry.operators().size() == Registry::builtin().operators().size());
}

TEST_CASE("an operator knows the plugin that it comes from, and a clash names both sides") {
  static const OperatorInfo kInfo = {"polish", TargetKind::vertex, "help",
                                     smoothing_info().parameters, smoothing_info().make};
  static const OperatorInfo kSame = kInfo;
  Registry registry = Registry::builtin();
  registry.add(kInfo, "a.so");
  CHECK(registry.origin("polish") == "a.so");
  CHECK(registry.origin("smoothing").empty());
  CHECK(registry.make("smoothing")->origin().empty());
  CHECK_THROWS_WITH_AS(registry.add(kSame, "b.so"),
                       "operator 'polish' is registered twice: by a.so and by b.so", Error);
  CHECK_THROWS_WITH_AS(registry.add(smoothing_info(), "a.so"),
                       "operator 'smoothing' is registered twice: by tetmend itself and by a.so",
                       Error);
  CHECK(registry.operators().size() == Registry::builtin().operators().size() + 1);
  // A plugin's function that makes something else than it said.
  CHECK(contains(error_of(registry, "polish"), "'polish' of a.so cannot be made: "));
}

TEST_CASE("an operator that cannot be used is not registered, and the error says why") {
  using Kind = ParameterSpec::Kind;
  const OperatorInfo good = {"good", TargetKind::tet, "help", {}, smoothing_info().make};
  const auto complaint = [](const OperatorInfo& info) -> std::string {
    Registry registry;
    try {
      registry.add(info);
    } catch (const Error& error) {
      CHECK(registry.operators().empty());
      return error.what();
    }
    return "";
  };
  const auto with = [&](std::span<const ParameterSpec> parameters) {
    OperatorInfo info = good;
    info.parameters = parameters;
    return complaint(info);
  };
  CHECK(complaint(good) == "");
  OperatorInfo bad = good;
  bad.name = "Not A Name";
  CHECK(contains(complaint(bad), "'Not A Name': the name"));
  bad = good;
  bad.make = nullptr;
  CHECK(contains(complaint(bad), "no function that makes it"));
  bad = good;
  bad.help = "";
  CHECK(contains(complaint(bad), "no help"));
  bad = good;
  bad.target = static_cast<TargetKind>(4);
  CHECK(contains(complaint(bad), "kind of target"));
  using Specs = std::vector<ParameterSpec>;
  const double nan = std::nan("");
  CHECK(with(Specs{{"a", Kind::real, 0, 1, 0.5, "help"}}) == "");
  CHECK(contains(with(Specs{{"a b", Kind::real, 0, 1, 0.5, "help"}}), "'a b': the name"));
  CHECK(contains(with(Specs{{"a", Kind::real, 0, 1, 0.5, ""}}), "no help"));
  CHECK(contains(with(Specs{{"a", Kind::real, 1, 0, 0.5, "help"}}), "the range is empty"));
  CHECK(contains(with(Specs{{"a", Kind::real, 0, nan, 0.5, "help"}}), "the range is empty"));
  CHECK(contains(with(Specs{{"a", Kind::real, 0, 1, 2, "help"}}), "outside the range"));
  CHECK(contains(with(Specs{{"a", Kind::integer, 0, 1, 0.5, "help"}}), "not a whole number"));
  CHECK(contains(with(Specs{{"a", Kind::flag, 0, 2, 1, "help"}}), "range of a flag"));
  CHECK(contains(with(Specs{{"a", Kind::real, 0, 1, 0, "help"}, {"a", Kind::real, 0, 1, 0, "h"}}),
                 "two parameters 'a'"));
}

TEST_CASE("an unknown parameter is an error that lists the valid ones") {
  const Registry registry = Registry::builtin();
  const std::string message = error_of(registry, "recursive_shell_transformation", {{"depth", 3}});
  CHECK(contains(message, "recursive_shell_transformation"));
  CHECK(contains(message, "'depth'"));
  CHECK(contains(message, "max_level, budget, reflex_only"));
  CHECK(contains(error_of(registry, "flip_2_3", {{"depth", 3}}), "valid: none"));
}

TEST_CASE("a value outside the range is an error that gives the range") {
  const Registry registry = Registry::builtin();
  const std::string name = "recursive_shell_transformation";
  for (const double value : {-1.0, 16.0, 1e9, std::numeric_limits<double>::infinity()}) {
    CHECK(contains(error_of(registry, name, {{"max_level", value}}), "is outside 0 to 15"));
  }
  CHECK(contains(error_of(registry, name, {{"max_level", std::nan("")}}), "is outside 0 to 15"));
  CHECK(error_of(registry, name, {{"max_level", 0}}).empty());
  CHECK(error_of(registry, name, {{"max_level", 15}}).empty());
}

TEST_CASE("a fraction for a whole number or a flag is an error") {
  const Registry registry = Registry::builtin();
  const std::string name = "recursive_shell_transformation";
  CHECK(contains(error_of(registry, name, {{"max_level", 2.5}}), "max_level = 2.5 is not a whole"));
  CHECK(contains(error_of(registry, name, {{"reflex_only", 0.5}}), "is not a whole"));
  CHECK(error_of(registry, "edge_contraction", {{"least_ratio", 0.25}}).empty());
}

TEST_CASE("values are defaults until they are set, and the last setting of a name counts") {
  using Kind = ParameterSpec::Kind;
  static constexpr std::array<ParameterSpec, 3> kSpecs = {{
      {"count", Kind::integer, 0, 10, 4, "help"},
      {"share", Kind::real, 0, 1, 0.5, "help"},
      {"loud", Kind::flag, 0, 1, 1, "help"},
  }};
  const ParameterValues defaults("owner", kSpecs, {});
  CHECK(defaults.integer("count") == 4);
  CHECK(defaults.real("share") == 0.5);
  CHECK(defaults.flag("loud"));
  const ParameterValues set("owner", kSpecs, {{"count", 1}, {"loud", 0}, {"count", 7}});
  CHECK(set.integer("count") == 7);
  CHECK(set.real("share") == 0.5);
  CHECK_FALSE(set.flag("loud"));
}

TEST_CASE("a parameter that is held has its value whatever an operator is asked for with") {
  Registry registry = Registry::builtin();
  registry.hold("recursive_shell_transformation", "max_level", 3);
  const auto settings = [&](const ParameterSettings& asked) {
    return registry.make("recursive_shell_transformation", asked)->settings();
  };
  CHECK(contains(settings({}), "max_level = 3"));
  CHECK(contains(settings({{"max_level", 1}}), "max_level = 3"));
  registry.hold("recursive_shell_transformation", "max_level", 2);
  CHECK(contains(settings({{"max_level", 1}}), "max_level = 2"));
  CHECK(registry.make("smoothing")->settings() ==
        Registry::builtin().make("smoothing")->settings());
  CHECK_THROWS_AS(registry.hold("recursive_shell_transformation", "max_level", -1), Error);
  CHECK_THROWS_AS(registry.hold("recursive_shell_transformation", "max_levle", 1), Error);
  CHECK_THROWS_AS(registry.hold("nope", "max_level", 1), Error);
  CHECK(contains(settings({}), "max_level = 2"));  // what is refused changes nothing
}
