// SPDX-License-Identifier: MIT
#include "explain/table_filling.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetmend::explain {

namespace {

/// Number of ways to choose n of m, for n up to 3.
std::size_t choose(std::size_t m, std::size_t n) {
  std::size_t ways = 1;
  for (std::size_t k = 0; k < n; ++k) ways = ways * (m - std::min(m, k)) / (k + 1);
  return ways;
}

/// The worse of the two tets at a triangle, from a list in the order of loops over i < k < j.
Quality triangle_quality(const PocketTables& tables, unsigned x, unsigned y, unsigned z) {
  std::array<std::size_t, 3> c = {x, y, z};
  std::sort(c.begin(), c.end());
  const std::size_t m = tables.size;
  const std::size_t of_first = choose(m, 3) - choose(m - c[0], 3);
  const std::size_t of_second = choose(m - c[0] - 1, 2) - choose(m - c[1], 2);
  return tables.triangles[of_first + of_second + (c[2] - c[1] - 1)];
}

}  // namespace

std::vector<TableCell> cells_of(const PocketTables& tables) {
  std::vector<TableCell> cells;
  const auto m = static_cast<unsigned>(tables.size);
  for (unsigned d = 2; d < m; ++d) {
    for (unsigned i = 0; i < m; ++i) cells.push_back({i, (i + d) % m, d});
  }
  return cells;
}

std::vector<CellChoice> choices_of(const PocketTables& tables, const TableCell& cell) {
  std::vector<CellChoice> choices;
  const auto m = static_cast<unsigned>(tables.size);
  for (unsigned n = 1; n < cell.d; ++n) {
    const unsigned k = (cell.i + n) % m;
    choices.push_back({k, std::min({triangle_quality(tables, cell.i, k, cell.j),
                                    tables.q(cell.i, k), tables.q(k, cell.j)})});
  }
  return choices;
}

bool TableFilling::is_filled(unsigned i, unsigned j) const {
  if (cells.empty()) return false;
  const unsigned m = cells.back().d + 1;
  const unsigned d = (j + m - i) % m;
  return d >= 2 && std::size_t{d - 2} * m + i < filled;
}

std::optional<TableCell> TableFilling::here() const {
  if (!is_under_way || filled == 0) return std::nullopt;
  return cells[filled - 1];
}

TableFilling full_tables(const PocketTables& tables) {
  TableFilling filling{cells_of(tables)};
  filling.filled = filling.cells.size();
  return filling;
}

bool fills_tables(const Call& call, std::uint64_t position) {
  return position == call.events.begin + 1 && call.algorithm != Algorithm::recursion;
}

std::string to_text(const ShellPicture& shell, const TableFilling& filling) {
  const auto name = [&](std::size_t i) { return shell.ring[i].index(); };
  if (!filling.is_under_way) {
    return fmt::format("Filled. Bold: better than the old tets, whose worst quality is {:.4f}.",
                       shell.floor);
  }
  const auto cell = filling.here();
  if (!cell) {
    return fmt::format(
        "A row and a column for each corner of the ring. The pocket from i on to j is triangulated "
        "in the best way. Step into the table, or over it: {} cells.",
        filling.cells.size());
  }
  std::vector<std::string> choices;
  bool has_any = false;
  for (const CellChoice& choice : choices_of(shell.tables, *cell)) {
    const bool is_there = choice.quality > 0;
    has_any |= is_there;
    choices.push_back(fmt::format("k = {} gives {}", name(choice.k),
                                  is_there ? fmt::format("{:.4f}", choice.quality) : "none"));
  }
  const unsigned best = shell.tables.k(cell->i, cell->j);
  const std::string result =
      best < shell.tables.size
          ? fmt::format("M_q = {:.4f}, M_k = {}.", shell.tables.q(cell->i, cell->j), name(best))
      : shell.locks.any() && has_any ? "Locked: none."
                                     : "No triangulation.";
  return fmt::format("Cell {} of {}, pocket from {} to {}: {}. {}", filling.filled,
                     filling.cells.size(), name(cell->i), name(cell->j), fmt::join(choices, "; "),
                     result);
}

std::optional<std::size_t> after_diagonal(const TableFilling& filling) {
  const auto cell = filling.here();
  if (!cell) return std::nullopt;
  const auto from = filling.cells.begin() + static_cast<std::ptrdiff_t>(filling.filled);
  const auto next = std::find_if(from, filling.cells.end(),
                                 [&](const TableCell& other) { return other.d > cell->d; });
  if (next == filling.cells.end()) return std::nullopt;
  return static_cast<std::size_t>(next - filling.cells.begin()) + 1;
}

}  // namespace tetmend::explain
