// SPDX-License-Identifier: MIT
// Every registered operator in a territory: what it changes lies inside, what it refuses or leaves
// for later leaves no trace.
#include <doctest/doctest.h>

#include "contract/contract.h"
#include "contract/zoo.h"

using namespace tetmend;
using namespace tetmend::contract;

TEST_CASE("operators change nothing outside the territory, and nothing when they refuse or defer") {
  Registry registry;
  register_builtin_operators(registry);
  for (const OperatorInfo* info : registry.operators()) {
    CAPTURE(info->name);
    const auto op = registry.make(info->name);
    Outcome total;
    for (const std::uint64_t seed : {1, 2}) {
      const Outcome outcome = try_in_territory(*op, TetMesh(kuhn_cube(5, 0.38, seed)), 0.55);
      CHECK(outcome.complaint == "");
      total += outcome;
    }
    if (info->name != "flip_2_3") CHECK(total.accepted > 0);  // a moved lattice offers none
    CHECK(total.deferred > 0);
  }
}
