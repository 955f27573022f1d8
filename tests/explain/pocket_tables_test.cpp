// SPDX-License-Identifier: MIT
#include "explain/pocket_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <doctest/doctest.h>

#include "explain/call_study.h"
#include "explain/stepper.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

/// Another order of vertices gives another last digit, which is all that a flat tet has.
bool same(Quality a, Quality b) {
  constexpr Quality kNoise = 1e-9F;
  return a == b || std::abs(a - b) <= kNoise;
}

/// The shells that the calls of a run begin with.
template <class Check>
unsigned for_each_shell(const Check& check) {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  unsigned seen = 0;
  for (std::uint32_t k = 0; k < file.calls().size(); k += 11) {
    const CallStudy study = study_call(file, replay, k);
    if (!study.picture || study.picture->tables.size == 0) continue;
    check(*study.picture);
    ++seen;
  }
  return seen;
}

}  // namespace

TEST_CASE("M_q has what the search of the operators finds for each pocket") {
  unsigned found = 0;
  unsigned locked = 0;
  const unsigned shells = for_each_shell([&](const ShellPicture& s) {
    const std::size_t m = s.ring.size();
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t d = 2; d + 1 < m; ++d) {
        const std::size_t j = (i + d) % m;
        CHECK(same(s.tables.q(i, j), s.pocket(i, j)[0]));
        if (s.tables.q(i, j) > 0) ++found;
      }
    }
    if (s.locks.any()) ++locked;
  });
  CHECK(shells > 100);
  CHECK(found > 100);
  CHECK(locked > 10);
}

TEST_CASE("following M_k gives the best triangulation of the whole ring") {
  unsigned full = 0;
  for_each_shell([&](const ShellPicture& s) {
    const std::size_t m = s.ring.size();
    CHECK(same(s.tables.q(0, m - 1), s.full.triangles.empty() ? 0 : s.full.worst));
    if (s.full.triangles.empty()) return;
    std::set<std::set<unsigned>> by_tables;
    const std::function<void(std::size_t, std::size_t)> follow = [&](std::size_t i, std::size_t j) {
      if (j == (i + 1) % m) return;
      const unsigned k = s.tables.k(i, j);
      REQUIRE(k < m);
      by_tables.insert({static_cast<unsigned>(i), k, static_cast<unsigned>(j)});
      follow(i, k);
      follow(k, j);
    };
    follow(0, m - 1);
    std::set<std::set<unsigned>> by_search;
    for (const auto& t : s.full.triangles) by_search.insert({t.corners.begin(), t.corners.end()});
    CHECK(by_tables == by_search);
    ++full;
  });
  CHECK(full > 50);
}

TEST_CASE("an entry of M_q is the best of its choices, as Equation 1 has it") {
  for_each_shell([&](const ShellPicture& s) {
    if (s.locks.any()) return;
    const std::size_t m = s.ring.size();
    const auto triangle = [&](std::size_t i, std::size_t k, std::size_t j) {
      std::array<std::size_t, 3> c = {i, k, j};
      std::sort(c.begin(), c.end());
      std::size_t place = 0;
      for (std::size_t x = 0; x < m; ++x) {
        for (std::size_t y = x + 1; y < m; ++y) {
          for (std::size_t z = y + 1; z < m; ++z, ++place) {
            if (c == std::array{x, y, z}) return s.tables.triangles[place];
          }
        }
      }
      return Quality(0);
    };
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t d = 2; d < m; ++d) {
        const std::size_t j = (i + d) % m;
        Quality best = 0;
        for (std::size_t n = 1; n < d; ++n) {
          const std::size_t k = (i + n) % m;
          best = std::max(best, std::min({triangle(i, k, j), s.tables.q(i, k), s.tables.q(k, j)}));
        }
        CHECK(s.tables.q(i, j) == best);
      }
      CHECK(std::isinf(s.tables.q(i, (i + 1) % m)));
    }
  });
}

TEST_CASE("a ring with more corners than are searched has no tables") {
  const SlotMesh mesh{TetMesh(test::shell_mesh({.degree = 20}))};
  const ShellPicture s =
      picture_of_shell(mesh, find_slot_shell(mesh, VertexHandle(0), VertexHandle(1)));
  CHECK(s.ring.size() == 20);
  CHECK(s.tables.size == 0);
}
