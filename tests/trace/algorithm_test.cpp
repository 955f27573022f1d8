// SPDX-License-Identifier: MIT
#include "trace/algorithm.h"

#include <doctest/doctest.h>

#include "ops/registry.h"
#include "trace/verdict.h"

using namespace tetmend;

TEST_CASE("each algorithm that a trace can explain is an operator of its name") {
  const Registry registry = Registry::builtin();
  for (const std::string_view name : kAlgorithmOperators) {
    if (name.empty()) continue;
    CAPTURE(name);
    CHECK(registry.find(name).name == name);
    CHECK(operator_name(algorithm_of(name)) == name);
  }
  CHECK(algorithm_of("vertex_removal") == Algorithm::other);
  CHECK(algorithm_of("") == Algorithm::other);
}

TEST_CASE("a verdict is found again by its text, and no other text is a verdict") {
  for (std::size_t i = 0; i < kVerdictCount; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    CHECK(verdict_of(to_string(verdict)) == verdict);
  }
  CHECK_FALSE(verdict_of("no_improvement").has_value());
  CHECK_FALSE(verdict_of("").has_value());
}
