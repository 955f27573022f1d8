// SPDX-License-Identifier: MIT
// The order of quality vectors, and what each judge takes and refuses.
#include "kernel/judge.h"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/shell.h"
#include "kernel/star.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Qualities = std::vector<Quality>;

bool takes(const Judge& judge, const Qualities& now, const Qualities& before,
           const Judge::Aim& aim = {}) {
  Comparison qualities(before, now);
  return judge.holds_for(qualities, aim);
}

/// Lexicographic order without tolerance, the shorter padded with +infinity.
bool strictly_greater(std::vector<Quality> a, std::vector<Quality> b) {
  const std::size_t length = std::max(a.size(), b.size());
  a.resize(length, std::numeric_limits<Quality>::infinity());
  b.resize(length, std::numeric_limits<Quality>::infinity());
  return std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end());
}

/// Short ascending vectors of few distinct values, some of which differ by less than the tolerance.
std::vector<std::vector<Quality>> sample_vectors(int count) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> length(0, 4);
  std::uniform_int_distribution<int> coarse(0, 2);
  std::uniform_int_distribution<int> fine(-2, 2);
  std::vector<std::vector<Quality>> vectors;
  for (int i = 0; i < count; ++i) {
    std::vector<Quality> v(static_cast<std::size_t>(length(random)));
    for (Quality& q : v) {
      q = 0.25f * static_cast<Quality>(coarse(random)) +
          0.6f * kQualityTolerance * static_cast<Quality>(fine(random));
    }
    std::sort(v.begin(), v.end());
    vectors.push_back(v);
  }
  return vectors;
}

}  // namespace

TEST_CASE("a quality vector improves when its first different entry is larger") {
  CHECK(improves(Qualities{0.2f, 0.3f}, Qualities{0.1f, 0.9f}));
  CHECK_FALSE(improves(Qualities{0.1f, 0.9f}, Qualities{0.2f, 0.3f}));
  CHECK(improves(Qualities{0.1f, 0.4f}, Qualities{0.1f, 0.3f, 0.8f}));
  CHECK_FALSE(improves(Qualities{0.1f, 0.3f}, Qualities{0.1f, 0.3f}));
  CHECK(improves(Qualities{-0.1f}, Qualities{-0.2f}));
  CHECK(improves(Qualities{0.f}, Qualities{-0.2f, 0.9f}));
}

TEST_CASE("of two quality vectors of which one continues the other, the shorter is better") {
  CHECK(improves(Qualities{0.1f, 0.3f}, Qualities{0.1f, 0.3f, 0.9f}));
  CHECK_FALSE(improves(Qualities{0.1f, 0.3f, 0.9f}, Qualities{0.1f, 0.3f}));
  CHECK(improves(Qualities{}, Qualities{0.9f}));
  CHECK_FALSE(improves(Qualities{0.9f}, Qualities{}));
  CHECK_FALSE(improves(Qualities{}, Qualities{}));
}

TEST_CASE("a gain within the tolerance decides nothing, a loss within it forbids") {
  const Quality little = 0.5f * kQualityTolerance;
  const Quality more = 2.0f * kQualityTolerance;
  CHECK_FALSE(improves(Qualities{0.25f + little}, Qualities{0.25f}));
  CHECK(improves(Qualities{0.25f + more}, Qualities{0.25f}));
  CHECK(improves(Qualities{0.25f + little, 0.5f}, Qualities{0.25f, 0.4f}));
  CHECK_FALSE(improves(Qualities{0.25f - little, 0.5f}, Qualities{0.25f, 0.4f}));
  CHECK(improves(Qualities{0.25f + little}, Qualities{0.25f, 0.4f}));
  CHECK_FALSE(improves(Qualities{0.25f - little}, Qualities{0.25f, 0.4f}));
}

TEST_CASE("improves is a strict order and never contradicts the exact lexicographic one") {
  const auto vectors = sample_vectors(120);
  std::size_t better = 0;
  for (const auto& a : vectors) {
    CHECK_FALSE(improves(a, a));
    for (const auto& b : vectors) {
      if (!improves(a, b)) continue;
      ++better;
      CHECK_FALSE(improves(b, a));
      CHECK(strictly_greater(a, b));
      for (const auto& c : vectors) {
        if (improves(b, c)) CHECK(improves(a, c));
      }
    }
  }
  CHECK(better > 1000);
}

TEST_CASE("a strict judge takes a better quality vector, whatever the order it comes in") {
  CHECK(takes(Judge::strict(), {1.8f, 0.4f}, {0.2f, 1.9f}));
  CHECK(takes(Judge::strict(), {1.8f, 0.2f}, {0.2f, 1.6f}));
  CHECK_FALSE(takes(Judge::strict(), {1.8f, 0.2f}, {0.4f, 0.6f}));
  CHECK_FALSE(takes(Judge::strict(), {0.2f, 1.8f}, {1.8f, 0.2f}));
  CHECK(takes(Judge::strict(), {}, {1.8f}));
}

TEST_CASE("a fair judge lets bad tets lack no more in sum") {
  const Judge fair = Judge::fair({.desperate = 0});
  const Qualities before = {0.6f, 0.8f};
  CHECK(takes(fair, {0.62f, 0.8f}, before));
  CHECK_FALSE(takes(fair, {0.58f, 1.2f}, before));         // the worst is worse
  CHECK_FALSE(takes(fair, Qualities(100, 0.7f), before));  // they lack more
  CHECK(takes(fair, Qualities(2, 0.7f), before));
}

TEST_CASE("with a large exponent mild bad tets hardly count, and with 1 each counts") {
  const Qualities before = {0.2f, 1.8f};
  const Qualities now = {0.4f, 0.8f, 0.8f};
  CHECK(takes(Judge::fair({.exponent = 12, .desperate = 0}), now, before));
  CHECK_FALSE(takes(Judge::fair({.exponent = 1, .desperate = 0}), now, before));
}

TEST_CASE("where a new bad tet has a price, the worst tet must gain it for each") {
  const Qualities before = {0.2f, 1.8f};
  const Judge::Aim priced = {.price = 0.1};
  for (const Judge& judge : {Judge::strict(), Judge::reaches(1.2f)}) {
    CHECK(takes(judge, {0.29f, 1.8f}, before, priced));  // none is new
    CHECK(takes(judge, {0.31f, 0.9f}, before, priced));
    CHECK_FALSE(takes(judge, {0.29f, 0.9f}, before, priced));
    CHECK(takes(judge, {0.29f, 0.9f}, before));
    CHECK_FALSE(takes(judge, {0.31f, 0.9f, 0.9f}, before, priced));
    CHECK(takes(judge, {0.41f, 0.9f, 0.9f}, before, priced));
  }
  CHECK_FALSE(takes(Judge::fair({.desperate = 1, .price = 0}), {0.29f, 0.9f}, before, priced));
}

TEST_CASE("where the worst tet is desperate, a gain pays for a new bad tet for each 0.002") {
  const Qualities before = {0.2f, 0.9f, 1.6f};
  // An exponent of 1, so that the sum never speaks for these.
  const Judge fair = Judge::fair({.exponent = 1, .desperate = 0.4});
  CHECK(takes(fair, {0.203f, 0.2f + 0.4f, 0.6f, 1.8f}, before));
  CHECK_FALSE(takes(fair, {0.203f, 0.6f, 0.6f, 0.6f, 1.8f}, before));
  CHECK(takes(fair, {0.205f, 0.6f, 0.6f, 0.6f, 1.8f}, before));
  CHECK(takes(fair, {0.2002f, 0.22f, 1.8f}, before));  // none is new
  CHECK(takes(fair, {}, before));
  CHECK_FALSE(takes(Judge::fair({.exponent = 1, .desperate = 0.2}), {0.22f, 0.6f, 0.6f}, before));
  // Without a price, any gain pays for any number.
  const Judge generous = Judge::fair({.desperate = 0.4, .price = 0});
  CHECK(takes(generous, Qualities(100, 0.22f), before));
}

TEST_CASE("a fair judge asked for no more bad tets takes a gain where nothing is bad as well") {
  const Qualities before = {0.5f, 1.8f};
  const Qualities now = {0.9f, 0.9f};
  CHECK(takes(Judge::fair({}), now, before));
  CHECK_FALSE(takes(Judge::fair({.more_bad = false}), now, before));
  CHECK(takes(Judge::fair({.more_bad = false}), {1.4f}, {1.2f}));
  CHECK_FALSE(takes(Judge::fair({}), {1.4f}, {1.2f}));
}

TEST_CASE("a judge with a goal spares bad tets and lets good ones pay") {
  const Judge judge = Judge::reaches(1.2f);
  const Judge::Aim reached{.reached = true};
  CHECK(takes(judge, {1.02f, 1.22f}, {1.1f, 1.8f}, reached));
  CHECK_FALSE(takes(judge, {1.02f, 1.22f}, {1.1f, 1.8f}));           // the goal is missed
  CHECK_FALSE(takes(judge, {0.98f, 1.22f}, {1.1f, 1.8f}, reached));  // a new bad tet
  CHECK_FALSE(takes(judge, {0.58f, 1.22f}, {0.6f, 1.1f}, reached));  // a worse one
  CHECK(takes(judge, {0.6f, 1.22f}, {0.6f, 1.1f}, reached));
  CHECK(takes(judge, {1.12f, 1.14f}, {1.1f, 1.8f}));  // simply better
}

TEST_CASE("a smaller angle pays for bad tets, but not for a worse one") {
  const Judge judge = Judge::lowers_angle(1.0);
  const Qualities before = {0.6f, 0.8f, 1.02f};
  CHECK(takes(judge, before, before, {.sine = 1.002002}));
  CHECK_FALSE(takes(judge, before, before, {.sine = 1.0018}));
  CHECK(takes(judge, {0.6f, 0.98f, 0.98f}, before, {.sine = 1.002002}));
  CHECK_FALSE(takes(judge, {0.6f, 0.98f, 0.98f, 0.98f}, before, {.sine = 1.0038}));
  CHECK(takes(judge, {0.6f, 0.98f, 0.98f, 0.98f}, before, {.sine = 1.004002}));
  CHECK_FALSE(takes(judge, {0.6f, 1.2f}, before, {.sine = 1.0018}));
  CHECK_FALSE(takes(judge, {0.58f, 1.2f}, before, {.sine = 1.4}));
}

TEST_CASE("a judge of the mean takes a gain, but no new bad tet and none that is worse") {
  const Judge judge = Judge::raises_mean(0.7);
  CHECK(takes(judge, {1.1f, 1.2f}, {1.5f, 1.5f}, {.gain = 0.1}));
  CHECK_FALSE(takes(judge, {1.6f, 1.6f}, {1.5f, 1.5f}, {.gain = 0}));
  CHECK_FALSE(takes(judge, {0.9f, 1.2f}, {1.5f, 1.5f}, {.gain = 0.1}));
  CHECK_FALSE(takes(judge, {0.7f, 1.2f}, {0.8f, 1.5f}, {.gain = 0.1}));
  CHECK(takes(judge, {0.8f, 1.2f}, {0.8f, 1.5f}, {.gain = 0.1}));
}

TEST_CASE("a judge of lengths wants them to fit better, and no tet below its least or the worst") {
  const Judge judge = Judge::fits_lengths(0.4f);
  CHECK(takes(judge, {0.5f}, {1.5f}, {.fits = true}));
  CHECK_FALSE(takes(judge, {1.5f}, {0.5f}, {.fits = false}));
  CHECK_FALSE(takes(judge, {0.39f}, {1.5f}, {.fits = true}));
  CHECK(takes(judge, {0.3f}, {0.3f}, {.fits = true}));
  CHECK_FALSE(takes(judge, {0.29f}, {0.3f}, {.fits = true}));
}

TEST_CASE("a judge of untangling wants fewer inverted or flat tets, and no more bad ones") {
  const Judge judge = Judge::untangles();
  CHECK(takes(judge, {-0.9f, 0.1f}, {-0.2f, -0.1f}));
  CHECK(takes(judge, {-0.9f, 0.1f}, {-0.2f, 0.f}));
  CHECK_FALSE(takes(judge, {-0.1f, -0.1f}, {-0.2f, -0.2f}));
  CHECK_FALSE(takes(judge, {-0.1f, 0.f}, {-0.2f, -0.2f}));
  CHECK(takes(judge, {0.1f, 0.1f, 1.2f}, {-0.1f, 0.9f, 1.2f}));
  CHECK_FALSE(takes(judge, {0.1f, 0.1f, 0.9f}, {-0.1f, 0.9f, 1.2f}));
  CHECK_FALSE(takes(judge, {0.9f}, {0.1f}));
}

TEST_CASE("an opening leaves its share of the worst quality") {
  const Judge judge = Judge::opening(0.2);
  CHECK(takes(judge, {0.22f, 0.6f}, {1.f, 1.8f}));
  CHECK_FALSE(takes(judge, {0.18f, 0.6f}, {1.f, 1.8f}));
  CHECK(takes(judge, {0.f}, {-1.f}));
}

TEST_CASE("what a judge asks a search for is no more than what it takes") {
  const std::vector<Judge> judges = {Judge::strict(),         Judge::fair({}),
                                     Judge::reaches(1.2f),    Judge::lowers_angle(0.8),
                                     Judge::raises_mean(0.7), Judge::opening()};
  for (const Judge& judge : judges) {
    CAPTURE(judge.promise());
    for (const double worst : {-0.6, 0.0, 0.2, 0.6, 0.98, 1.1, 1.6}) {
      // One tet by another that is better by more than the tolerance: better in every order.
      const auto was = static_cast<Quality>(worst);
      const auto is = static_cast<Quality>(std::max(judge.floor(worst), worst) + 1e-3);
      // Where nothing is bad, a fair judge wants no more of it.
      if (worst < kBadThreshold || judge.kind() != Judge::Kind::fair) {
        CHECK(takes(judge, {is}, {was}, {.reached = true, .sine = 1, .gain = 1}));
      }
      CHECK(judge.floor(worst) <= std::max(worst, 0.0));
      CHECK(judge.floor(worst, 0.02) <= judge.floor(worst) + 0.02);
    }
  }
  CHECK(Judge::fair({}).deficit_limit(0.6, 1.4) == 1.4);
  CHECK(Judge::fair({}).deficit_limit(0.2, 1.4) == std::numeric_limits<double>::infinity());
  CHECK(Judge::strict().deficit_limit(0.6, 1.4) == std::numeric_limits<double>::infinity());
  CHECK(Judge::fair({.exponent = 12}).deficit_limit(0.6, 1.4) ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("a judge compares all that a transaction changed, and refuses one without edits") {
  TetMesh mesh(shell_mesh({.degree = 3, .height = 1.4}));
  Workspace workspace(mesh);
  Comparison qualities({0.2f}, {0.4f});
  Transaction transaction(mesh, workspace);
  CHECK_FALSE(Judge::opening().accepts({transaction, qualities}));
  CHECK_FALSE(qualities.has_both());
  const std::vector<TetHandle> old = {TetHandle(0), TetHandle(1), TetHandle(2)};
  Shell shell;
  const auto edge = find_edge(mesh, VertexHandle(0), VertexHandle(1), workspace, TetHandle(0));
  REQUIRE(edge.has_value());
  REQUIRE(find_shell(mesh, *edge, shell, Territory()) == ShellKind::closed);
  const std::vector<TetVertices> created = {{shell.a, shell.ring[0], shell.ring[1], shell.ring[2]},
                                            {shell.ring[0], shell.ring[1], shell.ring[2], shell.b}};
  REQUIRE(transaction.replace_cavity(old, created) == EditResult::made);
  CHECK(Judge::strict().accepts({transaction, qualities}));
  CHECK(qualities.before().size() == 3);
  CHECK(qualities.now().size() == 2);
  CHECK(std::is_sorted(qualities.before().begin(), qualities.before().end()));
  // The tet aimed at is gone, so any goal is reached.
  const TetVertices corners = {};
  CHECK(Judge::reaches(1.8f).accepts({transaction, qualities, TetHandle(0), corners}));
}
