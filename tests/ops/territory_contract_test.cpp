// SPDX-License-Identifier: MIT
// Every registered operator in a territory: what it changes lies inside, what it refuses or leaves
// for later leaves no trace.
#include <limits>
#include <utility>

#include <doctest/doctest.h>

#include "contract/contract.h"
#include "contract/zoo.h"

using namespace tetmend;
using namespace tetmend::contract;

TEST_CASE("operators change nothing outside the territory, and nothing when they refuse or defer") {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  Registry registry = Registry::builtin();
  for (const OperatorInfo* info : registry.operators()) {
    CAPTURE(info->name);
    const auto op = registry.make(info->name);
    Outcome total;
    // A moved lattice offers nothing to 2-3 and 3-2 flips, a Delaunay mesh does.
    for (const auto& [data, bound] :
         {std::pair(kuhn_cube(5, 0.38, 1), 0.55), std::pair(delaunay_ball(300, 2), 0.4)}) {
      const Outcome outcome = try_in_territory(*op, TetMesh(data), bound, kAll);
      CHECK(outcome.complaint == "");
      total += outcome;
    }
    const Outcome free = try_in_territory(*op, cube_with_free_sides(5, 3), 0.55, kAll);
    CHECK(free.complaint == "");
    total += free;
    CHECK(total.accepted > 0);
    CHECK(total.deferred > 0);
  }
}
