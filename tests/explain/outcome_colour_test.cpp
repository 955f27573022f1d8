// SPDX-License-Identifier: MIT
#include "explain/outcome_colour.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

using namespace tetmend;
using namespace tetmend::explain;

TEST_CASE("each way to end has a colour of its own") {
  std::vector<figure::Colour> seen;
  for (const Outcome outcome :
       {Outcome::unfinished, Outcome::accepted, Outcome::no_improvement, Outcome::limit,
        Outcome::constrained, Outcome::rejected, Outcome::other}) {
    const figure::Colour colour = outcome_colour(outcome);
    CHECK(std::find(seen.begin(), seen.end(), colour) == seen.end());
    seen.push_back(colour);
  }
}
