// SPDX-License-Identifier: MIT
// What every registered operator promises, tried on every mesh of the zoo. A refusal leaves no
// trace; an accepted attempt leaves a sound and better mesh with the same surface, regions and
// constraints.
#include "contract/contract.h"

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;
using namespace tetmend::contract;

namespace {

std::vector<Candidate> operators_with_defaults(const Registry& registry) {
  std::vector<Candidate> all;
  for (const OperatorInfo* info : registry.operators()) {
    all.push_back(with_defaults(registry, info->name));
  }
  return all;
}

std::vector<Candidate> operators_at_their_limits(const Registry& registry) {
  std::vector<Candidate> all;
  for (const OperatorInfo* info : registry.operators()) {
    auto some = at_its_limits(registry, info->name);
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

template <class Try>
void check_all(const std::vector<Candidate>& candidates, bool must_succeed, Try&& attempt) {
  const auto all = grounds();
  for (const Candidate& candidate : candidates) {
    Outcome total;
    for (const Ground& ground : all) {
      const Outcome outcome = attempt(*candidate.op, ground.mesh);
      total += outcome;
      CHECK_MESSAGE(outcome.complaint.empty(), candidate.name, " on ", ground.name, ", ",
                    outcome.complaint);
    }
    // An operator that never accepts would pass all the same.
    if (must_succeed) {
      CHECK_MESSAGE(total.accepted > 0, candidate.name, ": none of ", total.attempts, " accepted");
    }
    MESSAGE(candidate.name, ": ", total.accepted, " of ", total.attempts, " attempts accepted");
  }
}

}  // namespace

TEST_CASE("each operator keeps its contract in sweeps over every mesh of the zoo") {
  const Registry registry = Registry::builtin();
  check_all(operators_with_defaults(registry), true, [](const Operator& op, const TetMesh& mesh) {
    return try_in_sweeps(op, mesh, 2, 800);
  });
}

TEST_CASE("each operator keeps its contract on fresh copies of every mesh of the zoo") {
  const Registry registry = Registry::builtin();
  check_all(operators_with_defaults(registry), true, [](const Operator& op, const TetMesh& mesh) {
    return try_on_fresh_copies(op, mesh, 200);
  });
}

TEST_CASE("each operator keeps the promise of whichever judge decides") {
  const Registry registry = Registry::builtin();
  check_all(operators_with_defaults(registry), true,
            [](const Operator& op, const TetMesh& mesh) { return try_under_judges(op, mesh, 60); });
}

TEST_CASE("each operator keeps its contract with each parameter at the ends of its range") {
  const Registry registry = Registry::builtin();
  check_all(operators_at_their_limits(registry), false,
            [](const Operator& op, const TetMesh& mesh) { return try_in_sweeps(op, mesh, 1, 60); });
}

TEST_CASE("operators keep the contract when they work one after the other on the same mesh") {
  const Registry registry = Registry::builtin();
  const auto candidates = operators_with_defaults(registry);
  for (const Ground& ground : grounds()) {
    const Outcome outcome = try_in_turns(candidates, ground.mesh, 2, 250);
    REQUIRE_MESSAGE(outcome.complaint.empty(), ground.name, ": ", outcome.complaint);
  }
}
