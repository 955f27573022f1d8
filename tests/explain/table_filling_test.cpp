// SPDX-License-Identifier: MIT
#include "explain/table_filling.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "explain/call_study.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

/// The shells that the calls of a run begin with.
template <class Check>
unsigned for_shells_of_a_run(const Check& check) {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  unsigned seen = 0;
  for (std::uint32_t k = 0; k < file.calls().size(); k += 170) {
    const CallStudy study = study_call(file, replay, k);
    if (!study.picture || study.picture->tables.size == 0) continue;
    check(*study.picture);
    ++seen;
  }
  return seen;
}

}  // namespace

TEST_CASE("cells come diagonal by diagonal, each after those that it is made of") {
  const unsigned shells = for_shells_of_a_run([](const ShellPicture& shell) {
    const auto m = static_cast<unsigned>(shell.ring.size());
    TableFilling filling{cells_of(shell.tables), 0, true};
    CHECK(filling.cells.size() == std::size_t{m} * (m - 2));
    for (const TableCell& cell : filling.cells) {
      CHECK((cell.i + cell.d) % m == cell.j);
      CHECK_FALSE(filling.is_filled(cell.i, cell.j));
      for (const CellChoice& choice : choices_of(shell.tables, cell)) {
        for (const auto& [from, to] : {std::pair{cell.i, choice.k}, std::pair{choice.k, cell.j}}) {
          CHECK((filling.is_filled(from, to) || to == (from + 1) % m));
        }
      }
      ++filling.filled;
      CHECK(filling.here()->i == cell.i);
      CHECK(filling.is_filled(cell.i, cell.j));
    }
    CHECK_FALSE(full_tables(shell.tables).here());
  });
  CHECK(shells > 5);
}

TEST_CASE("M_q has the best of the choices of a cell, and M_k is where that is") {
  unsigned filled = 0;
  for_shells_of_a_run([&](const ShellPicture& shell) {
    for (const TableCell& cell : cells_of(shell.tables)) {
      const auto choices = choices_of(shell.tables, cell);
      CHECK(choices.size() == cell.d - 1);
      const unsigned k = shell.tables.k(cell.i, cell.j);
      if (k >= shell.tables.size) continue;
      ++filled;
      for (const CellChoice& choice : choices) {
        CHECK(choice.quality <= shell.tables.q(cell.i, cell.j));
        if (choice.k == k) CHECK(choice.quality == shell.tables.q(cell.i, cell.j));
      }
    }
  });
  CHECK(filled > 30);
}

TEST_CASE("a step over goes to the first cell of the next diagonal, and from the last out") {
  for_shells_of_a_run([](const ShellPicture& shell) {
    const std::size_t m = shell.ring.size();
    TableFilling filling{cells_of(shell.tables), 1, true};
    std::size_t diagonals = 1;
    while (const auto next = after_diagonal(filling)) {
      CHECK(*next == diagonals * m + 1);
      filling.filled = *next;
      ++diagonals;
    }
    CHECK(diagonals == m - 2);
  });
}
